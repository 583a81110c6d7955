#pragma once

#include <memory>
#include <string>

#include "render/options.h"
#include "scene/files/assets.h"
#include "tests/support/ray_caster/tracer.h"

/// Our pictures against the independent ray caster's.
namespace farol::accuracy {

/// Differences in levels of 255, over the three channels of the pixels measured.
struct Difference {
    int pixels = 0;
    double rms = 0.0, percentile999 = 0.0, worst = 0.0;
    int worstX = 0, worstY = 0;
};

struct Figures {
    int width = 0, height = 0;
    Difference interior;    ///< of one object, away from silhouettes and creases
    Difference silhouette;  ///< within a pixel of another object or the background
    Difference crease;  ///< within a pixel of a crease, a cone of light's edge, a texture's pole
    int stray = 0;      ///< pixels well inside the background that show something else
    int flipped = 0;    ///< silhouette pixels that show something else: over 24 levels off
};

/// Draws the document as `options` say and compares it with R1, one ray a pixel centre. `files`
/// serves the reference what the document names; `assets` the same files for the renderer.
Figures measure(const std::string& xml, const render::PictureOptions& options,
                const reference::Files& files = {},
                const std::shared_ptr<const scene::Assets>& assets = nullptr);

/// One line of figures on the standard output.
void print(const std::string& name, const Figures& figures);

}  // namespace farol::accuracy
