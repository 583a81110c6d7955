#include "render/encode.h"

#include <catch2/catch.hpp>

#include "render/image_file.h"

using namespace farol;
using render::Image;

namespace {

Image noise(int width, int height, bool opaque) {
    Image image{width, height, {}};
    unsigned state = 12345;
    for (int i = 0; i < width * height * 4; ++i) {
        state = state * 1664525U + 1013904223U;
        image.pixels.push_back(i % 4 == 3 && opaque ? std::uint8_t{255}
                                                    : static_cast<std::uint8_t>(state >> 24));
    }
    return image;
}

}  // namespace

TEST_CASE("a PNG holds exactly the pixels that went in") {
    const auto width = GENERATE(1, 2, 33, 512);
    const auto opaque = GENERATE(true, false);
    const Image image = noise(width, 17, opaque);
    const std::string png = render::encodePng(image);
    CHECK(png[25] == (opaque ? 2 : 6));  // colour type of IHDR
    CHECK(render::decodeImage(png, "a.png") == image);
}

TEST_CASE("JPEG and WebP are read back as nearly the same picture") {
    Image image{64, 64, {}};
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            for (const int value : {x * 4, y * 4, 128, 255})
                image.pixels.push_back(static_cast<std::uint8_t>(value));
    const std::string bytes =
        GENERATE_REF(render::encodeJpeg(image, 90), render::encodeWebp(image, 90));
    const Image back = render::decodeImage(bytes, "a");
    REQUIRE(back.width == 64);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        REQUIRE(std::abs(int{image.pixels[i]} - int{back.pixels[i]}) <= 12);  // lossy at 90
}

TEST_CASE("bytes that are no picture are refused by name and place") {
    const std::string png = render::encodePng(noise(40, 40, true));
    const std::string bytes =
        GENERATE_COPY(std::string(), std::string("not a picture"), png.substr(0, 20),
                      png.substr(0, png.size() / 2), std::string("\xff\xd8\xff") + "junk",
                      std::string("GIF89a"), std::string("BM"), std::string("P6 -1 99999 255\n"),
                      std::string("RIFF____WEBP"), std::string("RIFF"));
    CAPTURE(bytes.size());
    try {
        render::decodeImage(bytes, "wood.png", {"scene.xml", 3, 7});
        FAIL("was taken for a picture");
    } catch (const Error& error) {
        CHECK(error.code() == "image.unreadable");
        CHECK(error.primary().where == Location{"scene.xml", 3, 7});
        CHECK(std::string(error.what()).find("wood.png") != std::string::npos);
    }
}

TEST_CASE("a canvas that decoders take memory for at once is refused by the head") {
    using namespace std::string_literals;
    const auto [name, bytes] = GENERATE(table<const char*, std::string>({
        {"a.gif", "GIF89a\xff\xff\xff\xff\0\0\0;"s},
        {"x.webp", "RIFF\x16\0\0\0WEBPVP8X\x0a\0\0\0\0\0\0\0\xff\xff\0\xff\xff\0"s},
        {"l.webp", "RIFF\x16\0\0\0WEBPVP8L\x0a\0\0\0\x2f\xff\xff\xff\x0f\0\0\0\0\0"s},
        {"s.webp", "RIFF\x16\0\0\0WEBPVP8 \x0a\0\0\0\0\0\0\x9d\x01\x2a\xff\x3f\xff\x3f"s},
    }));
    CAPTURE(name);
    try {
        render::decodeImage(bytes, name);
        FAIL("was taken for a picture");
    } catch (const Error& error) {
        CHECK(error.code() == "limit.texture");
    }
}

TEST_CASE("a picture that claims to be huge is refused before memory is taken") {
    std::string png = render::encodePng(noise(1, 1, true));
    const std::string width("\x00\x01\x86\xa0", 4);  // 100000
    png.replace(16, 4, width).replace(20, 4, width);
    CHECK_THROWS_AS(render::decodeImage(png, "a.png"), Error);
}
