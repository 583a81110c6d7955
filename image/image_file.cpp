#include "image/image_file.h"

#include <algorithm>
#include <exception>
#include <stdexcept>

#include "core/text.h"
#include "image/decoder.h"
#include "image/image_head.h"
#include "image/messages.h"
#include "image/orientation.h"

namespace farol::image {
namespace {

struct FileFormat {
    const char* name;
    void (*read)(std::string_view bytes, bool wantsPixels, Decoded& out);
};

void readWholePng(std::string_view bytes, bool wantsPixels, Decoded& out) {
    if (!isWholePng(bytes)) throw std::runtime_error("the file is cut off");
    readPng(bytes, wantsPixels, out);
}

/// Returns the decoder for a file, or null. Other formats are not read: each decoder is attack
/// surface.
const FileFormat* recognise(std::string_view bytes, const std::string& name) {
    using namespace std::string_view_literals;
    static constexpr FileFormat kPng{"PNG", readWholePng}, kJpeg{"JPEG", readJpeg},
        kWebp{"WebP", readWebp}, kGif{"GIF", readGif}, kBmp{"BMP", readBmp}, kTga{"TGA", readTga},
        kPnm{"PNM", readPnm}, kHdr{"Radiance", readHdr}, kTiff{"TIFF", readTiff},
        kExr{"OpenEXR", readExr};
    if (bytes.starts_with("\x89PNG\r\n\x1a\n"sv)) return &kPng;
    if (bytes.starts_with("\xff\xd8\xff"sv)) return &kJpeg;
    if (bytes.starts_with("RIFF"sv) && bytes.size() > 12 && bytes.substr(8).starts_with("WEBP"sv))
        return &kWebp;
    if (bytes.starts_with("GIF8"sv)) return &kGif;
    if (bytes.starts_with("BM"sv)) return &kBmp;
    if (bytes.starts_with("II*\0"sv) || bytes.starts_with("MM\0*"sv)) return &kTiff;
    if (bytes.starts_with("\x76\x2f\x31\x01"sv)) return &kExr;
    if (bytes.starts_with("#?RADIANCE"sv) || bytes.starts_with("#?RGBE"sv)) return &kHdr;
    if (bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6') return &kPnm;
    return fileEnding(name) == "tga" ? &kTga : nullptr;
}

bool isWebPage(std::string_view bytes) {
    for (const std::string_view start : {"<!DOCTYPE html", "<html"})
        if (sameWord(bytes.substr(0, start.size()), start)) return true;
    return false;
}

Error tooLarge(const std::string& name, const std::string& size, const Location& where) {
    return Error(message<"limit.texture">("name"_arg = uncut(name), "size"_arg = size,
                                          "max"_arg = kMaxTexturePixels / 1'000'000),
                 where);
}

/// Decodes a file by any decoder; the only place that checks size, channels and sample count of
/// their output.
Decoded readFile(std::string_view bytes, const std::string& name, const Location& where,
                 bool wantsPixels) {
    const auto unreadable = [&](const std::string& why) {
        return Error(
            message<"image.unreadable">("name"_arg = uncut(name), "reason"_arg = uncut(why)),
            where);
    };
    const FileFormat* format = recognise(bytes, name);
    if (bytes.starts_with("version https://git-lfs"))
        throw Error(message<"image.unreadable/lfs">("name"_arg = uncut(name)), where);
    if (format == nullptr && isWebPage(bytes))
        throw Error(message<"image.unreadable/page">("name"_arg = uncut(name)), where);
    if (format == nullptr)
        throw Error(bytes.empty() ? message<"image.unreadable/empty">("name"_arg = uncut(name))
                                  : message<"image.unreadable/format">("name"_arg = uncut(name)),
                    where);
    if (format->read == readWebp && announcedWebpPixels(bytes) > kMaxTexturePixels)
        throw tooLarge(name, std::to_string(announcedWebpPixels(bytes)) + " pixels", where);
    Decoded out;
    try {
        format->read(bytes, wantsPixels, out);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw unreadable(std::string(format->name) + ": " + error.what());
    }
    if (out.width <= 0 || out.height <= 0 || out.channels <= 0 || out.channels > 4)
        throw unreadable("it has no pixels");
    if (out.pixels() > kMaxTexturePixels)
        throw tooLarge(name, std::to_string(out.width) + " x " + std::to_string(out.height) + " px",
                       where);
    if (wantsPixels && out.samples.size() != static_cast<std::size_t>(out.height) * out.rowSize())
        throw unreadable("its size and its pixels differ");
    orient(out, orientationOf(bytes));
    return out;
}

}  // namespace

ImageSize imageSize(std::string_view bytes, const std::string& name, const Location& where) {
    const Decoded head = readFile(bytes, name, where, false);
    const bool hasChannel = head.channels == 2 || head.channels == 4;
    return {head.width, head.height, hasChannel && recognise(bytes, name)->read != readJpeg};
}

Image decodeImage(std::string_view bytes, const std::string& name, const Location& where,
                  std::string* damage) {
    Decoded file = readFile(bytes, name, where, true);
    if (!file.damage.empty() && damage == nullptr)
        throw Error(message<"image.unreadable">("name"_arg = uncut(name),
                                                "reason"_arg = uncut("it " + file.damage)),
                    where);
    if (!file.damage.empty()) *damage = file.damage;
    Image image{file.width, file.height, {}};
    if (file.channels == 4) {
        image.pixels = std::move(file.samples);
        return image;
    }
    const auto count = static_cast<std::size_t>(file.pixels());
    image.pixels.resize(count * 4);
    const auto step = static_cast<std::size_t>(file.channels);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint8_t* from = &file.samples[i * step];
        std::uint8_t* to = &image.pixels[i * 4];
        to[0] = from[0];
        to[1] = step == 3 ? from[1] : from[0];
        to[2] = step == 3 ? from[2] : from[0];
        to[3] = step == 2 ? from[1] : std::uint8_t{255};
    }
    return image;
}

}  // namespace farol::image
