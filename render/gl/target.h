#pragma once

#include <cstdint>
#include <vector>

#include "image/image.h"
#include "render/gl/objects.h"

namespace farol::render::gl {

/// The framebuffer of a frame: RGBA and 32-bit float depth, with samples, and where there are
/// samples the picture they are resolved into. (OSMesa's own depth buffer has 24 bits at most.)
class Target {
  public:
    struct Format {
        int width = 0, height = 0;
        int samples = 1;
        bool wide = false;  ///< 16 bits a channel, else 8
        bool operator==(const Format&) const = default;
    };

    /// `packInvert`: of GlFacts. Throws std::bad_alloc when GL refuses.
    Target(const Api& api, const Format& format, bool packInvert);
    const Format& format() const { return format_; }
    /// The program that makes the mean of a pixel's samples, and an array without attributes.
    /// (glBlitFramebuffer does the same, but Mesa keeps no compiled code of its shader: it took
    /// 25 ms of every new process.)
    struct Resolver {
        GLuint program = 0, emptyArray = 0;
    };

    void bind() const;
    /// Makes the picture of the samples, where there are samples.
    void resolve(const Resolver& resolver) const;
    /// Resolves and reads the picture of 8 bits a channel, top row first, premultiplied alpha as
    /// drawn.
    void read(const Resolver& resolver, image::Image& image) const;
    /// The same of 16 bits a channel, 0..65535.
    void read(const Resolver& resolver, std::vector<std::uint16_t>& pixels) const;

  private:
    template <typename Channel>
    void readAs(const Resolver& resolver, GLenum type, std::vector<Channel>& pixels) const;

    const Api& api_;
    Format format_;
    bool packInvert_;
    Framebuffer drawn_, resolved_;
    Texture samplesOf_;  ///< the colour, where there are samples
    Renderbuffer color_, depth_;
};

}  // namespace farol::render::gl
