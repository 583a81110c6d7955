#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace farol::render {

/// Positions of samples within a pixel, 0..1 from its lower left.
using SamplePattern = std::vector<glm::dvec2>;

/// Limits and properties that a GL reports: plan and painter depend on no others. The defaults are
/// the minima of GL 4.5; a plan made with them fits any GL.
struct GlFacts {
    /// Of multisampled targets, in ascending order of samples. Empty: not supported.
    std::vector<SamplePattern> samplePatterns;
    double snapPx = 1.0 / 32.0;         ///< most that the rasteriser's grid moves a vertex, px
    int maxTextureSide = 16384;         ///< px
    int maxFaceSide = 16384;            ///< of a cube map, px
    int maxTargetSide = 16384;          ///< of a render target, px
    float maxAnisotropy = 1.0F;         ///< 1: isotropic filters only
    int vertexComponents = 64;          ///< of a vertex shader's outputs
    bool readsUniformsByPixel = false;  ///< in fragment shaders, each for itself: slowly
    bool packInvert = false;            ///< GL_MESA_pack_invert: images are read top row first
    std::string renderer, version;      ///< "llvmpipe (LLVM ...)", "4.5 (Core Profile) Mesa 22.3.6"

    /// "llvmpipe (LLVM ...), 4.5 (Core Profile) Mesa 22.3.6"
    std::string description() const { return renderer + ", " + version; }
};

}  // namespace farol::render
