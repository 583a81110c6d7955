// Pictures from strangers, by every decoder that is let in.
#include "image/image_file.h"
#include "tests/fuzz/checks.h"
#include "tests/fuzz/target.h"

namespace farol::fuzz {

const Target& target() {
    // 64 million pixels are allowed: a decoder's canvas, its bytes and the picture made of them.
    static const Target made{
        {"png", "jpg", "webp", "bmp", "tga", "gif", "tif", "ppm", "hdr", "exr"},
        {"IHDR",
         "IDAT",
         "PLTE",
         "tRNS",
         "IEND",
         "GIF89a",
         "RIFF",
         "WEBPVP8 ",
         "VP8L",
         "VP8X",
         "ALPH",
         "BM",
         "P1\n",
         "P3\n",
         "P6\n",
         "#?RADIANCE\n",
         "#?RGBE\n",
         "\x76\x2f\x31\x01",
         "-Y 4 +X 4\n",
         std::string("II*\0", 4),
         std::string("MM\0*", 4),
         "\xFF\xD8\xFF",
         "\xFF\xC4",
         "\xFF\xDB"},
        1280};
    return made;
}

}  // namespace farol::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace farol;
    using namespace farol::fuzz;
    const std::string_view bytes(reinterpret_cast<const char*>(data), std::min(size, kMaxInput));
    // The name decides for TGA alone, which has no magic number.
    try {
        const image::Image image = image::decodeImage(bytes, "a.tga", {"scene.xml", 1, 1});
        require(image.width > 0 && image.height > 0, "a picture without pixels");
        const auto pixels =
            static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
        require(pixels <= static_cast<std::size_t>(image::kMaxTexturePixels), "too many pixels");
        require(image.pixels.size() == pixels * 4, "another number of bytes than four a pixel");
        reached(bytes.substr(0, 4));
    } catch (const Error& error) {
        checkError(error);
        reached(std::string(bytes.substr(0, 4)) + error.code());
    }
    return 0;
}
