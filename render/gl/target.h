#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "render/gl/objects.h"

namespace farol::render::gl {

/// The framebuffer of a pass: colour and 32-bit float depth, with samples, and where there are
/// samples the picture they are resolved into. (OSMesa's own depth buffer has 24 bits at most.)
class Target {
  public:
    struct Format {
        int width = 0, height = 0;
        int samples = 1;
        bool isFloat = false;  ///< colours in half floats, else in 8 bits
        /// The part from the lower left that can be drawn to, px; 0: all. Where there are samples,
        /// the rest of the image is only cleared.
        glm::ivec2 drawn{0};
        bool operator==(const Format&) const = default;
    };

    /// `packInvert`: of GlFacts. Throws std::bad_alloc when GL refuses.
    Target(const Api& api, const Format& format, bool packInvert);
    const Format& format() const { return format_; }
    /// True where frames of the format are drawn as by their own target: of the same size and
    /// samples, and whose part that can be drawn to is at least theirs, and not much more.
    bool suits(const Format& format) const;
    /// The program that makes the mean of a pixel's samples, and an array without attributes.
    /// (glBlitFramebuffer does the same, but Mesa keeps no compiled code of its shader: it took
    /// 25 ms of every new process.)
    struct Resolver {
        GLuint program = 0, emptyArray = 0;
    };

    /// GL_TEXTURE_2D, or GL_TEXTURE_2D_MULTISAMPLE.
    GLenum textureKind() const;
    GLuint color() const { return color_.name(); }
    GLuint depth() const { return depth_.name(); }

    /// Binds it, with a viewport (x, y, width, height) in its pixels, which may reach beyond it.
    void bind(const glm::ivec4& viewport) const;
    /// Makes the image of the samples, where there are samples. `parts` (x, y, width, height), if
    /// any, are all that differs from `clearColor`.
    void resolve(const Resolver& resolver, const std::vector<glm::ivec4>& parts,
                 const glm::vec4& clearColor) const;
    /// Reads `rows` rows from the row `first` above the lowest, the topmost first, 4 bytes a pixel,
    /// premultiplied alpha as drawn; resolved before.
    void read(int first, int rows, std::uint8_t* pixels) const;

  private:
    const Api& api_;
    Format format_;
    bool packInvert_;
    Framebuffer drawn_, resolved_;
    Texture color_, depth_;  ///< with the format's samples
    Texture resolvedColor_;  ///< where there are samples
};

}  // namespace farol::render::gl
