#include <png.h>

#include <cstring>
#include <stdexcept>

#include "render/decoder.h"
#include "render/image_file.h"

namespace farol::render {
namespace {

[[noreturn]] void throwError(png_structp, png_const_charp message) {
    throw std::runtime_error(std::string("libpng: ") + message);
}

void ignoreWarning(png_structp, png_const_charp) {}

void take(png_structp png, png_bytep into, std::size_t count) {
    auto& rest = *static_cast<std::string_view*>(png_get_io_ptr(png));
    if (count > rest.size()) throw std::runtime_error("the file is cut off");
    std::memcpy(into, rest.data(), count);
    rest.remove_prefix(count);
}

struct Reader {
    explicit Reader(std::string_view bytes) : rest(bytes) {
        png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, throwError, ignoreWarning);
        if (png != nullptr) info = png_create_info_struct(png);
        if (info == nullptr) throw std::bad_alloc();
        png_set_read_fn(png, &rest, take);
    }
    ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    std::string_view rest;
    png_structp png = nullptr;
    png_infop info = nullptr;
};

}  // namespace

void readPng(std::string_view bytes, bool wantsPixels, Decoded& out) {
    Reader reader(bytes);
    png_structp png = reader.png;
    png_read_info(png, reader.info);
    out.width = static_cast<int>(png_get_image_width(png, reader.info));
    out.height = static_cast<int>(png_get_image_height(png, reader.info));
    png_set_expand(png);    // palettes, 1 to 4 bits, a transparent colour
    png_set_scale_16(png);  // rounds; colours are display values, so gamma is left alone
    const int passes = png_set_interlace_handling(png);
    png_read_update_info(png, reader.info);
    out.channels = png_get_channels(png, reader.info);
    if (!wantsPixels || out.pixels() > kMaxTexturePixels) return;
    out.allocate();
    const auto row = static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.channels);
    if (png_get_rowbytes(png, reader.info) != row) throw std::runtime_error("rows do not fit");
    for (int pass = 0; pass < passes; ++pass)
        for (int y = 0; y < out.height; ++y)
            png_read_row(png, out.samples.data() + static_cast<std::size_t>(y) * row, nullptr);
    png_read_end(png, nullptr);
}

}  // namespace farol::render
