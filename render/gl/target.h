#pragma once

#include <cstdint>
#include <vector>

#include "render/gl/objects.h"
#include "render/image.h"

namespace farol::render::gl {

/// What a frame is drawn into: RGBA and 32-bit float depth, with samples, and where there are
/// samples the picture they are resolved into. (OSMesa's own depth buffer has 24 bits at most.)
class Target {
  public:
    /// 8 bits a channel for a picture in one pass; 16 where passes are added up, so that they are
    /// rounded to levels once.
    enum class Channels { bits8, bits16 };

    /// samples: 1, or what GL gives for antialiasing. Throws std::bad_alloc when GL refuses.
    Target(const Api& api, int width, int height, int samples, Channels channels);
    bool fits(int width, int height, int samples, Channels channels) const {
        return width == width_ && height == height_ && samples == samples_ && channels == channels_;
    }
    /// The program that makes the mean of a pixel's samples, and an array without attributes.
    /// (glBlitFramebuffer does the same, but Mesa keeps no compiled code of its shader: it took
    /// 25 ms of every new process.)
    struct Resolver {
        GLuint program = 0, emptyArray = 0;
    };

    int samples() const { return samples_; }
    void bind() const;
    /// Makes the picture of the samples, where there are samples.
    void resolve(const Resolver& resolver) const;
    /// Resolves and reads the picture of 8 bits a channel, top row first, premultiplied alpha as
    /// drawn.
    void read(const Resolver& resolver, Image& image) const;
    /// The same of 16 bits a channel, 0..65535.
    void read(const Resolver& resolver, std::vector<std::uint16_t>& pixels) const;

  private:
    void readAs(const Resolver& resolver, GLenum type, void* pixels) const;

    const Api& api_;
    int width_, height_, samples_;
    Channels channels_;
    Framebuffer drawn_, resolved_;
    Texture samplesOf_;  ///< the colour, where there are samples
    Renderbuffer color_, depth_;
};

}  // namespace farol::render::gl
