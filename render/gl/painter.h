#pragma once

#include <functional>
#include <memory>

#include "render/gl/context.h"
#include "render/image.h"
#include "render/plan.h"

namespace farol::render::gl {

/// Draws frame plans in one GL context. Belongs to the thread that made it.
class Painter {
  public:
    /// Throws std::runtime_error when there is no GL.
    Painter();
    ~Painter();
    Painter(const Painter&) = delete;
    Painter& operator=(const Painter&) = delete;

    /// Called for a texture that is not in GL memory yet. May throw Error image.*.
    using Decode = std::function<Image(const TextureRef&)>;

    struct Timings {
        double drawMs = 0, readbackMs = 0;
    };
    /// The picture of a plan, straight alpha, into `image`, whose memory is used again where it is
    /// as large; counts draw calls into `drawCalls`.
    void draw(const FramePlan& plan, const Decode& decode, Image& image, int& drawCalls,
              Timings& timings);

    const std::string& description() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace farol::render::gl
