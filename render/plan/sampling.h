#pragma once

#include <glm/glm.hpp>

#include "render/gl_facts.h"

namespace farol::render {

/// How an image is sampled: in targets `scale` times as wide and high as the image, by `passes`
/// that each move it by a part of a pixel. `samples` are the GL's own of a pixel of such a target,
/// which share one shading: more than one only at scale 1 and in one pass.
struct Sampling {
    int scale = 1, samples = 1, passes = 1;
};

/// At least `wanted` (1, 2, 4, 8 or 16) samples a pixel: up to four by the GL's multisampling,
/// which shades a pixel once; more by larger targets, where each sample is shaded. `side`: the
/// longer one of the image, px.
Sampling chooseSampling(int wanted, const GlFacts& gl, int side);

/// The error of tessellation, px, where `errorPx` is asked for: more than four samples resolve
/// finer outlines.
double errorOf(double errorPx, int samples);

/// By how much a pass moves the image, px, -0.5..0.5: so that no two samples of all passes share a
/// row or column where their number allows.
glm::dvec2 passOffset(int pass, const Sampling& sampling);

/// Positions of all samples in a pixel, over all passes.
SamplePattern samplePattern(const Sampling& sampling, const GlFacts& gl);

}  // namespace farol::render
