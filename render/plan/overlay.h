#pragma once

#include <string>

#include "image/image.h"

namespace farol::render {

/// Writes lines of ASCII text (others show as '?') into the picture, white on a darkened strip,
/// from the top left corner, `scale` px a font unit (1..8; letters are about 7 units high). Text
/// that does not fit is cut off.
void drawText(image::Image& image, const std::string& text, int scale);

}  // namespace farol::render
