#pragma once

#include "render/plan/plan.h"

/// Plans for tests that need no GL.
namespace farol::support {

/// A GL of four samples, as llvmpipe is: painter_test holds the two together.
inline render::GlFacts fourSamples() {
    render::GlFacts gl;
    gl.samplePatterns = {{{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}}};
    gl.snapPx = 1.0 / 512.0;
    return gl;
}

/// Plans a scene that was placed just for it.
inline render::FramePlan planScene(const scene::Scene& scene, const render::PictureOptions& options,
                                   const scene::Assets& assets, render::MeshLibrary& meshes,
                                   const render::Skipping& skipping = {}) {
    return render::plan(scene, render::place(scene, options.timeS, options.curves, assets, meshes),
                        options, assets, meshes, fourSamples(), skipping);
}

}  // namespace farol::support
