#include "grade/images/measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <map>

namespace farol::grade {
namespace {

/// A picture's bytes as shown on black: the picture's own, where nothing of it is transparent.
class OnBlack {
  public:
    explicit OnBlack(const image::Image& image)
        : stride_(4 * static_cast<std::size_t>(image.width)), bytes_(image.pixels.data()) {
        unsigned all = 255;
        for (std::size_t i = 3; i < image.pixels.size(); i += 4) all &= image.pixels[i];
        if (all == 255) return;
        made_ = image.pixels;
        for (std::size_t i = 0; i < made_.size(); i += 4) {
            const int alpha = made_[i + 3];
            for (std::size_t c = i; c < i + 3; ++c)
                made_[c] = static_cast<std::uint8_t>((made_[c] * alpha + 127) / 255);
            made_[i + 3] = 255;
        }
        bytes_ = made_.data();
    }
    const std::uint8_t* row(std::size_t y) const { return bytes_ + y * stride_; }

  private:
    std::size_t stride_;
    const std::uint8_t* bytes_;
    std::vector<std::uint8_t> made_;
};

/// The extremes of the 3x3 pixels around each of a row, by channel. The loops are plain ones over
/// bytes, which compilers make vectors of.
class Extremes {
  public:
    Extremes(const image::Image& image, const OnBlack& bytes)
        : bytes_(bytes),
          width_(4 * static_cast<std::size_t>(image.width)),
          height_(static_cast<std::size_t>(image.height)),
          padded_(width_ + 8),
          low_(width_),
          high_(width_) {}

    void moveTo(std::size_t y) {
        const std::uint8_t* above = bytes_.row(y > 0 ? y - 1 : y);
        const std::uint8_t* here = bytes_.row(y);
        const std::uint8_t* below = bytes_.row(y + 1 < height_ ? y + 1 : y);
        // Down first, then across with the border's pixels repeated.
        across(low_.data(), above, here, below,
               [](std::uint8_t a, std::uint8_t b) { return b < a ? b : a; });
        across(high_.data(), above, here, below,
               [](std::uint8_t a, std::uint8_t b) { return b > a ? b : a; });
    }
    const std::uint8_t* low() const { return low_.data(); }
    const std::uint8_t* high() const { return high_.data(); }

  private:
    template <typename Choose>
    void across(std::uint8_t* out, const std::uint8_t* above, const std::uint8_t* here,
                const std::uint8_t* below, Choose choose) {
        std::uint8_t* down = padded_.data() + 4;
        for (std::size_t i = 0; i < width_; ++i)
            down[i] = choose(choose(above[i], below[i]), here[i]);
        for (std::size_t c = 0; c < 4; ++c) {
            padded_[c] = down[c];
            down[width_ + c] = down[width_ - 4 + c];
        }
        for (std::size_t i = 0; i < width_; ++i)
            out[i] = choose(choose(down[i], padded_[i]), padded_[i + 8]);
    }

    const OnBlack& bytes_;
    std::size_t width_, height_;
    std::vector<std::uint8_t> padded_, low_, high_;
};

/// Raises each byte of `worst` to the distance of `levels` from low..high if that is larger.
void raise(std::uint8_t* worst, const std::uint8_t* levels, const Extremes& around,
           std::size_t count) {
    const std::uint8_t *low = around.low(), *high = around.high();
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint8_t level = levels[i];
        const auto under = static_cast<std::uint8_t>((low[i] > level ? low[i] : level) - level);
        const auto over = static_cast<std::uint8_t>((level > high[i] ? level : high[i]) - high[i]);
        const std::uint8_t more = under > over ? under : over;
        worst[i] = more > worst[i] ? more : worst[i];
    }
}

std::array<std::uint8_t, 3> borderColor(const image::Image& image) {
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

Plane beyondAPixel(const image::Image& first, const image::Image& second, int full) {
    requireSameSize(first.width, first.height, second.width, second.height);
    Plane out{first.width, first.height, std::vector<float>(first.pixels.size() / 4)};
    if (first == second) return out;
    std::array<float, 256> shares{};
    for (std::size_t i = 0; i < shares.size(); ++i)
        shares[i] = std::min(1.0F, static_cast<float>(i) / static_cast<float>(full));
    const OnBlack a(first), b(second);
    Extremes aroundA(first, a), aroundB(second, b);
    const std::size_t bytes = 4 * static_cast<std::size_t>(first.width);
    const auto height = static_cast<std::size_t>(first.height);
    const auto equal = [&](std::size_t y) {
        return std::equal(a.row(y), a.row(y) + bytes, b.row(y));
    };
    std::vector<std::uint8_t> worst(bytes);
    for (std::size_t y = 0; y < height; ++y) {
        // A row that is the same in both is within the other's range.
        if (equal(y)) continue;
        aroundA.moveTo(y);
        aroundB.moveTo(y);
        std::fill(worst.begin(), worst.end(), std::uint8_t{0});
        raise(worst.data(), b.row(y), aroundA, bytes);
        raise(worst.data(), a.row(y), aroundB, bytes);
        float* row = &out.values[y * static_cast<std::size_t>(first.width)];
        for (std::size_t i = 0; i < bytes; i += 4)
            row[i / 4] = shares[std::max({worst[i], worst[i + 1], worst[i + 2]})];
    }
    return out;
}

Rectangle differing(const image::Image& first, const image::Image& second) {
    const std::size_t bytes = 4 * static_cast<std::size_t>(first.width);
    int left = first.width, right = 0, top = first.height, bottom = 0;
    for (int y = 0; y < first.height; ++y) {
        const auto a = first.pixels.begin() + static_cast<std::ptrdiff_t>(bytes) * y;
        const auto b = second.pixels.begin() + static_cast<std::ptrdiff_t>(bytes) * y;
        const auto end = a + static_cast<std::ptrdiff_t>(bytes);
        const auto begin = std::mismatch(a, end, b).first;
        if (begin == end) continue;
        top = std::min(top, y);
        bottom = y + 1;
        left = std::min(left, static_cast<int>((begin - a) / 4));
        const auto last =
            std::mismatch(std::make_reverse_iterator(end), std::make_reverse_iterator(a),
                          std::make_reverse_iterator(b + (end - a)))
                .first;
        right = std::max(right, static_cast<int>((last.base() - a - 1) / 4 + 1));
    }
    if (right == 0) return {};
    return {left, top, right - left, bottom - top};
}

Mask contentOf(const image::Image& reference, const image::Image& submission) {
    constexpr std::uint8_t kSame = 6;  // levels
    const std::array<std::uint8_t, 3> back = borderColor(reference);
    const std::uint8_t red = back[0], green = back[1], blue = back[2];
    const auto apart = [](std::uint8_t a, std::uint8_t b) {
        return static_cast<std::uint8_t>(a > b ? a - b : b - a);
    };
    Mask mask;
    mask.counts.resize(reference.pixels.size() / 4);
    std::size_t counted = 0;
    const std::uint8_t *a = reference.pixels.data(), *b = submission.pixels.data();
    for (std::size_t i = 0; i < mask.counts.size(); ++i, a += 4, b += 4) {
        const std::uint8_t most =
            std::max({apart(a[0], red), apart(a[1], green), apart(a[2], blue), apart(b[0], red),
                      apart(b[1], green), apart(b[2], blue)});
        mask.counts[i] = most > kSame ? 1 : 0;
        counted += mask.counts[i];
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

std::vector<std::uint32_t> idsOf(const image::Image& layer) {
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
