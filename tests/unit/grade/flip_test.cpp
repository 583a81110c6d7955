#include "grade/images/flip.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.h"

// Pictures of one colour pass the filters unchanged and have no features: what is left of FLIP can
// be worked out by hand from the paper's formulas.
namespace {

using farol::grade::flip;
using farol::grade::FloatImage;

FloatImage filled(float red, float green, float blue, int width = 32, int height = 24) {
    FloatImage image(width, height);
    std::fill(image.red.values.begin(), image.red.values.end(), red);
    std::fill(image.green.values.begin(), image.green.values.end(), green);
    std::fill(image.blue.values.begin(), image.blue.values.end(), blue);
    return image;
}

/// L* of a grey display value, CIE 1976.
double lightness(double value) {
    const double y = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
    return y > 216.0 / 24389.0 ? 116.0 * std::cbrt(y) - 16.0 : y * 24389.0 / 27.0;
}

// HyAB of green and blue to the power 0.7. L*a*b* of the sRGB primaries (D65, as tabulated
// everywhere): green 87.737, -86.185, 83.181; blue 32.303, 79.197, -107.864; Hunt scales a* and b*
// by 0.01 L*.
double largest() {
    const double da = -86.185 * 0.87737 - 79.197 * 0.32303;
    const double db = 83.181 * 0.87737 + 107.864 * 0.32303;
    return std::pow(87.737 - 32.303 + std::sqrt(da * da + db * db), 0.7);
}

double greys(double first, double second) {
    const double power = std::pow(std::abs(lightness(first) - lightness(second)), 0.7);
    const double knee = 0.4 * largest();
    return power < knee ? 0.95 / knee * power : 0.95 + (power - knee) / (largest() - knee) * 0.05;
}

}  // namespace

TEST_CASE("FLIP of equal pictures is 0") {
    const auto map = flip(filled(0.2F, 0.5F, 0.9F), filled(0.2F, 0.5F, 0.9F));
    CHECK(farol::grade::summarize(map).max == 0.0);
}

TEST_CASE("FLIP of plain greys is what the paper's formulas give by hand") {
    for (const auto& [a, b] : {std::pair{0.0, 1.0}, {0.5, 0.55}, {0.0, 0.02}, {0.2, 0.8}}) {
        const auto first = static_cast<float>(a), second = static_cast<float>(b);
        const auto map = flip(filled(first, first, first), filled(second, second, second));
        INFO(a << " and " << b);
        // Tabulated L*a*b* has three decimals.
        CHECK(map.at(0, 0) == Approx(greys(a, b)).epsilon(1e-3));
        CHECK(map.at(17, 11) == Approx(greys(a, b)).epsilon(1e-3));
    }
}

TEST_CASE("FLIP is largest between green and blue") {
    CHECK(flip(filled(0, 1, 0), filled(0, 0, 1)).at(5, 5) == Approx(1.0).epsilon(1e-4));
    CHECK(flip(filled(1, 0, 0), filled(0, 0, 1)).at(5, 5) < 1.0);
}

TEST_CASE("FLIP is the same both ways, and shifts with the pictures") {
    FloatImage here = filled(0.1F, 0.1F, 0.1F, 64, 48), there = here;
    for (int y = 20; y < 30; ++y) there.green.values[static_cast<std::size_t>(y * 64 + 30)] = 0.9F;
    const auto forth = flip(here, there), back = flip(there, here);
    CHECK(forth.values == back.values);
    FloatImage moved = here;
    for (int y = 20; y < 30; ++y) moved.green.values[static_cast<std::size_t>(y * 64 + 31)] = 0.9F;
    const auto shifted = flip(here, moved);
    CHECK(shifted.at(31, 25) == Approx(forth.at(30, 25)).epsilon(1e-4));
}

TEST_CASE("FLIP sees a fine pattern less than a coarse one, and less the finer the screen") {
    FloatImage grey = filled(0.5F, 0.5F, 0.5F, 64, 64), fine = grey, coarse = grey;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            for (farol::grade::Plane* plane : {&fine.red, &fine.green, &fine.blue}) {
                const auto i = static_cast<std::size_t>(y * 64 + x);
                plane->values[i] += (x + y) % 2 ? 0.2F : -0.2F;
            }
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            for (farol::grade::Plane* plane : {&coarse.red, &coarse.green, &coarse.blue}) {
                const auto i = static_cast<std::size_t>(y * 64 + x);
                plane->values[i] += (x / 16 + y / 16) % 2 ? 0.2F : -0.2F;
            }
    const auto mean = [&](const FloatImage& test, double pixelsPerDegree) {
        return farol::grade::summarize(flip(farol::grade::FlipPicture(grey, pixelsPerDegree),
                                            farol::grade::FlipPicture(test, pixelsPerDegree)))
            .mean;
    };
    CHECK(mean(fine, 67.0) < 0.5 * mean(coarse, 67.0));
    CHECK(mean(fine, 120.0) < mean(fine, 30.0));
}

TEST_CASE("FLIP grows where an edge or a point appears") {
    FloatImage flat = filled(0.5F, 0.5F, 0.5F, 80, 40), edge = flat;
    for (int y = 0; y < 40; ++y)
        for (int x = 40; x < 80; ++x)
            for (farol::grade::Plane* plane : {&edge.red, &edge.green, &edge.blue})
                plane->values[static_cast<std::size_t>(y * 80 + x)] = 0.7F;
    const auto map = flip(flat, edge);
    CHECK(map.at(79, 20) == Approx(greys(0.5, 0.7)).epsilon(1e-3));  // far from the edge
    CHECK(map.at(42, 20) > map.at(79, 20));                          // at it
}

TEST_CASE("FLIP refuses pictures of two sizes") {
    CHECK_THROWS_AS(flip(filled(0, 0, 0, 8, 8), filled(0, 0, 0, 8, 9)), farol::Error);
}

TEST_CASE("the percentiles of a plane are its own values") {
    farol::grade::Plane plane{10, 10, {}};
    for (int i = 1; i <= 100; ++i) plane.values.push_back(static_cast<float>(101 - i));
    const auto found = farol::grade::summarize(plane);
    CHECK(found.mean == 50.5);
    CHECK(found.median == 50.0);
    CHECK(found.p95 == 95.0);
    CHECK(found.p99 == 99.0);
    CHECK(found.max == 100.0);
}
