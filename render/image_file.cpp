#include "render/image_file.h"

#include <algorithm>
#include <cctype>
#include <exception>
#include <stdexcept>

#include "render/decoder.h"
#include "render/image_head.h"

namespace farol::render {
namespace {

bool startsWith(std::string_view bytes, std::string_view magic) {
    return bytes.substr(0, magic.size()) == magic;
}

/// OpenImageIO's name of the format, or "" for what no scene has business with: the library reads
/// dozens of formats, and each one is a door for a stranger's bytes.
std::string sniff(std::string_view bytes, const std::string& name) {
    using namespace std::string_view_literals;
    if (startsWith(bytes, "\x89PNG\r\n\x1a\n"sv)) return "png";
    if (startsWith(bytes, "\xff\xd8\xff"sv)) return "jpeg";
    if (startsWith(bytes, "RIFF"sv) && bytes.size() > 12 && startsWith(bytes.substr(8), "WEBP"sv))
        return "webp";
    if (startsWith(bytes, "BM"sv)) return "bmp";
    if (startsWith(bytes, "GIF8"sv)) return "gif";
    if (startsWith(bytes, "II*\0"sv) || startsWith(bytes, "MM\0*"sv)) return "tiff";
    if (startsWith(bytes, "#?RADIANCE"sv) || startsWith(bytes, "#?RGBE"sv)) return "hdr";
    if (bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6') return "pnm";
    const std::size_t dot = name.rfind('.');
    std::string ending = dot == std::string::npos ? "" : name.substr(dot + 1);
    for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return ending == "tga" ? "targa" : "";
}

void readAs(const std::string& format, std::string_view bytes, bool wantsPixels, Decoded& out) {
    if (format == "png") {
        if (!isWholePng(bytes)) throw std::runtime_error("the file is cut off");
        readPng(bytes, wantsPixels, out);
    } else if (format == "jpeg") {
        readJpeg(bytes, wantsPixels, out);
    } else if (format == "webp" && !isAnimatedWebp(bytes)) {
        readWebp(bytes, wantsPixels, out);
    } else {
        readByModule(format.c_str(), bytes, wantsPixels, out);
    }
}

Decoded readFile(std::string_view bytes, const std::string& name, const Location& where,
                 bool wantsPixels) {
    const auto unreadable = [&](const std::string& why) {
        return Error("image.unreadable", "'" + name + "' cannot be read as a picture: " + why,
                     where);
    };
    const std::string format = sniff(bytes, name);
    if (format.empty())
        throw unreadable(bytes.empty()
                             ? "the file is empty"
                             : "it is none of PNG, JPEG, WebP, BMP, TGA, GIF, TIFF, PNM, HDR");
    if (claimedPixels(format, bytes) > kMaxTexturePixels)
        throw Error("limit.texture",
                    "'" + name + "' claims " + std::to_string(claimedPixels(format, bytes)) +
                        " pixels; at most 64 million are taken",
                    where);
    Decoded out;
    try {
        readAs(format, bytes, wantsPixels, out);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw unreadable(error.what());
    }
    if (out.width <= 0 || out.height <= 0 || out.channels <= 0)
        throw unreadable("it has no pixels");
    if (out.pixels() > kMaxTexturePixels)
        throw Error("limit.texture",
                    "'" + name + "' is " + std::to_string(out.width) + " x " +
                        std::to_string(out.height) + " px; at most 64 million pixels are taken",
                    where);
    return out;
}

}  // namespace

ImageSize imageSize(std::string_view bytes, const std::string& name, const Location& where) {
    const Decoded head = readFile(bytes, name, where, false);
    return {head.width, head.height};
}

Image decodeImage(std::string_view bytes, const std::string& name, const Location& where) {
    Decoded file = readFile(bytes, name, where, true);
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

}  // namespace farol::render
