#include "grade/images/ssim.h"

#include <catch2/catch.hpp>
#include <random>

#include "core/error.h"

namespace {

using farol::grade::FloatImage;
using farol::grade::ssim;
using farol::grade::summarize;

FloatImage grey(int width, int height, float level) {
    FloatImage image(width, height);
    for (farol::grade::Plane* plane : {&image.red, &image.green, &image.blue})
        std::fill(plane->values.begin(), plane->values.end(), level);
    return image;
}

}  // namespace

TEST_CASE("SSIM of equal pictures is 1") {
    FloatImage noise(20, 20);
    std::mt19937 random(1);
    for (farol::grade::Plane* plane : {&noise.red, &noise.green, &noise.blue})
        for (float& value : plane->values) value = static_cast<float>(random() % 256) / 255.0F;
    const auto found = summarize(ssim(noise, noise));
    CHECK(found.mean == Approx(1.0));
    CHECK(found.median == Approx(1.0));
}

TEST_CASE("SSIM of plain greys is the luminance term alone") {
    const double a = 0.2, b = 0.6, c1 = 0.0001;
    const auto plane = ssim(grey(13, 12, 0.2F), grey(13, 12, 0.6F));
    CHECK(plane.width == 3);
    CHECK(plane.height == 2);
    CHECK(plane.at(1, 1) == Approx((2 * a * b + c1) / (a * a + b * b + c1)).epsilon(1e-4));
}

TEST_CASE("SSIM of a pattern and its negative is the structure term by hand") {
    // Columns alternate 0.25 and 0.75. Over the window the mean is 0.5 and the variance 1/16 but
    // for what the Gaussian leaves of the pattern's own mean, which the second test value shows.
    FloatImage here(31, 31), there(31, 31);
    double even = 0.0;
    const auto weights = farol::grade::gaussian(1.5, 5);
    for (std::size_t t = 1; t < weights.size(); t += 2) even += static_cast<double>(weights[t]);
    for (int y = 0; y < 31; ++y)
        for (int x = 0; x < 31; ++x)
            for (std::size_t c = 0; c < 3; ++c) {
                const auto i = static_cast<std::size_t>(y * 31 + x);
                (c == 0   ? here.red
                 : c == 1 ? here.green
                          : here.blue)
                    .values[i] = x % 2 ? 0.75F : 0.25F;
                (c == 0   ? there.red
                 : c == 1 ? there.green
                          : there.blue)
                    .values[i] = x % 2 ? 0.25F : 0.75F;
            }
    // The window at the odd column 5 + 10 has its middle on a light column; `even` is the weight
    // of every second column from its second on: those of the other value.
    const double meanA = 0.75 - 0.5 * even, meanB = 0.25 + 0.5 * even;
    const double variance = 0.25 * even * (1.0 - even);
    const double c1 = 0.0001, c2 = 0.0009;
    const double expected = (2 * meanA * meanB + c1) * (-2 * variance + c2) /
                            ((meanA * meanA + meanB * meanB + c1) * (2 * variance + c2));
    CHECK(ssim(here, there).at(10, 10) == Approx(expected).epsilon(1e-3));
}

TEST_CASE("SSIM takes windows within the pictures only, and their part of a mask") {
    CHECK_THROWS_AS(ssim(grey(10, 11, 0), grey(10, 11, 0)), farol::Error);
    CHECK_THROWS_AS(ssim(grey(12, 11, 0), grey(11, 12, 0)), farol::Error);
    farol::grade::Mask mask;
    mask.counts.assign(12 * 11, 0);
    mask.counts[5 * 12 + 6] = 1;
    CHECK(farol::grade::ssimMask(mask, 12, 11).counts == std::vector<std::uint8_t>{0, 1});
}
