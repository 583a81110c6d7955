#include <tiffio.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>

#include "image/decoder.h"

namespace farol::image {
namespace {

struct TiffSource {
    std::string_view bytes;
    std::uint64_t at = 0;
    std::string error;  ///< libtiff's first

    static TiffSource& of(thandle_t handle) { return *static_cast<TiffSource*>(handle); }
};

tmsize_t readBytes(thandle_t handle, void* to, tmsize_t count) {
    TiffSource& source = TiffSource::of(handle);
    if (count <= 0 || source.at >= source.bytes.size()) return 0;
    const auto size = std::min(static_cast<std::size_t>(count), source.bytes.size() - source.at);
    std::memcpy(to, source.bytes.data() + source.at, size);
    source.at += size;
    return static_cast<tmsize_t>(size);
}

tmsize_t writeNothing(thandle_t, void*, tmsize_t) { return 0; }

toff_t seek(thandle_t handle, toff_t offset, int from) {
    TiffSource& source = TiffSource::of(handle);
    source.at = from == SEEK_CUR   ? source.at + offset
                : from == SEEK_END ? source.bytes.size() + offset
                                   : offset;
    return source.at;
}

int closeNothing(thandle_t) { return 0; }

toff_t sizeOf(thandle_t handle) { return TiffSource::of(handle).bytes.size(); }

/// libtiff only reads from what is mapped.
int mapBytes(thandle_t handle, void** base, toff_t* size) {
    const std::string_view bytes = TiffSource::of(handle).bytes;
    *base = const_cast<char*>(bytes.data());
    *size = bytes.size();
    return 1;
}

void unmapNothing(thandle_t, void*, toff_t) {}

int noteError(TIFF*, void* user, const char*, const char* format, va_list words) {
    auto& source = *static_cast<TiffSource*>(user);
    std::array<char, 300> text{};
    std::vsnprintf(text.data(), text.size(), format, words);
    if (source.error.empty()) source.error = text.data();
    return 1;
}

int ignoreWarning(TIFF*, void*, const char*, const char*, va_list) { return 1; }

[[noreturn]] void throwError(const TiffSource& source) {
    throw std::runtime_error("libtiff: " +
                             (source.error.empty() ? std::string("damaged") : source.error));
}

using File = std::unique_ptr<TIFF, decltype(&TIFFClose)>;

File open(TiffSource& source, tmsize_t maxBytes) {
    const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(
        TIFFOpenOptionsAlloc(), &TIFFOpenOptionsFree);
    if (!options) throw std::bad_alloc();
    TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), maxBytes);
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), noteError, &source);
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), ignoreWarning, nullptr);
    // No splitting of strips ("c"). Without a mapping libtiff 4.5.0 refuses tiles that are not
    // compressed: it takes the size of its buffer for that of the tile.
    File file(TIFFClientOpenExt("image", "rc", &source, readBytes, writeNothing, seek, closeNothing,
                                sizeOf, mapBytes, unmapNothing, options.get()),
              &TIFFClose);
    if (!file) throwError(source);
    return file;
}

/// Codecs that write every sample of a strip or fail.
bool isReadable(std::uint16_t compression) {
    static constexpr std::array<int, 9> kReadable{
        COMPRESSION_NONE,    COMPRESSION_CCITTRLE,      COMPRESSION_CCITTFAX3,
        COMPRESSION_LZW,     COMPRESSION_CCITTFAX4,     COMPRESSION_JPEG,
        COMPRESSION_DEFLATE, COMPRESSION_ADOBE_DEFLATE, COMPRESSION_PACKBITS};
    return std::find(kReadable.begin(), kReadable.end(), int{compression}) != kReadable.end();
}

/// Makes alpha straight that was multiplied into the colours.
void unmultiply(std::vector<std::uint8_t>& samples) {
    for (std::size_t i = 0; i < samples.size(); i += 4) {
        const unsigned alpha = samples[i + 3];
        if (alpha == 0 || alpha == 255) continue;
        for (std::size_t c = 0; c < 3; ++c)
            samples[i + c] = static_cast<std::uint8_t>(
                std::min(255U, (samples[i + c] * 255U + alpha / 2) / alpha));
    }
}

/// The meaning of the first extra sample. Straight alpha is declared multiplied in, which keeps
/// libtiff from multiplying it.
bool declareAlpha(TIFF* file) {
    std::uint16_t count = 0;
    std::uint16_t* kinds = nullptr;
    TIFFGetFieldDefaulted(file, TIFFTAG_EXTRASAMPLES, &count, &kinds);
    if (count == 0 || kinds == nullptr || kinds[0] != EXTRASAMPLE_UNASSALPHA)
        return count > 0 && kinds != nullptr && kinds[0] == EXTRASAMPLE_ASSOCALPHA;
    std::vector<std::uint16_t> changed(kinds, kinds + count);
    changed[0] = EXTRASAMPLE_ASSOCALPHA;
    TIFFSetField(file, TIFFTAG_EXTRASAMPLES, int{count}, changed.data());
    return false;
}

}  // namespace

void readTiff(std::string_view bytes, bool wantsPixels, Decoded& out) {
    constexpr tmsize_t kMaxBytes = tmsize_t{512} << 20;  // of one strip or tile
    TiffSource source{bytes, 0, {}};
    const File file = open(source, kMaxBytes);
    std::uint32_t width = 0, height = 0;
    std::uint16_t compression = COMPRESSION_NONE;
    TIFFGetField(file.get(), TIFFTAG_IMAGEWIDTH, &width);
    TIFFGetField(file.get(), TIFFTAG_IMAGELENGTH, &height);
    TIFFGetFieldDefaulted(file.get(), TIFFTAG_COMPRESSION, &compression);
    if (!out.announce(width, height, 4)) return;
    if (!isReadable(compression))
        throw std::runtime_error("compression " + std::to_string(compression) + " is not read");
    if (!wantsPixels) return;
    const bool isMultiplied = declareAlpha(file.get());
    out.allocate();
    // Its pixels are 32-bit words with red in the lowest byte; stops at the first error.
    static_assert(std::endian::native == std::endian::little);
    if (TIFFReadRGBAImageOriented(file.get(), width, height,
                                  reinterpret_cast<std::uint32_t*>(out.samples.data()),
                                  ORIENTATION_TOPLEFT, 1) == 0)
        throwError(source);
    if (isMultiplied) unmultiply(out.samples);
}

}  // namespace farol::image
