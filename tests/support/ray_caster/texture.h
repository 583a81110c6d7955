#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"

namespace farol::reference {

/// A decoded picture: RGB, 8 bits, top row first.
struct Pixels {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;
};

/// Texture lookups of OpenGL 2.1, section 3.8, in double: origin at the bottom left, repeated.
/// Each mipmap level is the area-weighted mean of the picture itself.
class Texture {
  public:
    explicit Texture(const Pixels& pixels);

    /// `dx`, `dy`: the change of uv a pixel to the right and down. Not for anisotropic filters
    /// (throws std::invalid_argument).
    glm::dvec3 sample(const glm::dvec2& uv, const glm::dvec2& dx, const glm::dvec2& dy,
                      scene::Filter filter) const;
    /// log2 of the longer side of a pixel's footprint in texels.
    double levelOfDetail(const glm::dvec2& dx, const glm::dvec2& dy) const;
    std::size_t levels() const { return levels_.size(); }
    glm::ivec2 size(std::size_t level) const;
    /// Column from the left, row from the bottom.
    const glm::dvec3& texel(std::size_t level, int column, int row) const;

  private:
    struct Level {
        int width, height;
        std::vector<glm::dvec3> texels;  ///< bottom row first
    };
    glm::dvec3 linear(std::size_t level, const glm::dvec2& uv) const;
    std::vector<Level> levels_;
};

}  // namespace farol::reference
