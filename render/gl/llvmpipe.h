#pragma once

namespace farol::render::gl {

/// By how much llvmpipe's rasteriser moves a vertex at most, px: it has 8 bits below the pixel (its
/// FIXED_ORDER), where Mesa reports GL's least of 4.
inline constexpr double kLlvmpipeSnapPx = 1.0 / 512.0;

/// Makes llvmpipe filter 8-bit textures in floats: in 8-bit arithmetic, its default, they are 0.41
/// to 0.53 levels rms off the exact filter instead of 0.32 to 0.40, for 6 to 12 % less time of a
/// textured frame (docs/benchmarks/accuracy.md). It reads a variable of the environment when the
/// first context is made; a value that is there already stays.
void chooseExactFilters();

}  // namespace farol::render::gl
