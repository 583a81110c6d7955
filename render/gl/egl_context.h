#pragma once

#include <memory>

#include "render/gl/context.h"

namespace farol::render::gl {

/// Creates a context without a window by EGL: Mesa's surfaceless platform, else a device. On a
/// GPU where `onGpu`, else drawn by the processor. Throws std::runtime_error where there is none.
std::unique_ptr<Context> createEglContext(bool onGpu);

}  // namespace farol::render::gl
