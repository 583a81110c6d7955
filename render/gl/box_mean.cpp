#include "render/gl/box_mean.h"

#include <algorithm>

namespace farol::render::gl {
namespace {

constexpr std::size_t kStripBytes = 256 << 10;  // stays in the second cache

/// row[i] = the sum of `count` rows of `length` bytes.
void sumRows(const std::uint8_t* rows, int count, std::size_t length, std::uint16_t* row) {
    for (std::size_t i = 0; i < length; ++i) row[i] = rows[i];
    for (int j = 1; j < count; ++j) {
        rows += length;
        for (std::size_t i = 0; i < length; ++i)
            row[i] = static_cast<std::uint16_t>(row[i] + rows[i]);
    }
}

/// Adds kScale pixels of `row` in a row to one of `sums`.
template <int kScale>
void addColumns(const std::uint16_t* row, int width, std::uint16_t* sums) {
    for (int x = 0; x < width; ++x, row += 4 * kScale, sums += 4)
        for (int c = 0; c < 4; ++c) {
            unsigned sum = sums[c];
            for (int i = 0; i < kScale; ++i) sum += row[4 * i + c];
            sums[c] = static_cast<std::uint16_t>(sum);
        }
}

}  // namespace

void BoxMean::begin(int width, int rows) {
    width_ = width;
    rows_ = rows;
    added_ = 0;
    sums_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(rows) * 4, 0);
}

void BoxMean::add(const Target& target, int scale) {
    const std::size_t length =
        static_cast<std::size_t>(width_) * static_cast<std::size_t>(scale) * 4;
    const std::size_t square = length * static_cast<std::size_t>(scale);
    const int atOnce = std::clamp(static_cast<int>(kStripBytes / square), 1, rows_);
    strip_.resize(square * static_cast<std::size_t>(atOnce));
    row_.resize(length);
    std::uint16_t* sums = sums_.data();
    for (int first = 0; first < rows_; first += atOnce) {
        const int count = std::min(atOnce, rows_ - first);
        target.read((rows_ - first - count) * scale, count * scale, strip_.data());
        for (int i = 0; i < count; ++i, sums += static_cast<std::size_t>(width_) * 4) {
            sumRows(strip_.data() + square * static_cast<std::size_t>(i), scale, length,
                    row_.data());
            scale == 3   ? addColumns<3>(row_.data(), width_, sums)
            : scale == 2 ? addColumns<2>(row_.data(), width_, sums)
                         : addColumns<1>(row_.data(), width_, sums);
        }
    }
    added_ += static_cast<unsigned>(scale * scale);
}

void BoxMean::finish(int first, image::Image& image) {
    std::uint8_t* const pixels = image.pixels.data() + static_cast<std::size_t>(first) *
                                                           static_cast<std::size_t>(width_) * 4;
    for (std::size_t i = 0; i < sums_.size(); ++i)
        pixels[i] = static_cast<std::uint8_t>((sums_[i] + added_ / 2) / added_);
    rows_ = 0;
}

}  // namespace farol::render::gl
