#pragma once

#include <memory>

#include "render/gl/api.h"
#include "render/gl_facts.h"
#include "render/gl_source.h"

namespace farol::render::gl {

/// A GL 4.5 core context without a window.
class Context {
  public:
    virtual ~Context() = default;
    /// Makes the context current on the calling thread.
    virtual void makeCurrent() = 0;
    virtual const Api& api() const = 0;
    virtual const GlFacts& facts() const = 0;
};

/// Creates a context and makes it current. Throws std::runtime_error, which names the source, where
/// this machine has none.
std::unique_ptr<Context> createContext(GlSource source);

/// Asks the current context. Leaves nothing bound.
GlFacts askFacts(const Api& api);

}  // namespace farol::render::gl
