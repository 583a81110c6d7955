#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace farol::render {

/// Positions of samples within a pixel, 0..1 from its lower left.
using SamplePattern = std::vector<glm::dvec2>;

/// Facts that a GL reports about itself: plan and painter rely on nothing else about it. The
/// defaults are the minima of GL 4.5; a plan made with them fits any.
struct GlFacts {
    /// Of multisampled targets, by their number of samples, ascending. Empty: there are none.
    std::vector<SamplePattern> samplePatterns;
    double snapPx = 1.0 / 32.0;     ///< by which the rasteriser's grid moves a vertex at most
    int maxTextureSide = 16384;     ///< px
    int maxFaceSide = 16384;        ///< of a cube map, px
    int maxTargetSide = 16384;      ///< of a render target, px
    float maxAnisotropy = 1.0F;     ///< 1: isotropic filters only
    bool packInvert = false;        ///< GL_MESA_pack_invert: images are read top row first
    std::string renderer, version;  ///< "llvmpipe (LLVM ...)", "4.5 (Core Profile) Mesa 22.3.6"

    /// "llvmpipe (LLVM ...), 4.5 (Core Profile) Mesa 22.3.6"
    std::string description() const { return renderer + ", " + version; }
};

}  // namespace farol::render
