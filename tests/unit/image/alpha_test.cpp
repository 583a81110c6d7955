#include "image/alpha.h"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace farol::image;

namespace {

/// White texels of these alphas in rows of `width`.
Image alphas(int width, const std::vector<int>& values) {
    Image image{width, static_cast<int>(values.size()) / width, {}};
    for (const int value : values)
        for (const int c : {255, 255, 255, value})
            image.pixels.push_back(static_cast<std::uint8_t>(c));
    return image;
}

/// A disc of about 50 % of the area, with an edge of `soft` texels.
Image disc(int side, double soft) {
    std::vector<int> values;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const double away = std::hypot(x + 0.5 - side / 2.0, y + 0.5 - side / 2.0);
            values.push_back(
                static_cast<int>(255.0 * std::clamp((0.4 * side - away) / soft + 0.5, 0.0, 1.0)));
        }
    return alphas(side, values);
}

double coverage(const Image& image) {
    int there = 0;
    for (std::size_t i = 3; i < image.pixels.size(); i += 4)
        there += image.pixels[i] >= kHalfAlpha ? 1 : 0;
    return static_cast<double>(there) / (static_cast<double>(image.pixels.size()) / 4.0);
}

}  // namespace

TEST_CASE("alphas are opaque, cut-out or blended") {
    CHECK(classifyAlpha(alphas(2, {255, 255, 255, 255})) == Alpha::opaque);
    CHECK(classifyAlpha(alphas(2, {0, 0, 0, 0})) == Alpha::opaque);  // left unset
    CHECK(classifyAlpha(alphas(2, {0, 255, 255, 0})) == Alpha::cutOut);
    CHECK(classifyAlpha(alphas(2, {128, 255, 255, 255})) == Alpha::blended);
    CHECK(classifyAlpha(alphas(2, {254, 255, 255, 255})) == Alpha::blended);  // nothing is off
    CHECK(classifyAlpha(alphas(2, {0, 255, 100, 0})) == Alpha::blended);      // a quarter between
    CHECK(classifyAlpha(disc(64, 1.0)) == Alpha::cutOut);
    CHECK(classifyAlpha(disc(64, 30.0)) == Alpha::blended);
}

TEST_CASE("texels that are not there have no weight in mipmaps") {
    Image image = alphas(2, {255, 0, 0, 0});
    image.pixels[0] = 200;  // there
    image.pixels[4] = 10;   // not there
    premultiply(image);
    CHECK(image.pixels[0] == 200);
    CHECK(image.pixels[4] == 0);
    const std::vector<Image> levels = buildMipmaps(image);
    CHECK(levels[0].pixels[0] == 50);  // of an alpha of a quarter: 200
    CHECK(levels[0].pixels[3] == 64);
}

TEST_CASE("cut-outs keep their coverage from level to level") {
    for (const int side : {64, 100, 256}) {
        // Thin bars: means of them are all under half.
        std::vector<int> values;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) values.push_back(x % 8 < 3 ? 255 : 0);
        for (Image image : {alphas(side, values), disc(side, 1.0)}) {
            premultiply(image);
            std::vector<Image> levels = buildMipmaps(image);
            const double whole = coverage(image);
            preserveCoverage(image, levels);
            CAPTURE(side, whole);
            for (const Image& level : levels) {
                if (level.width < 8) break;  // few texels have few shares
                CHECK(std::abs(coverage(level) - whole) < 0.2);
                for (std::size_t i = 0; i < level.pixels.size(); i += 4)
                    CHECK(level.pixels[i] <= level.pixels[i + 3]);
            }
        }
    }
}
