#pragma once

#include <memory>

#include "image/image.h"
#include "render/gl/context.h"
#include "render/plan/frame_plan.h"
#include "render/plan/texture_levels.h"

namespace farol::render::gl {

/// Executes the passes of frame plans in one GL context. Belongs to the thread that made it.
class Painter {
  public:
    explicit Painter(std::unique_ptr<Context> context);
    ~Painter();
    Painter(const Painter&) = delete;
    Painter& operator=(const Painter&) = delete;

    struct Timings {
        double drawMs = 0, readbackMs = 0;
    };
    /// The picture of a plan, straight alpha, into `image`, whose memory is used again where it is
    /// as large. `open` is called for textures that are not in GL memory yet. Their alphas become
    /// known here: the passes are composed anew where some are not opaque. Counts draw calls and
    /// layers in the plan's statistics; adds findings about textures' files and layers. GL errors
    /// and state that an earlier plan left have no effect on this one.
    void draw(FramePlan& plan, const OpenTexture& open, image::Image& image, Timings& timings,
              Diagnostics& findings);

    const GlFacts& facts() const;
    /// Since it was made: maps that are as in the frame before are not drawn again.
    int shadowMapsDrawn() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace farol::render::gl
