#include "grade/measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>

namespace farol::grade {
namespace {

/// A picture's channel planes on black, and the extremes of the 3x3 pixels around each.
struct Extremes {
    explicit Extremes(const render::Image& image) : width(image.width), height(image.height) {
        const std::size_t row = 3 * static_cast<std::size_t>(width);
        levels.resize(row * static_cast<std::size_t>(height));
        for (std::size_t i = 0; i < levels.size() / 3; ++i) {
            const std::uint8_t* from = &image.pixels[4 * i];
            for (std::size_t c = 0; c < 3; ++c)
                levels[3 * i + c] =
                    from[3] == 255 ? from[c]
                                   : static_cast<std::uint8_t>((from[c] * from[3] + 127) / 255);
        }
        std::vector<std::uint8_t> lowRow(levels.size()), highRow(levels.size());
        for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y)
            for (std::size_t i = 0; i < row; ++i) {
                const std::size_t at = y * row + i;
                const std::uint8_t left = i >= 3 ? levels[at - 3] : levels[at];
                const std::uint8_t right = i + 3 < row ? levels[at + 3] : levels[at];
                lowRow[at] = std::min(std::min(left, right), levels[at]);
                highRow[at] = std::max(std::max(left, right), levels[at]);
            }
        low.resize(levels.size());
        high.resize(levels.size());
        for (std::size_t at = 0; at < levels.size(); ++at) {
            const std::size_t above = at >= row ? at - row : at;
            const std::size_t below = at + row < levels.size() ? at + row : at;
            low[at] = std::min(std::min(lowRow[above], lowRow[below]), lowRow[at]);
            high[at] = std::max(std::max(highRow[above], highRow[below]), highRow[at]);
        }
    }
    int beyond(std::size_t at, std::uint8_t level) const {
        return level < low[at] ? low[at] - level : level > high[at] ? level - high[at] : 0;
    }
    int width, height;
    std::vector<std::uint8_t> levels, low, high;
};

std::array<std::uint8_t, 3> borderColor(const render::Image& image) {
    std::map<std::array<std::uint8_t, 3>, int> counts;
    const auto count = [&](int x, int y) {
        const std::uint8_t* p =
            &image.pixels[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                               static_cast<std::size_t>(x))];
        ++counts[{p[0], p[1], p[2]}];
    };
    for (int x = 0; x < image.width; ++x) {
        count(x, 0);
        count(x, image.height - 1);
    }
    for (int y = 0; y < image.height; ++y) {
        count(0, y);
        count(image.width - 1, y);
    }
    return std::max_element(counts.begin(), counts.end(),
                            [](const auto& a, const auto& b) { return a.second < b.second; })
        ->first;
}

}  // namespace

Plane beyondAPixel(const render::Image& first, const render::Image& second, int full) {
    requireSameSize(first.width, first.height, second.width, second.height);
    if (first == second)
        return {first.width, first.height, std::vector<float>(first.pixels.size() / 4)};
    const Extremes a(first), b(second);
    Plane out{first.width, first.height, std::vector<float>(first.pixels.size() / 4)};
    for (std::size_t i = 0; i < out.values.size(); ++i) {
        int worst = 0;
        for (std::size_t c = 3 * i; c < 3 * i + 3; ++c)
            worst = std::max(worst, std::max(a.beyond(c, b.levels[c]), b.beyond(c, a.levels[c])));
        out.values[i] = std::min(1.0F, static_cast<float>(worst) / static_cast<float>(full));
    }
    return out;
}

Mask contentOf(const render::Image& reference, const render::Image& submission) {
    constexpr int kSame = 6;  // levels
    const std::array<std::uint8_t, 3> back = borderColor(reference);
    Mask mask;
    mask.counts.resize(reference.pixels.size() / 4);
    std::size_t counted = 0;
    for (std::size_t i = 0; i < mask.counts.size(); ++i) {
        bool shows = false;
        for (std::size_t c = 0; c < 3; ++c)
            shows = shows || std::abs(reference.pixels[4 * i + c] - back[c]) > kSame ||
                    std::abs(submission.pixels[4 * i + c] - back[c]) > kSame;
        mask.counts[i] = shows ? 1 : 0;
        counted += shows ? 1 : 0;
    }
    if (counted * 1000 < mask.counts.size()) mask.counts.clear();
    return mask;
}

Mask both(const Mask& a, const Mask& b) {
    if (a.counts.empty()) return b;
    if (b.counts.empty()) return a;
    Mask out = a;
    for (std::size_t i = 0; i < out.counts.size(); ++i) out.counts[i] &= b.counts[i];
    return out;
}

double shareOf(const Plane& plane, const Mask& mask, double least) {
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < plane.values.size(); ++i) {
        if (!mask(i)) continue;
        sum += static_cast<double>(plane.values[i]);
        count += 1.0;
    }
    return sum / std::max(least, count);
}

std::vector<std::uint32_t> idsOf(const render::Image& layer) {
    std::vector<std::uint32_t> ids(layer.pixels.size() / 4);
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const std::uint8_t* p = &layer.pixels[4 * i];
        ids[i] = (std::uint32_t{p[0]} << 16U) | (std::uint32_t{p[1]} << 8U) | p[2];
    }
    return ids;
}

double uncovered(const std::vector<std::uint32_t>& reference,
                 const std::vector<std::uint32_t>& submission, int width, int height) {
    struct Counts {
        double pixels = 0, shared = 0, missed = 0;
    };
    if (reference == submission) return 0.0;
    std::map<std::uint32_t, Counts> objects;
    std::uint32_t last = 0;  // neighbours mostly show the same object
    Counts* counts = nullptr;
    const auto of = [&](std::uint32_t id) -> Counts& {
        if (counts == nullptr || id != last) counts = &objects[last = id];
        return *counts;
    };
    const auto near = [&](const std::vector<std::uint32_t>& in, int x, int y, std::uint32_t id) {
        for (int v = std::max(0, y - 1); v <= std::min(height - 1, y + 1); ++v)
            for (int u = std::max(0, x - 1); u <= std::min(width - 1, x + 1); ++u)
                if (in[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
                       static_cast<std::size_t>(u)] == id)
                    return true;
        return false;
    };
    std::size_t at = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x, ++at) {
            const std::uint32_t theirs = reference[at], mine = submission[at];
            if (theirs == mine) {
                if (theirs == 0) continue;
                Counts& one = of(theirs);
                one.pixels += 1.0;
                one.shared += 1.0;
                continue;
            }
            for (const auto& [id, others] :
                 {std::pair<std::uint32_t, const std::vector<std::uint32_t>&>{theirs, submission},
                  {mine, reference}}) {
                if (id == 0) continue;
                Counts& one = of(id);
                one.pixels += 1.0;
                (near(others, x, y, id) ? one.shared : one.missed) += 1.0;
            }
        }
    double sum = 0.0, weights = 0.0;
    for (const auto& [id, one] : objects) {
        const double weight = std::sqrt(one.pixels);
        sum += weight * one.missed / (one.shared + one.missed);
        weights += weight;
    }
    return weights > 0.0 ? sum / weights : 0.0;
}

Mask shared(const std::vector<std::uint32_t>& reference,
            const std::vector<std::uint32_t>& submission) {
    Mask mask;
    mask.counts.resize(reference.size());
    for (std::size_t i = 0; i < reference.size(); ++i)
        mask.counts[i] = reference[i] != 0 && reference[i] == submission[i] ? 1 : 0;
    return mask;
}

}  // namespace farol::grade
