#include "render/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cctype>

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
    if (startsWith(bytes, "RIFF"sv) && bytes.substr(8, 4) == "WEBP"sv) return "webp";
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

}  // namespace

Image decodeImage(std::string_view bytes, const std::string& name, const Location& where) {
    const auto fail = [&](const std::string& why) -> Error {
        return Error("image.unreadable", "'" + name + "' cannot be read as a picture: " + why,
                     where);
    };
    const std::string format = sniff(bytes, name);
    if (format.empty())
        throw fail(bytes.empty() ? "the file is empty"
                                 : "it is none of PNG, JPEG, WebP, BMP, TGA, GIF, TIFF, PNM, HDR");
    OIIO::Filesystem::IOMemReader proxy(const_cast<char*>(bytes.data()),
                                        bytes.size());  // the reader never writes
    auto input = OIIO::ImageInput::create(format, false, nullptr, &proxy);
    if (!input) throw fail("this build has no decoder for " + format);
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    OIIO::ImageSpec spec;
    if (!input->set_ioproxy(&proxy) || !input->open("memory." + format, spec, config))
        throw fail(input->geterror());
    const std::int64_t count = std::int64_t{spec.width} * spec.height;
    if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0) throw fail("it has no pixels");
    if (count > kMaxTexturePixels || spec.depth > 1 || spec.nchannels > 16)
        throw Error("limit.texture",
                    "'" + name + "' is " + std::to_string(spec.width) + " x " +
                        std::to_string(spec.height) + " px; at most 64 million pixels are taken",
                    where);
    const int channels = std::min(spec.nchannels, 4);
    std::vector<std::uint8_t> raw(static_cast<std::size_t>(count * channels));
    if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, raw.data()))
        throw fail(input->geterror());
    Image image{spec.width, spec.height, {}};
    image.pixels.resize(static_cast<std::size_t>(count) * 4);
    const std::size_t step = static_cast<std::size_t>(channels);
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        const std::uint8_t* from = &raw[i * step];
        std::uint8_t* to = &image.pixels[i * 4];
        to[0] = from[0];
        to[1] = channels >= 3 ? from[1] : from[0];
        to[2] = channels >= 3 ? from[2] : from[0];
        to[3] = channels == 4 ? from[3] : channels == 2 ? from[1] : std::uint8_t{255};
    }
    return image;
}

}  // namespace farol::render
