#pragma once

#include <optional>

#include "grade/images/mask.h"
#include "image/image_file.h"

namespace farol::grade {

/// Returns the client area of a screenshot of a window: the part without the title bar (a strip of
/// one colour with text on it, 12 to 80 px high, across the top) and the borders (lines of slowly
/// changing colour that differ from the next line inwards, up to 12 px a side). The whole image
/// where no title bar is found.
/// `expected`: size of the client area, if known. A screenshot of that size is used as it is;
/// borders that look like the content are cut to that size.
Rectangle clientArea(const image::Image& screenshot,
                     const std::optional<image::ImageSize>& expected = {});

}  // namespace farol::grade
