#pragma once

#include <memory>

#include "render/gl/api.h"
#include "render/gl_facts.h"

namespace farol::render::gl {

/// Source of a context.
enum class Backend {
    osmesa,  ///< in memory, drawn by the processor
    egl      ///< surfaceless; Mesa 25.1 dropped OSMesa
};

/// A GL 4.5 core context without a window.
class Context {
  public:
    virtual ~Context() = default;
    /// Makes the context current on the calling thread.
    virtual void makeCurrent() = 0;
    virtual const Api& api() const = 0;
    virtual const GlFacts& facts() const = 0;
};

/// Creates a context and makes it current. Throws std::runtime_error, which names the backend,
/// where this build or this machine has none.
std::unique_ptr<Context> createContext(Backend backend);

/// Asks the current context. Leaves nothing bound.
GlFacts askFacts(const Api& api);

}  // namespace farol::render::gl
