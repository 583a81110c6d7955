#include "render/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cctype>
#include <exception>

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

/// An opened picture file: its head is read and within bounds.
class Reader {
  public:
    Reader(std::string_view bytes, const std::string& name, const Location& where)
        : name_(name),
          where_(where),
          // The reader never writes.
          proxy_(const_cast<char*>(bytes.data()), bytes.size()) {
        const std::string format = sniff(bytes, name);
        if (format.empty())
            throw fault(bytes.empty()
                            ? "the file is empty"
                            : "it is none of PNG, JPEG, WebP, BMP, TGA, GIF, TIFF, PNM, HDR");
        if (format == "png" && !isWholePng(bytes)) throw fault("the file is cut off");
        if (claimedPixels(format, bytes) > kMaxTexturePixels)
            throw Error("limit.texture",
                        "'" + name + "' claims " + std::to_string(claimedPixels(format, bytes)) +
                            " pixels; at most 64 million are taken",
                        where);
        input_ = OIIO::ImageInput::create(format, false, nullptr, &proxy_);
        if (!input_) throw fault("this build has no decoder for " + format);
        OIIO::ImageSpec config;
        config.attribute("oiio:UnassociatedAlpha", 1);
        if (!input_->set_ioproxy(&proxy_) || !input_->open("memory." + format, spec_, config))
            throw fault(input_->geterror());
        if (spec_.width <= 0 || spec_.height <= 0 || spec_.nchannels <= 0)
            throw fault("it has no pixels");
        if (std::int64_t{spec_.width} * spec_.height > kMaxTexturePixels || spec_.depth > 1 ||
            spec_.nchannels > 16)
            throw Error("limit.texture",
                        "'" + name + "' is " + std::to_string(spec_.width) + " x " +
                            std::to_string(spec_.height) +
                            " px; at most 64 million pixels are taken",
                        where);
    }
    const OIIO::ImageSpec& spec() const { return spec_; }
    /// The first `channels` of every pixel.
    std::vector<std::uint8_t> read(int channels) {
        std::vector<std::uint8_t> raw(static_cast<std::size_t>(spec_.width) *
                                      static_cast<std::size_t>(spec_.height) *
                                      static_cast<std::size_t>(channels));
        if (!input_->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, raw.data()))
            throw fault(input_->geterror());
        return raw;
    }

  private:
    Error fault(const std::string& why) const {
        return Error("image.unreadable", "'" + name_ + "' cannot be read as a picture: " + why,
                     where_);
    }
    const std::string& name_;
    const Location& where_;
    OIIO::Filesystem::IOMemReader proxy_;
    OIIO::ImageSpec spec_;
    std::unique_ptr<OIIO::ImageInput> input_;
};

/// What `read` gives. Some decoders throw on what they cannot hold: a fault of the file as well.
template <class Read>
auto guarded(const std::string& name, const Location& where, const Read& read) {
    try {
        return read();
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        throw Error("image.unreadable",
                    "'" + name + "' cannot be read as a picture: " + error.what(), where);
    }
}

Image decode(std::string_view bytes, const std::string& name, const Location& where) {
    Reader reader(bytes, name, where);
    const int channels = std::min(reader.spec().nchannels, 4);
    const std::vector<std::uint8_t> raw = reader.read(channels);
    Image image{reader.spec().width, reader.spec().height, {}};
    const std::size_t count =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    image.pixels.resize(count * 4);
    const std::size_t step = static_cast<std::size_t>(channels);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint8_t* from = &raw[i * step];
        std::uint8_t* to = &image.pixels[i * 4];
        to[0] = from[0];
        to[1] = channels >= 3 ? from[1] : from[0];
        to[2] = channels >= 3 ? from[2] : from[0];
        to[3] = channels == 4 ? from[3] : channels == 2 ? from[1] : std::uint8_t{255};
    }
    return image;
}

}  // namespace

ImageSize imageSize(std::string_view bytes, const std::string& name, const Location& where) {
    return guarded(name, where, [&] {
        const Reader reader(bytes, name, where);
        return ImageSize{reader.spec().width, reader.spec().height};
    });
}

Image decodeImage(std::string_view bytes, const std::string& name, const Location& where) {
    return guarded(name, where, [&] { return decode(bytes, name, where); });
}

}  // namespace farol::render
