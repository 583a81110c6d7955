#pragma once

#include <optional>

#include "grade/images/mask.h"
#include "image/image_file.h"

namespace farol::grade {

/// Where the picture is within a screenshot of a window: what is left without the title bar (a
/// strip of one colour with something written on it, 12 to 80 px high, across the top) and the
/// borders (lines of slowly changing colour that differ from the line within, up to 12 px a
/// side). The whole picture where no title bar is found.
/// `expected` is the size that the picture within should have: a screenshot of that size is used
/// as it is; borders that look like the content are cut to that size.
Rectangle clientArea(const image::Image& screenshot,
                     const std::optional<image::ImageSize>& expected = {});

}  // namespace farol::grade
