#pragma once

#include "render/gl/objects.h"
#include "render/image.h"

namespace farol::render::gl {

/// What a frame is drawn into: RGBA8 and 32-bit float depth, with samples, and where there are
/// samples the picture they are resolved into. (OSMesa's own depth buffer has 24 bits at most.)
class Target {
  public:
    /// samples: 1, or what GL gives for antialiasing. Throws std::runtime_error when GL refuses.
    Target(const Api& api, int width, int height, int samples);
    bool fits(int width, int height, int samples) const {
        return width == width_ && height == height_ && samples == samples_;
    }
    void bind() const;
    /// Resolves and reads the picture, top row first, premultiplied alpha as drawn.
    void read(Image& image) const;

  private:
    const Api& api_;
    int width_, height_, samples_;
    Framebuffer drawn_, resolved_;
    Renderbuffer color_, depth_, resolvedColor_;
};

}  // namespace farol::render::gl
