#include "image/alpha.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace farol::image {
namespace {

constexpr std::size_t kAlphas = 256;
constexpr int kOff = 8, kOn = 247;         // alphas under and over count as off and on
constexpr std::size_t kEdgeTexelsIn = 10;  // at most one texel in so many is between

using Histogram = std::array<std::size_t, kAlphas>;

Histogram histogramOf(const Image& image) {
    Histogram counts{};
    for (std::size_t i = 3; i < image.pixels.size(); i += 4) ++counts[image.pixels[i]];
    return counts;
}

/// Share of texels with an alpha of at least `least`.
double shareFrom(const Histogram& counts, int least) {
    std::size_t found = 0, all = 0;
    for (std::size_t a = 0; a < kAlphas; ++a) {
        all += counts[a];
        if (a >= static_cast<std::size_t>(least)) found += counts[a];
    }
    return all == 0 ? 0.0 : static_cast<double>(found) / static_cast<double>(all);
}

/// The least alpha whose texels, with all above, cover nearest to `share`; the one nearest to half
/// among equals.
int thresholdFor(const Histogram& counts, double share) {
    int best = kHalfAlpha;
    double least = std::abs(shareFrom(counts, best) - share);
    for (int away = 1; away < kHalfAlpha; ++away)
        for (const int at : {kHalfAlpha - away, kHalfAlpha + away}) {
            const double apart = std::abs(shareFrom(counts, at) - share);
            if (apart >= least) continue;
            least = apart;
            best = at;
        }
    return best;
}

}  // namespace

Alpha classifyAlpha(const Image& image) {
    if (isOpaque(image)) return Alpha::opaque;
    const Histogram counts = histogramOf(image);
    std::size_t off = 0, between = 0;
    for (std::size_t a = 0; a < kAlphas; ++a) {
        if (a < kOff) off += counts[a];
        if (a >= kOff && a <= kOn) between += counts[a];
    }
    const std::size_t all = image.pixels.size() / 4;
    if (counts[0] == all) return Alpha::opaque;
    return off > 0 && between * kEdgeTexelsIn <= all ? Alpha::cutOut : Alpha::blended;
}

void premultiply(Image& image) {
    for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
        const unsigned alpha = image.pixels[i + 3];
        if (alpha == 255) continue;
        for (std::size_t c = 0; c < 3; ++c)
            image.pixels[i + c] =
                static_cast<std::uint8_t>((image.pixels[i + c] * alpha + 127U) / 255U);
    }
}

void preserveCoverage(const Image& base, std::vector<Image>& levels) {
    const double share = shareFrom(histogramOf(base), kHalfAlpha);
    for (Image& level : levels) {
        const int threshold = thresholdFor(histogramOf(level), share);
        if (threshold == kHalfAlpha) continue;
        for (std::size_t i = 0; i < level.pixels.size(); i += 4) {
            const int alpha = level.pixels[i + 3];
            if (alpha == 0) continue;
            const int scaled =
                std::min(255, (2 * alpha * kHalfAlpha + threshold) / (2 * threshold));
            for (std::size_t c = 0; c < 3; ++c)
                level.pixels[i + c] = static_cast<std::uint8_t>(
                    std::min(scaled, (2 * level.pixels[i + c] * scaled + alpha) / (2 * alpha)));
            level.pixels[i + 3] = static_cast<std::uint8_t>(scaled);
        }
    }
}

}  // namespace farol::image
