#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "tests/support/ray_caster/world.h"

namespace farol::reference {

/// The result of one ray.
struct Sample {
    glm::dvec3 color{0.0};
    int id = 0;        ///< of the nearest surface; 0: the background
    int opaqueId = 0;  ///< of the nearest surface that is at least half opaque; 0: none is
    int part = 0;      ///< the face of the shape, and which cones of light it is in
    /// A bit for each light of the nearest surface that shines on it: before its face, in the cone,
    /// and not in a shadow.
    std::uint64_t lit = 0;
    std::uint64_t ids = 0, parts = 0;  ///< digests of all surfaces behind each other that are seen
    double depth = 0.0;                ///< along the view, of the nearest
    glm::dvec3 point{0.0}, normal{0.0};  ///< eye space; the normal unit, of the surface
    glm::ivec2 texel{0};                 ///< the one seen, with the filter `nearest`
    bool coarse = false;  ///< texture coordinates jump here by an eighth or more a pixel
};

/// The ray through (x, y) px from the top left. Surfaces with opacity under 1 are added up in the
/// order of their depth; of equal depths the first in the document is in front.
Sample trace(const World& world, double x, double y);

/// Display values 0..1, top row first, not quantised.
struct Picture {
    int width = 0, height = 0;
    std::vector<glm::dvec3> color;
    std::vector<int> id, opaqueId;   ///< at pixel centres
    std::vector<std::uint64_t> lit;  ///< of Sample, at pixel centres
    std::vector<std::uint8_t> edge;  ///< a Flags, at pixel centres
    int side = 1;                    ///< samples a side of each pixel, at most
    double change = 0.0;             ///< R2: rms change at the last doubling, 0..1

    std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x);
    }
};

/// Why a pixel is not an interior one: a neighbour, diagonals included, is of another object (or
/// of another sheet of the same: silhouette); or of another face, on the other side of a crease,
/// or of the edge of a cone of light, of another texel of an unfiltered texture, or sees the
/// texture's coordinates jump (crease).
enum Flags : std::uint8_t { kInterior = 0, kSilhouette = 1, kCrease = 2 };

/// R1: one ray through the centre of each pixel.
Picture traceCenters(const World& world, int threads = 2);

/// R2: N x N rays a pixel, box filter, N doubled from 2 until the rms change over the picture is
/// under 0.1/255 or N is `cap` (a power of two). Pixels that are no edges in R1 and change by less
/// than 0.05/255 are left as they are, their change counted in. Textures are sampled with the
/// footprint of the pixel, as in R1, so that the two differ by antialiasing alone.
Picture traceAreas(const World& world, int cap = 32, int threads = 2);

}  // namespace farol::reference
