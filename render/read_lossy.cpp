#include <cstdio>
// jpeglib.h needs FILE from cstdio before it.
#include <jpeglib.h>
#include <webp/decode.h>

#include <stdexcept>
#include <string>

#include "render/decoder.h"
#include "render/image_file.h"

namespace farol::render {
namespace {

/// libjpeg ends the process on an error unless told otherwise.
[[noreturn]] void throwJpegError(j_common_ptr info) {
    char text[JMSG_LENGTH_MAX];
    info->err->format_message(info, text);
    throw std::runtime_error(std::string("libjpeg: ") + text);
}

void ignoreMessage(j_common_ptr, int) {}

struct JpegReader {
    explicit JpegReader(std::string_view bytes) {
        info.err = jpeg_std_error(&errors);
        errors.error_exit = throwJpegError;
        errors.emit_message = ignoreMessage;
        jpeg_create_decompress(&info);
        jpeg_mem_src(&info, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    }
    ~JpegReader() { jpeg_destroy_decompress(&info); }
    JpegReader(const JpegReader&) = delete;
    JpegReader& operator=(const JpegReader&) = delete;

    jpeg_decompress_struct info{};
    jpeg_error_mgr errors{};
};

std::uint8_t product(std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>((a * b + 127) / 255);
}

/// Four inks, inverted as Adobe's programs write them, to RGB in place.
void fromInks(Decoded& out) {
    for (std::size_t i = 0, to = 0; i + 3 < out.samples.size(); i += 4)
        for (std::size_t c = 0; c < 3; ++c)
            out.samples[to++] = product(out.samples[i + c], out.samples[i + 3]);
    out.channels = 3;
    out.allocate();
}

}  // namespace

void readJpeg(std::string_view bytes, bool wantsPixels, Decoded& out) {
    JpegReader reader(bytes);
    jpeg_decompress_struct& info = reader.info;
    jpeg_read_header(&info, TRUE);
    out.width = static_cast<int>(info.image_width);
    out.height = static_cast<int>(info.image_height);
    const bool inks = info.num_components == 4;
    const bool gray = info.num_components == 1;
    out.channels = gray ? 1 : 4;
    if (!wantsPixels || out.pixels() > kMaxTexturePixels) {
        if (inks) out.channels = 3;
        return;
    }
    // Four bytes a pixel at once, as they are wanted (libjpeg-turbo's extension): alpha is 255.
    info.out_color_space = inks ? JCS_CMYK : gray ? JCS_GRAYSCALE : JCS_EXT_RGBA;
    out.allocate();
    jpeg_start_decompress(&info);
    const auto row = static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.channels);
    while (info.output_scanline < info.output_height) {
        JSAMPROW at = out.samples.data() + info.output_scanline * row;
        jpeg_read_scanlines(&info, &at, 1);
    }
    jpeg_finish_decompress(&info);
    if (inks) fromInks(out);
}

void readWebp(std::string_view bytes, bool wantsPixels, Decoded& out) {
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(data, bytes.size(), &features) != VP8_STATUS_OK)
        throw std::runtime_error("libwebp: the head is damaged");
    out.width = features.width;
    out.height = features.height;
    out.channels = features.has_alpha != 0 ? 4 : 3;
    if (!wantsPixels || out.pixels() > kMaxTexturePixels) return;
    out.allocate();
    const auto read = out.channels == 4 ? WebPDecodeRGBAInto : WebPDecodeRGBInto;
    if (read(data, bytes.size(), out.samples.data(), out.samples.size(),
             out.width * out.channels) == nullptr)
        throw std::runtime_error("libwebp: the picture is damaged or cut off");
}

}  // namespace farol::render
