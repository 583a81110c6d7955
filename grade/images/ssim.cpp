#include "grade/images/ssim.h"

#include <string>

#include "core/error.h"
#include "grade/messages.h"

namespace farol::grade {
namespace {

constexpr float kC1 = 0.01F * 0.01F, kC2 = 0.03F * 0.03F;
constexpr double kSigmaPx = 1.5;

/// About the middle: variances are small differences of floats.
constexpr float kMiddle = 0.5F;

Plane luminance(const FloatImage& image) {
    Plane out = image.red;
    for (std::size_t i = 0; i < out.values.size(); ++i)
        out.values[i] = 0.299F * image.red.values[i] + 0.587F * image.green.values[i] +
                        0.114F * image.blue.values[i] - kMiddle;
    return out;
}

/// The weighted mean of a * b over each window.
Plane meanProduct(const Plane& a, const Plane& b, const std::vector<float>& weights) {
    Plane product = a;
    for (std::size_t i = 0; i < product.values.size(); ++i) product.values[i] *= b.values[i];
    return filter(product, weights, weights);
}

}  // namespace

Plane ssim(const FloatImage& first, const FloatImage& second) {
    const int width = first.width(), height = first.height();
    requireSameSize(width, height, second.width(), second.height());
    if (width <= 2 * kSsimReach || height <= 2 * kSsimReach)
        throw Error(message<"image.size/ssim">("min"_arg = 2 * kSsimReach + 1));
    const std::vector<float> weights = gaussian(kSigmaPx, kSsimReach);
    const Plane a = luminance(first), b = luminance(second);
    const Plane meanA = filter(a, weights, weights), meanB = filter(b, weights, weights);
    const Plane aa = meanProduct(a, a, weights), bb = meanProduct(b, b, weights),
                ab = meanProduct(a, b, weights);
    Plane out{width - 2 * kSsimReach, height - 2 * kSsimReach, {}};
    out.values.reserve(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
    for (int y = kSsimReach; y < height - kSsimReach; ++y)
        for (int x = kSsimReach; x < width - kSsimReach; ++x) {
            const float ma = meanA.at(x, y), mb = meanB.at(x, y);
            const float covariance = ab.at(x, y) - ma * mb;
            const float variances = (aa.at(x, y) - ma * ma) + (bb.at(x, y) - mb * mb);
            const float la = ma + kMiddle, lb = mb + kMiddle;
            const float both = la * lb, squares = la * la + lb * lb;
            out.values.push_back((2.0F * both + kC1) * (2.0F * covariance + kC2) /
                                 ((squares + kC1) * (variances + kC2)));
        }
    return out;
}

Mask ssimMask(const Mask& mask, int width, int height) {
    Mask out;
    if (mask.counts.empty()) return out;
    for (int y = kSsimReach; y < height - kSsimReach; ++y)
        for (int x = kSsimReach; x < width - kSsimReach; ++x)
            out.counts.push_back(
                mask.counts[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                            static_cast<std::size_t>(x)]);
    return out;
}

}  // namespace farol::grade
