#include "grade/images/compare.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "core/error.h"
#include "grade/images/flip.h"
#include "grade/images/ssim.h"
#include "grade/messages.h"

namespace farol::grade {
namespace {

using Pixel = std::array<std::uint8_t, 4>;

struct Pixels {
    explicit Pixels(const image::Image& image) : width(image.width), height(image.height) {
        all.resize(image.pixels.size() / 4);
        for (std::size_t i = 0; i < all.size(); ++i) {
            const std::uint8_t* from = &image.pixels[4 * i];
            const unsigned alpha = from[3];
            for (std::size_t c = 0; c < 3; ++c)
                all[i][c] = static_cast<std::uint8_t>((from[c] * alpha + 127U) / 255U);
            all[i][3] = from[3];
        }
    }
    const Pixel& at(int x, int y) const {
        return all[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                   static_cast<std::size_t>(x)];
    }
    int width, height;
    std::vector<Pixel> all;
};

int difference(const Pixel& a, const Pixel& b) {
    int worst = 0;
    for (std::size_t c = 0; c < a.size(); ++c)
        worst = std::max(worst, std::abs(int{a[c]} - int{b[c]}));
    return worst;
}

int leastAround(const Pixel& wanted, const Pixels& in, int x, int y) {
    int least = difference(wanted, in.at(x, y));
    for (int v = std::max(0, y - 1); v <= std::min(in.height - 1, y + 1) && least > 0; ++v)
        for (int u = std::max(0, x - 1); u <= std::min(in.width - 1, x + 1) && least > 0; ++u)
            least = std::min(least, difference(wanted, in.at(u, v)));
    return least;
}

double squaredError(const Pixel& a, const Pixel& b) {
    double sum = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
        const double d = double(a[c]) - double(b[c]);
        sum += d * d;
    }
    return sum;
}

void add(Comparison& result, int plain, int tolerant) {
    result.meanLevels += plain;
    result.tolerantMeanLevels += tolerant;
    result.maxLevels = std::max(result.maxLevels, plain);
    result.tolerantMaxLevels = std::max(result.tolerantMaxLevels, tolerant);
    for (std::size_t i = 0; i < kLevels.size(); ++i) {
        if (plain <= kLevels[i]) result.within[i] += 1.0;
        if (tolerant <= kLevels[i]) result.tolerantWithin[i] += 1.0;
    }
}

std::array<std::uint8_t, 4> show(const Pixel& first, int tolerant) {
    const int grey = (first[0] + first[1] + first[2]) / 12;
    const auto faded = static_cast<std::uint8_t>(grey);
    return {static_cast<std::uint8_t>(std::min(255, grey + 8 * tolerant)), faded, faded, 255};
}

}  // namespace

std::pair<Comparison, image::Image> compare(const image::Image& first, const image::Image& second,
                                            const Mask& mask) {
    requireSameSize(first.width, first.height, second.width, second.height);
    const Pixels a(first), b(second);
    Comparison result{.width = a.width, .height = a.height};
    image::Image shown{a.width, a.height, {}};
    shown.pixels.reserve(first.pixels.size());
    double squares = 0.0;
    std::size_t counted = 0, at = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x, ++at) {
            const Pixel &here = a.at(x, y), &there = b.at(x, y);
            int tolerant = 0;
            if (mask(at)) {
                ++counted;
                tolerant = std::max(leastAround(here, b, x, y), leastAround(there, a, x, y));
                squares += squaredError(here, there);
                add(result, difference(here, there), tolerant);
            }
            const Pixel pixel = show(here, tolerant);
            shown.pixels.insert(shown.pixels.end(), pixel.begin(), pixel.end());
        }
    if (counted == 0) throw Error(message<"image.mask">());
    const auto count = static_cast<double>(counted);
    result.counted = count / static_cast<double>(a.all.size());
    result.meanLevels /= count;
    result.tolerantMeanLevels /= count;
    for (double& share : result.within) share /= count;
    for (double& share : result.tolerantWithin) share /= count;
    result.psnrDb = squares > 0.0 ? 10.0 * std::log10(255.0 * 255.0 * 3.0 * count / squares)
                                  : std::numeric_limits<double>::infinity();
    const FloatImage floatA(first), floatB(second);
    result.flip = summarize(flip(floatA, floatB), mask);
    if (a.width > 2 * kSsimReach && a.height > 2 * kSsimReach)
        result.ssim = summarize(ssim(floatA, floatB), ssimMask(mask, a.width, a.height)).mean;
    return {result, std::move(shown)};
}

image::Image crop(const image::Image& image, const Rectangle& part) {
    const auto [x, y, width, height] = part;
    if (x < 0 || y < 0 || width < 1 || height < 1 || x > image.width - width ||
        y > image.height - height)
        throw Error(message<"image.crop">("crop"_arg = std::to_string(width) + "x" +
                                                       std::to_string(height) + "+" +
                                                       std::to_string(x) + "+" + std::to_string(y),
                                          "width"_arg = image.width, "height"_arg = image.height));
    image::Image out{width, height, {}};
    const auto rowBytes = static_cast<std::ptrdiff_t>(width) * 4;
    for (int row = y; row < y + height; ++row) {
        const auto begin =
            image.pixels.begin() + (static_cast<std::ptrdiff_t>(row) * image.width + x) * 4;
        out.pixels.insert(out.pixels.end(), begin, begin + rowBytes);
    }
    return out;
}

std::string coarseMask(const Plane& plane) {
    constexpr float kDiffers = 0.25F;
    constexpr int kShare = 20;
    std::string out;
    for (int row = 0; row < kMaskRows; ++row)
        for (int column = 0; column < kMaskColumns; ++column) {
            int all = 0, different = 0;
            for (int y = row * plane.height / kMaskRows; y < (row + 1) * plane.height / kMaskRows;
                 ++y)
                for (int x = column * plane.width / kMaskColumns;
                     x < (column + 1) * plane.width / kMaskColumns; ++x, ++all)
                    different += plane.at(x, y) >= kDiffers ? 1 : 0;
            out += all > 0 && kShare * different >= all ? '1' : '0';
        }
    return out;
}

image::Image heatMap(const Plane& plane) {
    constexpr std::array<std::array<float, 3>, 6> kColors{
        {{0, 0, 4}, {84, 15, 109}, {187, 55, 84}, {249, 142, 9}, {250, 220, 90}, {252, 255, 245}}};
    image::Image out{plane.width, plane.height, {}};
    out.pixels.reserve(plane.values.size() * 4);
    for (const float value : plane.values) {
        const float place = std::clamp(value, 0.0F, 1.0F) * (kColors.size() - 1);
        const std::size_t step =
            std::min<std::size_t>(kColors.size() - 2, static_cast<std::size_t>(place));
        const float rest = place - static_cast<float>(step);
        for (std::size_t c = 0; c < 3; ++c)
            out.pixels.push_back(static_cast<std::uint8_t>(
                kColors[step][c] + rest * (kColors[step + 1][c] - kColors[step][c]) + 0.5F));
        out.pixels.push_back(255);
    }
    return out;
}

}  // namespace farol::grade
