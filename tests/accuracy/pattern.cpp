#include "tests/accuracy/pattern.h"

#include <cmath>
#include <map>

#include "image/format.h"
#include "image/image.h"

namespace farol::accuracy {
namespace {

/// With creases where points are given twice, and an end on the axis. Stretches are cut in 24:
/// in a long triangle that narrows towards the axis the change of u a pixel is that of its broad
/// end all along, and with it the mipmap level, whatever the number of slices.
std::string profile() {
    constexpr int kParts = 24;
    const std::vector<std::vector<glm::dvec2>> strips{
        {{0, -1}, {0.8, -1}},
        {{0.8, -1}, {1.1, -0.3}, {0.7, 0.4}, {0.4, 0.7}},
        {{0.4, 0.7}, {0, 1.2}},
    };
    std::string points;
    int count = 0;
    const auto add = [&](const glm::dvec2& p) {
        points += std::to_string(p.x) + " " + std::to_string(p.y) + " 0\n";
        ++count;
    };
    for (const auto& strip : strips) {
        add(strip[0]);
        for (std::size_t i = 1; i < strip.size(); ++i)
            for (int k = 1; k <= kParts; ++k)
                add(glm::mix(strip[i - 1], strip[i], static_cast<double>(k) / kParts));
    }
    return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count) +
           "\nproperty float x\nproperty float y\nproperty float z\nend_header\n" + points;
}

/// Smooth waves over fine noise, no power of two: what a filter gets wrong shows.
std::uint8_t alphaAt(PatternAlpha alpha, double u, double v, double texel) {
    double value = 1.0;
    if (alpha == PatternAlpha::waves)
        value = 0.5 + 0.4 * std::sin(6.2831853 * u) * std::cos(6.2831853 * v);
    if (alpha == PatternAlpha::holes) {
        // Four by four, a texel from in to out.
        const double away =
            std::hypot(u * 4.0 - std::floor(u * 4.0) - 0.5, v * 4.0 - std::floor(v * 4.0) - 0.5);
        value = std::fmin(1.0, std::fmax(0.0, (away - 0.3) / (4.0 * texel) + 0.5));
    }
    return static_cast<std::uint8_t>(std::lround(255.0 * value));
}

image::Image pattern(int width, int height, PatternAlpha alpha) {
    image::Image image{width, height, {}};
    std::uint32_t state = 7;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < 3; ++c) {
                state = state * 1664525U + 1013904223U;
                const double wave =
                    std::sin(6.2831853 * (x * (c + 1.0) / width + y * 2.0 / height));
                const double noise = static_cast<double>(state >> 24U) / 255.0 - 0.5;
                image.pixels.push_back(
                    static_cast<std::uint8_t>(std::lround(127.5 + 70.0 * wave + 60.0 * noise)));
            }
            image.pixels.push_back(
                alphaAt(alpha, (x + 0.5) / width, (y + 0.5) / height, 1.0 / height));
        }
    return image;
}

}  // namespace

Supplies supplies(int width, int height, PatternAlpha alpha) {
    const image::Image image = pattern(width, height, alpha);
    reference::Pixels pixels{width, height, {}};
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        (i % 4 == 3 ? pixels.alpha : pixels.rgb).push_back(image.pixels[i]);
    Supplies all;
    all.assets = std::make_shared<scene::BundleAssets>(std::map<std::string, std::string>{
        {"it.png", image::encodePng(image)}, {"profile.ply", profile()}});
    all.files.texts["profile.ply"] = profile();
    all.files.pictures["it.png"] = pixels;
    return all;
}

}  // namespace farol::accuracy
