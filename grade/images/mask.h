#pragma once

#include <vector>

#include "grade/images/plane.h"

namespace farol::grade {

/// Pixels from the top left of a picture.
struct Rectangle {
    int x = 0, y = 0, width = 0, height = 0;
    bool operator==(const Rectangle&) const = default;
};

/// Leaves the pixels within `hidden` out. The rectangles may reach beyond the picture.
void hide(Mask& mask, int width, int height, const std::vector<Rectangle>& hidden);

/// Leaves out pixels that look like a coordinate axis in either image (one channel above 60 of
/// 255, the others below 40) and the pixels around them. Precondition: one size.
void hideAxes(Mask& mask, const image::Image& first, const image::Image& second);

}  // namespace farol::grade
