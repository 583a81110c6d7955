#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "image/image.h"
#include "render/plan/frame_plan.h"

/// The yardstick of frame speed: what one writes in an afternoon with OSMesa and libdeflate. One
/// general per-pixel shader (all light types, specular, texture), everything uploaded once, one
/// draw call a mesh in the order given, the picture deflated by one thread. It stays as it is: it
/// shares nothing with the renderer but the meshes, matrices and decoded pictures it is given.
namespace farol::bench {

/// A PNG of RGBA bytes, top row first: RGB, filter Sub, libdeflate level 1.
std::string bareEncode(const std::vector<std::uint8_t>& rgba, int width, int height);

class BareLoop {
  public:
    /// textures[i] is the decoded picture of plan.textures[i].
    BareLoop(const render::FramePlan& plan, const std::vector<image::Image>& textures);
    ~BareLoop();
    BareLoop(const BareLoop&) = delete;
    BareLoop& operator=(const BareLoop&) = delete;

    /// Draws the frame and returns it by bareEncode.
    std::string frame();

  private:
    struct State;
    State* state_;
};

}  // namespace farol::bench
