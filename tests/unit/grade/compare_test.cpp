#include "grade/images/compare.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.h"

namespace {

using farol::Error;
using farol::grade::compare;
using farol::grade::crop;
using farol::image::Image;

Image filled(int width, int height, std::uint8_t level) {
    Image image{width, height, {}};
    for (int i = 0; i < width * height; ++i)
        image.pixels.insert(image.pixels.end(), {level, level, level, 255});
    return image;
}

void set(Image& image, int x, int y, std::uint8_t red) {
    image.pixels[4 * static_cast<std::size_t>(y * image.width + x)] = red;
}

}  // namespace

TEST_CASE("equal pictures do not differ") {
    const auto [found, shown] = compare(filled(5, 4, 90), filled(5, 4, 90));
    CHECK(found.maxLevels == 0);
    CHECK(found.meanLevels == 0.0);
    CHECK(std::isinf(found.psnrDb));
    CHECK(found.within[0] == 1.0);
    CHECK(shown.pixels[0] == 22);  // a quarter of 90, no red added
}

TEST_CASE("a uniform difference is what it is by hand") {
    const auto [found, shown] = compare(filled(8, 8, 100), filled(8, 8, 110));
    CHECK(found.maxLevels == 10);
    CHECK(found.tolerantMaxLevels == 10);
    CHECK(found.meanLevels == 10.0);
    CHECK(found.psnrDb == Approx(20.0 * std::log10(25.5)));
    CHECK(found.within[2] == 0.0);  // within 6
    CHECK(found.within[3] == 1.0);  // within 24
    CHECK(shown.pixels[0] == 25 + 80);
    CHECK(shown.pixels[1] == 25);
}

TEST_CASE("an edge that moves by a pixel costs nothing, by two pixels it does") {
    Image here = filled(9, 9, 0), near = here, far = here;
    for (int y = 0; y < 9; ++y) {
        set(here, 4, y, 255);
        set(near, 5, y, 255);
        set(far, 6, y, 255);
    }
    CHECK(compare(here, near).first.maxLevels == 255);
    CHECK(compare(here, near).first.tolerantMaxLevels == 0);
    CHECK(compare(here, far).first.tolerantMaxLevels == 255);
}

TEST_CASE("what only one picture shows is found whichever comes first") {
    const Image empty = filled(7, 7, 0);
    Image dot = empty;
    set(dot, 3, 3, 200);
    // The tolerant difference counts the dot's own pixel only: every other finds black nearby.
    const double share = 1.0 - 1.0 / 49.0;
    CHECK(compare(empty, dot).first.tolerantWithin[0] == Approx(share));
    CHECK(compare(dot, empty).first.tolerantWithin[0] == Approx(share));
    CHECK(compare(dot, empty).first.tolerantMaxLevels == 200);
}

TEST_CASE("the colour of what is transparent does not count") {
    Image here = filled(3, 3, 0), there = filled(3, 3, 255);
    for (std::size_t i = 3; i < here.pixels.size(); i += 4) here.pixels[i] = there.pixels[i] = 0;
    CHECK(compare(here, there).first.maxLevels == 0);
    there.pixels[3] = 255;
    CHECK(compare(here, there).first.maxLevels == 255);
}

TEST_CASE("sizes that differ are refused") {
    CHECK_THROWS_AS(compare(filled(3, 4, 0), filled(4, 3, 0)), Error);
    CHECK_THROWS_AS(compare({}, {}), Error);
}

TEST_CASE("a crop takes the pixels named, and none beyond") {
    Image image = filled(6, 5, 0);
    set(image, 2, 1, 50);
    const Image part = crop(image, {2, 1, 4, 4});
    CHECK(part.width == 4);
    CHECK(part.height == 4);
    CHECK(part.pixels.size() == 64);
    CHECK(part.pixels[0] == 50);
    CHECK(crop(image, {0, 0, 6, 5}) == image);
    CHECK_THROWS_AS(crop(image, {3, 1, 4, 4}), Error);
    CHECK_THROWS_AS(crop(image, {-1, 0, 2, 2}), Error);
    CHECK_THROWS_AS(crop(image, {0, 0, 0, 2}), Error);
    CHECK_THROWS_AS(crop(image, {0, 2147483647, 1, 2147483647}), Error);
}

TEST_CASE("what a mask leaves out does not count") {
    Image here = filled(6, 4, 100), there = here;
    set(there, 5, 3, 255);
    farol::grade::Mask mask;
    farol::grade::hide(mask, 6, 4, {{5, 3, 9, 9}});
    const auto found = compare(here, there, mask).first;
    CHECK(found.maxLevels == 0);
    CHECK(found.counted == Approx(23.0 / 24.0));
    farol::grade::hide(mask, 6, 4, {{0, 0, 6, 4}});
    CHECK_THROWS_AS(compare(here, there, mask), Error);
}

TEST_CASE("coordinate axes of either picture are left out with what is around them") {
    Image here = filled(9, 9, 0), there = here;
    for (int y = 0; y < 9; ++y) set(here, 4, y, 255);
    set(there, 0, 0, 255);
    farol::grade::Mask mask;
    farol::grade::hideAxes(mask, here, there);
    int counted = 0;
    for (const auto one : mask.counts) counted += one;
    CHECK(counted == 81 - 27 - 4);  // three columns, and the corner of two by two
    CHECK(compare(here, there, mask).first.maxLevels == 0);
}

TEST_CASE("a heat map runs from black to white") {
    const Image map = farol::grade::heatMap({3, 1, {0.0F, 1.0F, 7.0F}});
    CHECK(map.pixels[0] == 0);
    CHECK(map.pixels[4] == 252);
    CHECK(map.pixels[8] == 252);
}
