#include <algorithm>
#include <cstring>

#include "image/image.h"

namespace farol::image {
namespace {

/// 8 fractional bits, so that rounding does not add up from level to level.
struct Fixed {
    int width, height;
    std::vector<std::uint16_t> values;
};

/// Weights of source texels for one target texel, scaled to add up to `source` (exact integers).
struct Span {
    int first;
    int count;
    std::uint32_t weights[3];
};

std::vector<Span> spans(int source, int target) {
    // Target texel t covers [t*source, (t+1)*source) in units of 1/target source texels.
    std::vector<Span> all(static_cast<std::size_t>(target));
    for (int t = 0; t < target; ++t) {
        Span& span = all[static_cast<std::size_t>(t)];
        const std::int64_t begin = std::int64_t{t} * source;
        const std::int64_t end = begin + source;
        span.first = static_cast<int>(begin / target);
        span.count = 0;
        for (std::int64_t at = span.first; at * target < end && span.count < 3; ++at) {
            const std::int64_t from = std::max(begin, at * target);
            const std::int64_t to = std::min(end, (at + 1) * target);
            span.weights[span.count++] = static_cast<std::uint32_t>(to - from);
        }
    }
    return all;
}

/// The four channels of a texel, 16 bits each.
std::uint64_t loadTexel(const std::uint16_t* from) {
    std::uint64_t texel = 0;
    std::memcpy(&texel, from, sizeof texel);
    return texel;
}

/// Averages four texels of equal weight; equals the general case without its divisions. Texels of 8
/// bits give units of 1/256.
void halveEven(const std::uint8_t* from, Fixed& to) {
    const std::size_t stride = static_cast<std::size_t>(to.width) * 8;
    std::vector<std::uint16_t> sums(stride);
    std::uint16_t* out = to.values.data();
    for (int y = 0; y < to.height; ++y, from += 2 * stride) {
        for (std::size_t i = 0; i < stride; ++i)
            sums[i] = static_cast<std::uint16_t>(from[i] + from[stride + i]);
        for (std::size_t x = 0; x < stride; x += 8, out += 4) {
            // 4 * 255 * 64 are 16 bits: no channel carries into another.
            const std::uint64_t mean = (loadTexel(&sums[x]) + loadTexel(&sums[x + 4])) << 6U;
            std::memcpy(out, &mean, sizeof mean);
        }
    }
}

void halveEven(const std::uint16_t* from, Fixed& to) {
    constexpr std::uint64_t kLow = 0x0003000300030003U, kTwo = 0x0002000200020002U;
    const std::size_t stride = static_cast<std::size_t>(to.width) * 8;
    std::uint16_t* out = to.values.data();
    for (int y = 0; y < to.height; ++y, from += 2 * stride)
        for (std::size_t x = 0; x < stride; x += 8, out += 4) {
            // Quarters and their remainders apart, as the sum has 18 bits.
            std::uint64_t quarters = 0, rest = kTwo;
            for (const std::size_t at : {x, x + 4, stride + x, stride + x + 4}) {
                const std::uint64_t texel = loadTexel(from + at);
                quarters += (texel >> 2U) & ~(kLow << 14U);
                rest += texel & kLow;
            }
            const std::uint64_t mean = quarters + ((rest >> 2U) & kLow);
            std::memcpy(out, &mean, sizeof mean);
        }
}

Fixed halve(const Fixed& from) {
    Fixed to{std::max(1, from.width / 2), std::max(1, from.height / 2), {}};
    to.values.resize(static_cast<std::size_t>(to.width) * static_cast<std::size_t>(to.height) * 4);
    if (from.width % 2 == 0 && from.height % 2 == 0) {
        halveEven(from.values.data(), to);
        return to;
    }
    const std::vector<Span> columns = spans(from.width, to.width);
    const std::vector<Span> rows = spans(from.height, to.height);
    const std::uint64_t total =
        static_cast<std::uint64_t>(from.width) * static_cast<std::uint64_t>(from.height);
    std::size_t out = 0;
    for (const Span& row : rows) {
        for (const Span& column : columns) {
            std::uint64_t sum[4] = {total / 2, total / 2, total / 2, total / 2};
            for (int j = 0; j < row.count; ++j) {
                const std::size_t line =
                    static_cast<std::size_t>(row.first + j) * static_cast<std::size_t>(from.width);
                for (int i = 0; i < column.count; ++i) {
                    const std::uint64_t weight = std::uint64_t{row.weights[j]} * column.weights[i];
                    const std::uint16_t* texel =
                        &from.values[(line + static_cast<std::size_t>(column.first + i)) * 4];
                    for (int c = 0; c < 4; ++c) sum[c] += weight * texel[c];
                }
            }
            for (const std::uint64_t one : sum)
                to.values[out++] = static_cast<std::uint16_t>(one / total);
        }
    }
    return to;
}

}  // namespace

bool isOpaque(const Image& image) {
    // A row at a time, without a branch for each pixel.
    const std::size_t stride = static_cast<std::size_t>(image.width) * 4;
    for (std::size_t row = 0; row < image.pixels.size(); row += stride) {
        std::uint8_t all = 255;
        for (std::size_t i = row + 3; i < row + stride; i += 4) all &= image.pixels[i];
        if (all != 255) return false;
    }
    return true;
}

std::vector<Image> buildMipmaps(const Image& base) {
    std::vector<Image> levels;
    Fixed level{base.width, base.height, {}};
    const bool even = base.width % 2 == 0 && base.height % 2 == 0;
    if (!even) {
        level.values.resize(base.pixels.size());
        std::transform(base.pixels.begin(), base.pixels.end(), level.values.begin(),
                       [](std::uint8_t v) { return static_cast<std::uint16_t>(v << 8); });
    }
    while (level.width > 1 || level.height > 1) {
        if (even && levels.empty()) {
            // Reads the base image directly, which saves twice its size in memory.
            level = Fixed{base.width / 2, base.height / 2, {}};
            level.values.resize(base.pixels.size() / 4);
            halveEven(base.pixels.data(), level);
        } else {
            level = halve(level);
        }
        Image image{level.width, level.height, {}};
        image.pixels.resize(level.values.size());
        std::transform(
            level.values.begin(), level.values.end(), image.pixels.begin(), [](std::uint16_t v) {
                return static_cast<std::uint8_t>(std::min<unsigned>(255U, (v + 128U) >> 8));
            });
        levels.push_back(std::move(image));
    }
    return levels;
}

}  // namespace farol::image
