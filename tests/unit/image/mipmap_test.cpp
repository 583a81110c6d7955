#include <catch2/catch.hpp>

#include "image/image.h"

using farol::image::buildMipmaps;
using farol::image::Image;

namespace {

Image row(const std::vector<int>& reds) {
    Image image{static_cast<int>(reds.size()), 1, {}};
    for (const int red : reds)
        for (const int value : {red, 0, 0, 255})
            image.pixels.push_back(static_cast<std::uint8_t>(value));
    return image;
}

}  // namespace

TEST_CASE("mipmaps of sizes that are no powers of two are weighted by area") {
    const std::vector<Image> levels = buildMipmaps(row({0, 255, 0, 255, 255}));
    REQUIRE(levels.size() == 2);
    REQUIRE(levels[0].width == 2);
    CHECK(levels[0].pixels[0] == 102);
    CHECK(levels[0].pixels[4] == 204);
    CHECK(levels[1].pixels[0] == 153);
}

TEST_CASE("mipmaps keep a constant picture constant down to one texel") {
    const auto width = GENERATE(1, 2, 3, 7, 64, 100);
    const auto height = GENERATE(1, 5, 64);
    Image image{width, height, {}};
    const auto brightness = GENERATE(std::uint8_t{201}, std::uint8_t{255});
    image.pixels.assign(static_cast<std::size_t>(width * height * 4), brightness);
    const std::vector<Image> levels = buildMipmaps(image);
    for (const Image& level : levels)
        for (const std::uint8_t value : level.pixels) REQUIRE(value == brightness);
    if (width > 1 || height > 1) {
        REQUIRE(levels.back().width == 1);
        REQUIRE(levels.back().height == 1);
    } else {
        REQUIRE(levels.empty());
    }
}

TEST_CASE("the last mipmap is the mean of the picture") {
    Image image{37, 23, {}};
    double sum = 0.0;
    for (int i = 0; i < 37 * 23; ++i) {
        const auto value = static_cast<std::uint8_t>((i * 7919) % 256);
        sum += value;
        for (int c = 0; c < 4; ++c) image.pixels.push_back(value);
    }
    // 8 fractional bits a level and one final rounding: within one.
    CHECK(buildMipmaps(image).back().pixels[0] == Approx(sum / (37 * 23)).margin(1.0));
}

TEST_CASE("halves of even sizes are means of four, rounded once in 1/256") {
    Image image{64, 32, {}};
    for (int i = 0; i < 64 * 32 * 4; ++i)
        image.pixels.push_back(static_cast<std::uint8_t>((i * 7919) % 251));
    const std::vector<Image> levels = buildMipmaps(image);
    REQUIRE(levels[0].width == 32);
    const auto at = [&](int x, int y, int c) {
        return image.pixels[static_cast<std::size_t>((y * 64 + x) * 4 + c)] * 256U;
    };
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 32; ++x)
            for (int c = 0; c < 4; ++c) {
                const unsigned sum = at(2 * x, 2 * y, c) + at(2 * x + 1, 2 * y, c) +
                                     at(2 * x, 2 * y + 1, c) + at(2 * x + 1, 2 * y + 1, c);
                const unsigned want = ((sum + 2) / 4 + 128) / 256;
                REQUIRE(levels[0].pixels[static_cast<std::size_t>((y * 32 + x) * 4 + c)] == want);
            }
}
