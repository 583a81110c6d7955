#include <cstdio>
// jpeglib.h needs FILE from cstdio before it.
#include <jpeglib.h>
#include <webp/encode.h>

#include <cstdlib>
#include <memory>
#include <new>
#include <stdexcept>

#include "image/format.h"
#include "image/image.h"

namespace farol::image {
namespace {

/// libjpeg ends the process on an error unless its handler is replaced.
[[noreturn]] void throwJpegEncodeError(j_common_ptr info) {
    char text[JMSG_LENGTH_MAX];
    info->err->format_message(info, text);
    throw std::runtime_error(std::string("libjpeg: ") + text);
}

struct JpegWriter {
    JpegWriter() {
        info.err = jpeg_std_error(&errors);
        errors.error_exit = throwJpegEncodeError;
        jpeg_create_compress(&info);
        jpeg_mem_dest(&info, &bytes, &size);
    }
    ~JpegWriter() {
        jpeg_destroy_compress(&info);
        std::free(bytes);  // libjpeg's own malloc, by its contract
    }
    JpegWriter(const JpegWriter&) = delete;
    JpegWriter& operator=(const JpegWriter&) = delete;

    jpeg_compress_struct info{};
    jpeg_error_mgr errors{};
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
};

}  // namespace

std::string encodeJpeg(const Image& image, int quality) {
    JpegWriter writer;
    jpeg_compress_struct& info = writer.info;
    info.image_width = static_cast<JDIMENSION>(image.width);
    info.image_height = static_cast<JDIMENSION>(image.height);
    info.input_components = 3;
    info.in_color_space = JCS_RGB;
    jpeg_set_defaults(&info);
    jpeg_set_quality(&info, quality, TRUE);
    // 4:2:0 smears the one-pixel coloured lines that these scenes are made of.
    info.comp_info[0].h_samp_factor = info.comp_info[0].v_samp_factor = 1;
    jpeg_start_compress(&info, TRUE);
    std::vector<std::uint8_t> row(static_cast<std::size_t>(image.width) * 3);
    const std::uint8_t* from = image.pixels.data();
    for (int y = 0; y < image.height; ++y) {
        for (std::size_t x = 0; x < static_cast<std::size_t>(image.width); ++x, from += 4)
            for (std::size_t c = 0; c < 3; ++c)
                row[x * 3 + c] = static_cast<std::uint8_t>((from[c] * from[3] + 127) / 255);
        JSAMPROW line = row.data();
        jpeg_write_scanlines(&info, &line, 1);
    }
    jpeg_finish_compress(&info);
    return {reinterpret_cast<const char*>(writer.bytes), writer.size};
}

std::string encodeWebp(const Image& image, int quality) {
    std::uint8_t* bytes = nullptr;
    const std::size_t size = WebPEncodeRGBA(image.pixels.data(), image.width, image.height,
                                            image.width * 4, static_cast<float>(quality), &bytes);
    const std::unique_ptr<std::uint8_t, decltype(&WebPFree)> owner(bytes, &WebPFree);
    if (size == 0) throw std::runtime_error("libwebp cannot encode this image");
    return {reinterpret_cast<const char*>(bytes), size};
}

}  // namespace farol::image
