#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"

namespace farol::reference {

/// A decoded picture, 8 bits, top row first, straight alpha.
struct Pixels {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;
    std::vector<std::uint8_t> alpha = {};  ///< empty: opaque
};

/// Texture lookups of OpenGL 2.1, section 3.8, in double: origin at the bottom left, repeated.
/// Each mipmap level is the area-weighted mean of the picture itself, its colours weighted by
/// alpha; those of cut-outs are scaled so that as large a share is at least half opaque as of the
/// picture. Colours are premultiplied.
class Texture {
  public:
    explicit Texture(const Pixels& pixels);

    /// Of docs/scene-language.md: opaque, where alpha is 255 or 0 everywhere; cut-out, where some
    /// alphas are under 8 and at most a tenth from 8 to 247; else blended.
    enum class Kind { opaque, cutOut, blended };
    Kind kind() const { return kind_; }

    /// `dx`, `dy`: the change of uv a pixel to the right and down. Not for anisotropic filters
    /// (throws std::invalid_argument).
    glm::dvec4 sample(const glm::dvec2& uv, const glm::dvec2& dx, const glm::dvec2& dy,
                      scene::Filter filter) const;
    /// log2 of the longer side of a pixel's footprint in texels.
    double levelOfDetail(const glm::dvec2& dx, const glm::dvec2& dy) const;
    std::size_t levels() const { return levels_.size(); }
    glm::ivec2 size(std::size_t level) const;
    /// Column from the left, row from the bottom.
    const glm::dvec4& texel(std::size_t level, int column, int row) const;

  private:
    struct Level {
        int width, height;
        std::vector<glm::dvec4> texels;  ///< bottom row first
    };
    static Kind kindOf(const Pixels& pixels);
    void keepCoverage(Level& level) const;
    glm::dvec4 linear(std::size_t level, const glm::dvec2& uv) const;
    Kind kind_ = Kind::opaque;
    std::vector<Level> levels_;
};

}  // namespace farol::reference
