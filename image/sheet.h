#pragma once

#include "image/image.h"

namespace farol::image {

/// A grid of images of one size, filled row by row from the top left; transparent where none is.
class Sheet {
  public:
    /// Precondition: both at least 1.
    Sheet(int columns, int rows) : columns_(columns), rows_(rows) {}
    /// Throws std::invalid_argument when the size differs from the first image's or the grid is
    /// full.
    void add(const Image& image);
    Image take() { return std::move(sheet_); }

  private:
    const int columns_, rows_;
    int added_ = 0;
    int width_ = 0, height_ = 0;  ///< of an image, px
    Image sheet_;
};

}  // namespace farol::image
