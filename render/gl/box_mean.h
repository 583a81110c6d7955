#pragma once

#include <cstdint>
#include <vector>

#include "image/image.h"
#include "render/gl/target.h"

namespace farol::render::gl {

/// The mean of squares of pixels over passes, for a band of rows of an image: sums of integers,
/// which no order changes, rounded to levels once.
class BoxMean {
  public:
    /// A band of `rows` rows of `width` pixels of the image.
    void begin(int width, int rows);
    bool begun() const { return rows_ > 0; }
    void drop() { rows_ = 0; }
    /// Adds a pass: squares of `scale` by `scale` pixels of `target`, whose top row is the band's.
    void add(const Target& target, int scale);
    /// Writes the band into `image`, of the size that it has to have, from the row `first` on, and
    /// ends it.
    void finish(int first, image::Image& image);

  private:
    std::vector<std::uint8_t> strip_;  ///< some rows of the target
    std::vector<std::uint16_t> row_;   ///< sums of its columns
    std::vector<std::uint16_t> sums_;  ///< of the band, four a pixel
    int width_ = 0, rows_ = 0;
    unsigned added_ = 0;  ///< to each sum, 257 at most
};

}  // namespace farol::render::gl
