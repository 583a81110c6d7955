#pragma once

#include <memory>

#include "render/gl/context.h"
#include "render/image.h"
#include "render/plan.h"
#include "render/texture_levels.h"

namespace farol::render::gl {

/// Draws frame plans in one GL context. Belongs to the thread that made it.
class Painter {
  public:
    /// Throws std::runtime_error when there is no GL.
    Painter();
    ~Painter();
    Painter(const Painter&) = delete;
    Painter& operator=(const Painter&) = delete;

    struct Timings {
        double drawMs = 0, readbackMs = 0;
    };
    /// The picture of a plan, straight alpha, into `image`, whose memory is used again where it is
    /// as large; counts draw calls into `drawCalls`. `open` is
    /// called for textures that are not in GL memory yet.
    void draw(const FramePlan& plan, const OpenTexture& open, Image& image, int& drawCalls,
              Timings& timings);

    const std::string& description() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace farol::render::gl
