#include "grade/images/plane.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "core/error.h"
#include "grade/messages.h"

namespace farol::grade {
namespace {

/// Floats that are added and multiplied at once: g++ 12 makes no such of plain loops at -O2.
template <std::size_t kBytes>
struct Vector {
    using Type [[gnu::vector_size(kBytes)]] = float;
};
/// Columns that are summed at once: as many as stay in registers.
constexpr std::size_t kLanes = 32;

/// out[x] = sum over t of weights[t] * rows[t][x], in this order for any vector size: the sums are
/// the same on every machine. `count` is a multiple of kLanes.
template <std::size_t kBytes>
[[gnu::always_inline]] inline void weighBy(const float* const* rows, const float* weights,
                                           std::size_t taps, std::size_t count, float* out) {
    using Floats = typename Vector<kBytes>::Type;
    constexpr std::size_t kEach = kBytes / sizeof(float), kSums = 4, kAtOnce = kSums * kEach;
    for (std::size_t x = 0; x < count; x += kAtOnce) {
        Floats sums[kSums] = {};
        for (std::size_t t = 0; t < taps; ++t) {
            const float* from = rows[t] + x;
            for (std::size_t i = 0; i < kSums; ++i) {
                Floats some;
                std::memcpy(&some, from + i * kEach, sizeof some);
                sums[i] += weights[t] * some;
            }
        }
        std::memcpy(out + x, sums, sizeof sums);
    }
}

void weighPlain(const float* const* rows, const float* weights, std::size_t taps, std::size_t count,
                float* out) {
    weighBy<16>(rows, weights, taps, count, out);
}

#ifdef __x86_64__
[[gnu::target("avx2")]] void weighWide(const float* const* rows, const float* weights,
                                       std::size_t taps, std::size_t count, float* out) {
    weighBy<32>(rows, weights, taps, count, out);
}
#endif

void weigh(const std::vector<const float*>& rows, const std::vector<float>& weights,
           std::size_t count, float* out) {
#ifdef __x86_64__
    static const bool kWide = __builtin_cpu_supports("avx2");
    if (kWide) return weighWide(rows.data(), weights.data(), weights.size(), count, out);
#endif
    weighPlain(rows.data(), weights.data(), weights.size(), count, out);
}

std::size_t lanesOf(int width) {
    return (static_cast<std::size_t>(width) + kLanes - 1) / kLanes * kLanes;
}

}  // namespace

FloatImage::FloatImage(const image::Image& image) : FloatImage(image.width, image.height) {
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
    auto begin = counted.begin();  // values before it are below the previous rank
    const auto rank = [&](double share) {
        const double wanted = std::ceil(share * static_cast<double>(counted.size()));
        const auto place = counted.begin() + static_cast<std::ptrdiff_t>(std::max(1.0, wanted)) - 1;
        std::nth_element(begin, place, counted.end());
        begin = place;
        return static_cast<double>(*place);
    };
    Summary out{.mean = sum / static_cast<double>(counted.size())};
    out.median = rank(0.5);
    out.p95 = rank(0.95);
    out.p99 = rank(0.99);
    out.max = rank(1.0);
    return out;
}

Rows filterAcross(const Plane& plane, const std::vector<float>& weights) {
    const auto width = static_cast<std::size_t>(plane.width);
    const std::size_t reach = weights.size() / 2;
    Rows out{plane.width, plane.height, lanesOf(plane.width), {}};
    out.values.resize(out.stride * static_cast<std::size_t>(plane.height));
    std::vector<float> padded(out.stride + 2 * reach);
    std::vector<const float*> taps(weights.size());
    for (std::size_t t = 0; t < taps.size(); ++t) taps[t] = padded.data() + t;
    for (std::size_t y = 0; y < static_cast<std::size_t>(plane.height); ++y) {
        const float* from = &plane.values[y * width];
        std::fill_n(padded.begin(), reach, from[0]);
        std::copy_n(from, width, padded.begin() + static_cast<std::ptrdiff_t>(reach));
        std::fill(padded.begin() + static_cast<std::ptrdiff_t>(reach + width), padded.end(),
                  from[width - 1]);
        weigh(taps, weights, out.stride, &out.values[y * out.stride]);
    }
    return out;
}

Plane filterDown(const Rows& rows, const std::vector<float>& weights) {
    const auto width = static_cast<std::size_t>(rows.width);
    Plane out{rows.width, rows.height,
              std::vector<float>(width * static_cast<std::size_t>(rows.height))};
    const int reach = static_cast<int>(weights.size() / 2);
    std::vector<const float*> taps(weights.size());
    std::vector<float> row(rows.stride);
    for (int y = 0; y < rows.height; ++y) {
        for (int t = 0; t < static_cast<int>(weights.size()); ++t)
            taps[static_cast<std::size_t>(t)] =
                &rows.values[static_cast<std::size_t>(
                                 std::clamp(y + t - reach, 0, rows.height - 1)) *
                             rows.stride];
        weigh(taps, weights, rows.stride, row.data());
        std::copy_n(
            row.begin(), width,
            out.values.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y) * width));
    }
    return out;
}

Plane filter(const Plane& plane, const std::vector<float>& across, const std::vector<float>& down) {
    return filterDown(filterAcross(plane, across), down);
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
        return std::to_string(width) + " x " + std::to_string(height);
    };
    throw Error(message<"image.size">("first"_arg = text(widthA, heightA),
                                      "second"_arg = text(widthB, heightB)));
}

}  // namespace farol::grade
