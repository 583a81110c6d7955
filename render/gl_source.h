#pragma once

#include "core/enum_words.h"

namespace farol::render {

/// The library that gives the GL context. All are loaded when a context is made, none is linked.
enum class GlSource {
    automatic,  ///< OSMesa where it is installed, else EGL drawn by the processor
    osmesa,     ///< libOSMesa; Mesa has it up to 25.0
    egl,        ///< libEGL without a window, drawn by the processor (llvmpipe)
    eglGpu      ///< libEGL without a window, drawn by the machine's GPU
};
inline constexpr EnumWords<GlSource, GlSource::eglGpu> kGlSourceWords{"auto", "osmesa", "egl",
                                                                      "egl:gpu"};

}  // namespace farol::render
