#pragma once

#include <string>

#include "image/image.h"
#include "tests/support/ray_caster/tracer.h"

/// How an image of one sample a pixel differs from exact rays.
namespace farol::test {

struct Mismatch {
    int pixels = 0, off = 0;        ///< all; of them off by more than 2 levels
    int inside = 0, insideOff = 0;  ///< away from outlines and creases; off by more than 8 levels
    int beside = 0;                 ///< of insideOff: an exact ray within kBesidePx sees the same
    int worstX = 0, worstY = 0;     ///< the worst of the others
    double worst = 0.0;             ///< levels

    /// Share of pixels within 2 levels.
    double share() const { return pixels > 0 ? 1.0 - static_cast<double>(off) / pixels : 1.0; }
};

/// The default bound of outlines, and the rasteriser's grid.
inline constexpr double kBesidePx = 0.25 + 1.0 / 64.0;

Mismatch mismatchOf(const reference::World& world, const image::Image& image);

/// Of a document without files, drawn as `image`, against one ray a pixel.
Mismatch mismatchOf(const std::string& xml, const image::Image& image);

}  // namespace farol::test
