#include <png.h>

#include <cstring>
#include <stdexcept>

#include "image/decoder.h"

namespace farol::image {
namespace {

[[noreturn]] void throwError(png_structp, png_const_charp message) {
    throw std::runtime_error(std::string("libpng: ") + message);
}

void ignoreWarning(png_structp, png_const_charp) {}

/// Returns the bytes behind the last IDAT chunk: further frames of an animation, text. None
/// if a chunk is cut off: it may be IDAT.
std::string_view behindPixels(std::string_view bytes) {
    constexpr std::size_t kSignature = 8, kAround = 12;  // a chunk's length, type and checksum
    std::string_view behind;
    for (std::size_t at = kSignature; at + kAround <= bytes.size();) {
        std::size_t length = 0;
        for (std::size_t i = 0; i < 4; ++i)
            length = length << 8 | static_cast<unsigned char>(bytes[at + i]);
        if (length > bytes.size() - at - kAround) return {};
        const bool isPixels = bytes.substr(at + 4, 4) == "IDAT";
        at += length + kAround;
        if (isPixels) behind = bytes.substr(at);
    }
    return behind;
}

struct PngSource {
    std::string_view rest;
    std::size_t behindPixels;     ///< bytes behind the last IDAT chunk, which are skipped
    bool isComplete = false;      ///< all pixels are decoded
    std::size_t afterPixels = 0;  ///< bytes of IDAT chunks read since
};

/// Compressed data that may follow the last pixel: libpng decompresses all of it.
constexpr std::size_t kMaxAfterPixels = 64 * 1024;

void readBytes(png_structp png, png_bytep into, std::size_t count) {
    PngSource& source = *static_cast<PngSource*>(png_get_io_ptr(png));
    if (count > source.rest.size()) throw std::runtime_error("the file is cut off");
    if (source.isComplete && source.rest.size() > source.behindPixels &&
        (source.afterPixels += count) > kMaxAfterPixels)
        throw std::runtime_error("its data goes on after the last pixel");
    std::memcpy(into, source.rest.data(), count);
    source.rest.remove_prefix(count);
}

struct Rows {
    PngSource* source;
    std::uint64_t left;
};

/// The rows of all passes that have pixels.
std::uint64_t countRows(png_const_structrp png, png_const_inforp info, int passes) {
    const std::uint64_t width = png_get_image_width(png, info);
    const std::uint64_t height = png_get_image_height(png, info);
    if (passes == 1) return height;
    std::uint64_t rows = 0;
    for (int pass = 0; pass < passes; ++pass)
        if (PNG_PASS_COLS(width, pass) > 0) rows += PNG_PASS_ROWS(height, pass);
    return rows;
}

/// Called for each decoded row, before libpng decompresses the data after the last row.
void countRow(png_structp png, png_row_infop, png_bytep) {
    Rows& rows = *static_cast<Rows*>(png_get_user_transform_ptr(png));
    if (--rows.left == 0) rows.source->isComplete = true;
}

struct Reader {
    explicit Reader(std::string_view bytes) : source{bytes, behindPixels(bytes).size()} {
        png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, throwError, ignoreWarning);
        if (png != nullptr) info = png_create_info_struct(png);
        if (info == nullptr) throw std::bad_alloc();
        png_set_read_fn(png, &source, readBytes);
        // Text and profiles expand to a thousand times their size; none of them is used.
        png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    }
    ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    PngSource source;
    png_structp png = nullptr;
    png_infop info = nullptr;
};

}  // namespace

void readPng(std::string_view bytes, bool wantsPixels, Decoded& out) {
    Reader reader(bytes);
    png_structp png = reader.png;
    png_read_info(png, reader.info);
    png_set_expand(png);    // palettes, 1 to 4 bits, a transparent colour
    png_set_scale_16(png);  // rounds; colours are display values, so gamma is left alone
    const int passes = png_set_interlace_handling(png);
    Rows rows{&reader.source, countRows(png, reader.info, passes)};
    png_set_read_user_transform_fn(png, countRow);
    png_set_user_transform_info(png, &rows, 0, 0);
    png_read_update_info(png, reader.info);
    if (!out.announce(png_get_image_width(png, reader.info), png_get_image_height(png, reader.info),
                      png_get_channels(png, reader.info)) ||
        !wantsPixels)
        return;
    const std::size_t row = out.rowSize();
    if (png_get_rowbytes(png, reader.info) != row) throw std::runtime_error("rows do not fit");
    out.allocate();
    for (int pass = 0; pass < passes; ++pass)
        for (int y = 0; y < out.height; ++y)
            png_read_row(png, out.samples.data() + static_cast<std::size_t>(y) * row, nullptr);
    png_read_end(png, nullptr);
}

}  // namespace farol::image
