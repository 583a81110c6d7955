#pragma once

#include <string>

#include "image/image.h"
#include "tests/support/ray_caster/tracer.h"

/// How an image of one sample a pixel differs from exact rays.
namespace farol::test {

struct Mismatch {
    int pixels = 0, off = 0;        ///< all; of them off by more than 2 levels
    int inside = 0, insideOff = 0;  ///< away from outlines and creases; off by more than 8 levels
    int worstX = 0, worstY = 0;     ///< the worst of insideOff
    double worst = 0.0;             ///< levels

    /// Share of pixels within 2 levels.
    double share() const { return pixels > 0 ? 1.0 - static_cast<double>(off) / pixels : 1.0; }
};

Mismatch mismatchOf(const reference::Picture& exact, const image::Image& image);

/// Of a document without files, drawn as `image`, against one ray a pixel.
Mismatch mismatchOf(const std::string& xml, const image::Image& image);

}  // namespace farol::test
