#pragma once

#include <glm/glm.hpp>

#include "render/gl_facts.h"

namespace farol::render {

/// How an image is sampled: by `passes`, each of which moves the image by a part of a pixel, of
/// `samples` at once.
struct Sampling {
    int samples = 1, passes = 1;
};

/// `wanted`: 1, 2, 4, 8 or 16. Takes the fewest at once that suffice, else the most and passes.
Sampling chooseSampling(int wanted, const GlFacts& gl);

/// Offset of a pass within a pixel, -0.5..0.5: the centres of the cells of a rotated grid.
glm::dvec2 passOffset(int pass, int passes);

/// Returns the positions of `wanted` samples over all passes.
SamplePattern samplePattern(int wanted, const GlFacts& gl);

}  // namespace farol::render
