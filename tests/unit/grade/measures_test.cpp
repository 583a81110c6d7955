#include "grade/images/measures.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <random>

#include "grade/images/flip.h"

using namespace farol;
using namespace farol::grade;

namespace {

image::Image noise(int width, int height, unsigned seed, bool transparent = false) {
    std::mt19937 random(seed);
    image::Image image{width, height, {}};
    for (int i = 0; i < width * height * 4; ++i)
        image.pixels.push_back(i % 4 == 3 && !transparent
                                   ? std::uint8_t{255}
                                   : static_cast<std::uint8_t>(random() % 256));
    return image;
}

/// A channel on black.
int level(const image::Image& image, int x, int y, int c) {
    const std::uint8_t* p = &image.pixels[4 * static_cast<std::size_t>(y * image.width + x)];
    return (p[c] * p[3] + 127) / 255;
}

/// By the words of the header, a pixel at a time.
float beyond(const image::Image& a, const image::Image& b, int x, int y, int full) {
    int worst = 0;
    for (const auto& [mine, other] : {std::pair{&a, &b}, {&b, &a}})
        for (int c = 0; c < 3; ++c) {
            int low = 255, high = 0;
            for (int v = std::max(0, y - 1); v <= std::min(a.height - 1, y + 1); ++v)
                for (int u = std::max(0, x - 1); u <= std::min(a.width - 1, x + 1); ++u) {
                    low = std::min(low, level(*other, u, v, c));
                    high = std::max(high, level(*other, u, v, c));
                }
            const int here = level(*mine, x, y, c);
            worst = std::max({worst, low - here, here - high});
        }
    return std::min(1.0F, static_cast<float>(worst) / static_cast<float>(full));
}

/// The picture with other noise in a rectangle.
image::Image changed(image::Image image, const Rectangle& where) {
    const image::Image other = noise(image.width, image.height, 99);
    for (int y = where.y; y < where.y + where.height; ++y)
        for (int x = 4 * where.x; x < 4 * (where.x + where.width); ++x) {
            const auto at = static_cast<std::size_t>(4 * image.width * y + x);
            image.pixels[at] = x % 4 == 3 ? std::uint8_t{255} : other.pixels[at];
        }
    return image;
}

}  // namespace

TEST_CASE("what is beyond a pixel is that of every neighbourhood, at borders and in clear parts") {
    const auto [width, height] = GENERATE(std::pair{1, 1}, std::pair{2, 1}, std::pair{1, 5},
                                          std::pair{17, 9}, std::pair{40, 33});
    const bool transparent = GENERATE(false, true);
    const image::Image a = noise(width, height, 1, transparent);
    image::Image b = noise(width, height, 2, transparent);
    // Some rows are the same in both.
    for (int y = 0; y < height / 2; ++y)
        std::copy_n(a.pixels.begin() + 4 * width * y, 4 * width, b.pixels.begin() + 4 * width * y);
    const Plane found = beyondAPixel(a, b, 64);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            INFO(width << "x" << height << " at " << x << ", " << y);
            REQUIRE(found.at(x, y) == beyond(a, b, x, y, 64));
        }
}

TEST_CASE("the rectangle of what differs is tight") {
    const image::Image a = noise(30, 20, 5);
    CHECK(differing(a, a) == Rectangle{});
    for (const Rectangle& where : {Rectangle{0, 0, 1, 1}, Rectangle{29, 19, 1, 1},
                                   Rectangle{7, 3, 9, 11}, Rectangle{0, 0, 30, 20}})
        CHECK(differing(a, changed(a, where)) == where);
}

TEST_CASE("FLIP around what changed is FLIP of the whole, to the bit") {
    const image::Image a = noise(97, 83, 11);
    const FlipPicture reference{FloatImage(a)};
    for (const Rectangle& where :
         {Rectangle{40, 40, 1, 1}, Rectangle{0, 0, 3, 2}, Rectangle{90, 80, 7, 3},
          Rectangle{20, 10, 50, 9}, Rectangle{0, 0, 97, 83}}) {
        const image::Image b = changed(a, where);
        const Plane whole = flip(reference, FlipPicture(FloatImage(b)));
        const Plane around = flip(reference, b, differing(a, b));
        INFO(where.x << ", " << where.y << ": " << where.width << "x" << where.height);
        CHECK(whole.values == around.values);
        CHECK(*std::max_element(whole.values.begin(), whole.values.end()) > 0.0F);
    }
    CHECK(flip(reference, a, {}).values == Plane{97, 83, std::vector<float>(97 * 83)}.values);
}
