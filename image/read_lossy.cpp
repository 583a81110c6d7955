#include <cstdio>
// jpeglib.h needs FILE from cstdio before it, and jerror.h all of jpeglib.h.
#include <jpeglib.h>
// After it.
#include <jerror.h>
#include <webp/decode.h>
#include <webp/demux.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "image/decoder.h"
#include "image/image_head.h"

namespace farol::image {
namespace {

/// libjpeg ends the process on an error unless its handler is replaced.
[[noreturn]] void throwJpegError(j_common_ptr info) {
    char text[JMSG_LENGTH_MAX];
    info->err->format_message(info, text);
    throw std::runtime_error(std::string("libjpeg: ") + text);
}

/// Notes damage that libjpeg passes over; level -1 is a warning, others are traces.
void noteMessage(j_common_ptr info, int level) {
    if (level >= 0) return;
    auto& damage = *static_cast<std::string*>(info->client_data);
    switch (info->err->msg_code) {
        case JWRN_JPEG_EOF:
            damage = "is cut off";
            break;
        case JWRN_HIT_MARKER:
        case JWRN_HUFF_BAD_CODE:
        case JWRN_ARITH_BAD_CODE:
        case JWRN_MUST_RESYNC:
        case JWRN_BOGUS_PROGRESSION:
        case JWRN_NOT_SEQUENTIAL:
            if (damage.empty()) damage = "is damaged";
            break;
        default:  // of no effect on the pixels
            break;
    }
}

[[noreturn]] void throwTooManyScans() {
    throw std::runtime_error("it has more than " + std::to_string(kMaxJpegScans) +
                             " scans; fix: save it as a baseline JPEG");
}

/// Each scan of a progressive file costs a pass over the whole image, however short it is.
void limitScans(j_common_ptr info) {
    // The common part of a decompressor; libjpeg calls back with nothing else.
    if (reinterpret_cast<j_decompress_ptr>(info)->input_scan_number > kMaxJpegScans)
        throwTooManyScans();
}

struct JpegReader {
    explicit JpegReader(std::string_view bytes) {
        info.err = jpeg_std_error(&errors);
        errors.error_exit = throwJpegError;
        errors.emit_message = noteMessage;
        jpeg_create_decompress(&info);
        progress.progress_monitor = limitScans;
        info.progress = &progress;
        info.client_data = &damage;
        jpeg_mem_src(&info, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    }
    ~JpegReader() { jpeg_destroy_decompress(&info); }
    JpegReader(const JpegReader&) = delete;
    JpegReader& operator=(const JpegReader&) = delete;

    jpeg_decompress_struct info{};
    jpeg_error_mgr errors{};
    jpeg_progress_mgr progress{};
    std::string damage;
};

std::uint8_t product(std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>((a * b + 127) / 255);
}

/// CMYK, inverted as Adobe's programs write it, to RGB in place.
void fromInks(Decoded& out) {
    for (std::size_t i = 0, to = 0; i + 3 < out.samples.size(); i += 4)
        for (std::size_t c = 0; c < 3; ++c)
            out.samples[to++] = product(out.samples[i + c], out.samples[i + 3]);
    out.channels = 3;
    out.samples.resize(static_cast<std::size_t>(out.pixels()) * 3);
}

struct ReleaseDemuxer {
    void operator()(WebPDemuxer* demuxer) const { WebPDemuxDelete(demuxer); }
};

/// Decodes one still bitstream of the announced size into RGB or RGBA rows.
void decodeWebp(const std::uint8_t* data, std::size_t size, std::uint8_t* to, std::size_t room,
                std::size_t stride, bool alpha) {
    const auto decode = alpha ? WebPDecodeRGBAInto : WebPDecodeRGBInto;
    if (decode(data, size, to, room, static_cast<int>(stride)) == nullptr)
        throw std::runtime_error("libwebp: the image is damaged or cut off");
}

/// The first frame of an animation on its transparent canvas.
void readFirstFrame(std::string_view bytes, bool wantsPixels, Decoded& out) {
    const WebPData data{reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
    const std::unique_ptr<WebPDemuxer, ReleaseDemuxer> demuxer(WebPDemux(&data));
    if (!demuxer) throw std::runtime_error("libwebp: the animation is damaged or cut off");
    const std::int64_t width = WebPDemuxGetI(demuxer.get(), WEBP_FF_CANVAS_WIDTH);
    const std::int64_t height = WebPDemuxGetI(demuxer.get(), WEBP_FF_CANVAS_HEIGHT);
    if (!out.announce(width, height, 4) || !wantsPixels) return;
    WebPIterator frame{};
    const bool hasFrame = WebPDemuxGetFrame(demuxer.get(), 1, &frame) != 0;
    const std::unique_ptr<WebPIterator, decltype(&WebPDemuxReleaseIterator)> owner(
        &frame, &WebPDemuxReleaseIterator);
    if (!hasFrame || frame.complete == 0 || frame.x_offset < 0 || frame.y_offset < 0 ||
        frame.width <= 0 || frame.height <= 0 ||
        std::int64_t{frame.x_offset} + frame.width > width ||
        std::int64_t{frame.y_offset} + frame.height > height)
        throw std::runtime_error("libwebp: the first frame is damaged or cut off");
    int frameWidth = 0, frameHeight = 0;
    if (WebPGetInfo(frame.fragment.bytes, frame.fragment.size, &frameWidth, &frameHeight) == 0 ||
        frameWidth != frame.width || frameHeight != frame.height)
        throw std::runtime_error("libwebp: the first frame differs from its announced size");
    out.allocate();
    const std::size_t before = static_cast<std::size_t>(frame.x_offset) * 4;
    std::uint8_t* to = out.row(frame.y_offset) + before;
    const std::size_t room =
        out.rowSize() * static_cast<std::size_t>(out.height - frame.y_offset) - before;
    decodeWebp(frame.fragment.bytes, frame.fragment.size, to, room, out.rowSize(), true);
}

}  // namespace

void readJpeg(std::string_view bytes, bool wantsPixels, Decoded& out) {
    if (countJpegScans(bytes) > kMaxJpegScans) throwTooManyScans();
    JpegReader reader(bytes);
    jpeg_decompress_struct& info = reader.info;
    jpeg_read_header(&info, TRUE);
    const bool inks = info.num_components == 4;
    const bool gray = info.num_components == 1;
    if (!out.announce(info.image_width, info.image_height, gray ? 1 : inks ? 3 : 4)) return;
    if (!wantsPixels) return;
    // Four bytes a pixel at once, as they are needed (libjpeg-turbo's extension): alpha is 255.
    if (inks) out.channels = 4;
    info.out_color_space = inks ? JCS_CMYK : gray ? JCS_GRAYSCALE : JCS_EXT_RGBA;
    // Coefficients of all scans: two bytes each, and blocks that are not full.
    constexpr long kSlack = 16L << 20;
    info.mem->max_memory_to_use = static_cast<long>(out.pixels()) * 12 + kSlack;
    out.allocate();
    jpeg_start_decompress(&info);
    if (info.output_width != info.image_width || info.output_height != info.image_height ||
        info.output_components != out.channels)
        throw std::runtime_error("its head and its pixels differ in size");
    while (info.output_scanline < info.output_height) {
        JSAMPROW at = out.row(static_cast<int>(info.output_scanline));
        if (jpeg_read_scanlines(&info, &at, 1) != 1)
            throw std::runtime_error("the file is cut off");
    }
    jpeg_finish_decompress(&info);
    out.damage = reader.damage;
    if (inks) fromInks(out);
}

void readWebp(std::string_view bytes, bool wantsPixels, Decoded& out) {
    if (isAnimatedWebp(bytes)) return readFirstFrame(bytes, wantsPixels, out);
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(data, bytes.size(), &features) != VP8_STATUS_OK)
        throw std::runtime_error("libwebp: the head is damaged");
    const bool alpha = features.has_alpha != 0;
    if (!out.announce(features.width, features.height, alpha ? 4 : 3) || !wantsPixels) return;
    out.allocate();
    decodeWebp(data, bytes.size(), out.samples.data(), out.samples.size(), out.rowSize(), alpha);
}

}  // namespace farol::image
