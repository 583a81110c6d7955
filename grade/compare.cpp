#include "grade/compare.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "scene/error.h"

namespace farol::grade {
namespace {

using Pixel = std::array<std::uint8_t, 4>;

struct Pixels {
    explicit Pixels(const render::Image& image) : width(image.width), height(image.height) {
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

std::array<std::uint8_t, 4> show(const Pixel& first, int tolerant) {
    const int grey = (first[0] + first[1] + first[2]) / 12;
    const auto faded = static_cast<std::uint8_t>(grey);
    return {static_cast<std::uint8_t>(std::min(255, grey + 8 * tolerant)), faded, faded, 255};
}

std::string sizeOf(const render::Image& image) {
    return std::to_string(image.width) + "x" + std::to_string(image.height);
}

}  // namespace

std::pair<Comparison, render::Image> compare(const render::Image& first,
                                             const render::Image& second) {
    if (first.width != second.width || first.height != second.height || first.pixels.empty())
        throw Error("image.size", "the pictures are of " + sizeOf(first) + " and of " +
                                      sizeOf(second) + " pixels: only equal sizes compare");
    const Pixels a(first), b(second);
    Comparison result{.width = a.width, .height = a.height};
    render::Image shown{a.width, a.height, {}};
    shown.pixels.reserve(first.pixels.size());
    double squares = 0.0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            const Pixel &here = a.at(x, y), &there = b.at(x, y);
            const int plain = difference(here, there);
            const int tolerant = std::max(leastAround(here, b, x, y), leastAround(there, a, x, y));
            squares += squaredError(here, there);
            result.meanLevels += plain;
            result.tolerantMeanLevels += tolerant;
            result.maxLevels = std::max(result.maxLevels, plain);
            result.tolerantMaxLevels = std::max(result.tolerantMaxLevels, tolerant);
            for (std::size_t i = 0; i < kLevels.size(); ++i) {
                if (plain <= kLevels[i]) result.within[i] += 1.0;
                if (tolerant <= kLevels[i]) result.tolerantWithin[i] += 1.0;
            }
            const Pixel pixel = show(here, tolerant);
            shown.pixels.insert(shown.pixels.end(), pixel.begin(), pixel.end());
        }
    const auto count = static_cast<double>(a.all.size());
    result.meanLevels /= count;
    result.tolerantMeanLevels /= count;
    for (double& share : result.within) share /= count;
    for (double& share : result.tolerantWithin) share /= count;
    result.psnrDb = squares > 0.0 ? 10.0 * std::log10(255.0 * 255.0 * 3.0 * count / squares)
                                  : std::numeric_limits<double>::infinity();
    return {result, std::move(shown)};
}

render::Image crop(const render::Image& image, int x, int y, int width, int height) {
    if (x < 0 || y < 0 || width < 1 || height < 1 || x > image.width - width ||
        y > image.height - height)
        throw Error("image.crop", "a crop of " + std::to_string(width) + "x" +
                                      std::to_string(height) + "+" + std::to_string(x) + "+" +
                                      std::to_string(y) + " reaches beyond a picture of " +
                                      sizeOf(image));
    render::Image part{width, height, {}};
    const auto rowBytes = static_cast<std::ptrdiff_t>(width) * 4;
    for (int row = y; row < y + height; ++row) {
        const auto begin =
            image.pixels.begin() + (static_cast<std::ptrdiff_t>(row) * image.width + x) * 4;
        part.pixels.insert(part.pixels.end(), begin, begin + rowBytes);
    }
    return part;
}

}  // namespace farol::grade
