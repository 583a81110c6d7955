#include "image/sheet.h"

#include <algorithm>
#include <stdexcept>

namespace farol::image {

void Sheet::add(const Image& image) {
    if (added_ == 0) {
        width_ = image.width;
        height_ = image.height;
        sheet_.width = width_ * columns_;
        sheet_.height = height_ * rows_;
        sheet_.pixels.assign(
            static_cast<std::size_t>(sheet_.width) * static_cast<std::size_t>(sheet_.height) * 4,
            0);
    }
    if (added_ == columns_ * rows_) throw std::invalid_argument("the sheet is full");
    if (image.width != width_ || image.height != height_)
        throw std::invalid_argument("the images differ in size");
    const auto bytes = static_cast<std::ptrdiff_t>(width_) * 4;
    const std::ptrdiff_t left = added_ % columns_ * bytes, top = added_ / columns_ * height_;
    for (std::ptrdiff_t y = 0; y < height_; ++y)
        std::copy_n(image.pixels.begin() + y * bytes, bytes,
                    sheet_.pixels.begin() + (top + y) * sheet_.width * 4 + left);
    ++added_;
}

}  // namespace farol::image
