#pragma once

#include "render/gl_source.h"

namespace farol::render::gl {

/// By how much llvmpipe's rasteriser moves a vertex at most, px: it has 8 bits below the pixel (its
/// FIXED_ORDER), where Mesa reports GL's least of 4.
inline constexpr double kLlvmpipeSnapPx = 1.0 / 512.0;

/// Sets the variables of the environment that Mesa reads when a context of `source` is made:
/// - GALLIVM_PERF makes llvmpipe filter 8-bit textures in floats: in 8-bit arithmetic, its default,
///   they are 0.41 to 0.53 levels rms off the exact filter instead of 0.32 to 0.40, for 6 to 12 %
///   less time of a textured frame (docs/benchmarks/accuracy.md). A value that is there stays.
/// - LIBGL_ALWAYS_SOFTWARE keeps EGL from a GPU, unless `source` asks for one.
/// The first call has to precede all threads: it moves the environment, which others may be reading
/// (image decoders do). Later calls for the same source change nothing.
void setMesaVariables(GlSource source);

}  // namespace farol::render::gl
