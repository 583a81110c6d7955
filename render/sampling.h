#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace farol::render {

/// What a picture's pixels are computed from: positions within a pixel, 0..1 from its lower left.
using SamplePattern = std::vector<glm::dvec2>;

/// Samples that GL takes at once here (llvmpipe: 4 at most).
inline constexpr int kGlSamples = 4;

/// How many samples GL takes at once and how many jittered passes make up the rest.
struct Sampling {
    int samples, passes;
};

/// `wanted`: 1, 2, 4, 8 or 16; `most`: what GL takes at once.
Sampling chooseSampling(int wanted, int most);

/// Offset of a pass within a pixel, -0.5..0.5: the centres of the cells of a rotated grid.
glm::dvec2 passOffset(int pass, int passes);

/// All positions that `wanted` samples are taken at, over all passes.
SamplePattern samplePattern(int wanted);

/// Where GL takes its kGlSamples within a pixel (glGetMultisamplefv says the same).
const SamplePattern& glSamplePattern();

}  // namespace farol::render
