#pragma once

#include <memory>
#include <string>

#include "render/gl/api.h"

namespace farol::render::gl {

/// A GL 4.5 core context without a window. OSMesa is the one backend today; Mesa 25.1 dropped it,
/// so a surfaceless EGL one is to fit in behind this interface.
class Context {
  public:
    virtual ~Context() = default;
    /// Makes the context current on the calling thread.
    virtual void makeCurrent() = 0;
    virtual const Api& api() const = 0;
    /// "llvmpipe (LLVM ...), 4.5 (Core Profile) Mesa 22.3.6"
    virtual const std::string& description() const = 0;
};

/// Creates an OSMesa context and makes it current. Throws std::runtime_error when there is none.
std::unique_ptr<Context> createOsMesaContext();

}  // namespace farol::render::gl
