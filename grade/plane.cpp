#include "grade/plane.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>

#include "scene/error.h"

namespace farol::grade {
namespace {

/// Four floats that are added and multiplied at once: g++ 12 makes no such of plain loops at -O2.
using Four = float __attribute__((vector_size(16)));
/// Columns that are summed at once: as many as stay in registers.
constexpr std::size_t kLanes = 16;

Four four(const float* from) {
    Four out;
    std::memcpy(&out, from, sizeof out);
    return out;
}

/// out[x] = sum over t of weights[t] * rows[t][x]. `count` is a multiple of kLanes.
void weigh(const std::vector<const float*>& rows, const std::vector<float>& weights,
           std::size_t count, float* out) {
    const std::size_t taps = weights.size();
    for (std::size_t x = 0; x < count; x += kLanes) {
        Four a{}, b{}, c{}, d{};
        for (std::size_t t = 0; t < taps; ++t) {
            const float* from = rows[t] + x;
            const float weight = weights[t];
            a += weight * four(from);
            b += weight * four(from + 4);
            c += weight * four(from + 8);
            d += weight * four(from + 12);
        }
        const std::array<Four, kLanes / 4> sums{a, b, c, d};
        std::memcpy(out + x, sums.data(), sizeof sums);
    }
}

std::size_t lanesOf(int width) {
    return (static_cast<std::size_t>(width) + kLanes - 1) / kLanes * kLanes;
}

}  // namespace

FloatImage::FloatImage(const render::Image& image) : FloatImage(image.width, image.height) {
    for (std::size_t i = 0; i < red.values.size(); ++i) {
        const std::uint8_t* from = &image.pixels[4 * i];
        const float scale = static_cast<float>(from[3]) / (255.0F * 255.0F);
        red.values[i] = scale * from[0];
        green.values[i] = scale * from[1];
        blue.values[i] = scale * from[2];
    }
}

Summary summarize(const Plane& plane, const Mask& mask) {
    std::vector<float> counted;
    counted.reserve(plane.values.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < plane.values.size(); ++i) {
        if (!mask(i)) continue;
        counted.push_back(plane.values[i]);
        sum += static_cast<double>(plane.values[i]);
    }
    if (counted.empty()) return {};
    const auto rank = [&](double share) {
        const double wanted = std::ceil(share * static_cast<double>(counted.size()));
        const auto place = counted.begin() + static_cast<std::ptrdiff_t>(std::max(1.0, wanted)) - 1;
        std::nth_element(counted.begin(), place, counted.end());
        return static_cast<double>(*place);
    };
    return {.mean = sum / static_cast<double>(counted.size()),
            .median = rank(0.5),
            .p95 = rank(0.95),
            .p99 = rank(0.99),
            .max = rank(1.0)};
}

Plane filter(const Plane& plane, const std::vector<float>& across, const std::vector<float>& down) {
    const auto width = static_cast<std::size_t>(plane.width);
    const std::size_t stride = lanesOf(plane.width);
    const std::size_t reach = across.size() / 2;
    std::vector<float> padded(stride + 2 * reach);
    std::vector<const float*> taps(across.size());
    for (std::size_t t = 0; t < taps.size(); ++t) taps[t] = padded.data() + t;
    std::vector<float> rows(stride * static_cast<std::size_t>(plane.height));
    for (std::size_t y = 0; y < static_cast<std::size_t>(plane.height); ++y) {
        const float* from = &plane.values[y * width];
        std::fill_n(padded.begin(), reach, from[0]);
        std::copy_n(from, width, padded.begin() + static_cast<std::ptrdiff_t>(reach));
        std::fill(padded.begin() + static_cast<std::ptrdiff_t>(reach + width), padded.end(),
                  from[width - 1]);
        weigh(taps, across, stride, &rows[y * stride]);
    }
    Plane out{plane.width, plane.height, std::vector<float>(plane.values.size())};
    const int below = static_cast<int>(down.size() / 2);
    taps.resize(down.size());
    std::vector<float> row(stride);
    for (int y = 0; y < plane.height; ++y) {
        for (int t = 0; t < static_cast<int>(down.size()); ++t)
            taps[static_cast<std::size_t>(t)] =
                &rows[static_cast<std::size_t>(std::clamp(y + t - below, 0, plane.height - 1)) *
                      stride];
        weigh(taps, down, stride, row.data());
        std::copy_n(
            row.begin(), width,
            out.values.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y) * width));
    }
    return out;
}

std::vector<float> gaussian(double sigma, int radius) {
    std::vector<double> weights;
    double sum = 0.0;
    for (int x = -radius; x <= radius; ++x) {
        weights.push_back(std::exp(-x * x / (2.0 * sigma * sigma)));
        sum += weights.back();
    }
    std::vector<float> scaled;
    for (const double weight : weights) scaled.push_back(static_cast<float>(weight / sum));
    return scaled;
}

void requireSameSize(int widthA, int heightA, int widthB, int heightB) {
    if (widthA == widthB && heightA == heightB && widthA > 0 && heightA > 0) return;
    const auto text = [](int width, int height) {
        return std::to_string(width) + "x" + std::to_string(height);
    };
    throw Error("image.size", "the pictures are of " + text(widthA, heightA) + " and of " +
                                  text(widthB, heightB) + " pixels: only equal sizes compare");
}

}  // namespace farol::grade
