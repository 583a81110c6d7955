#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "grade/finding.h"
#include "grade/flip.h"
#include "grade/rubric.h"
#include "grade/tree.h"
#include "render/renderer.h"

namespace farol::grade {

/// A view at a time: with the options that give it.
struct Shot {
    std::string name;
    bool own = false;  ///< by each scene's own camera
    render::PictureOptions options;
};

/// The views of a rubric for a reference scene, at each of `timesS`. Pictures are as large as the
/// rubric says, else as the reference's window, but at most 512 px a side.
std::vector<Shot> planShots(const Rubric& rubric, const Tree& reference,
                            const std::vector<double>& timesS);

/// The rubric's times; where it has none 0, and for scenes that move a later moment too.
std::vector<double> chooseTimes(const Rubric& rubric, const scene::Scene& reference);

/// What one shot shows of a scene. Layers are empty where they are not asked for.
struct Frame {
    render::Image color, depth, normal;
    std::vector<std::uint32_t> ids;
    std::optional<FlipPicture> flip;  ///< of references: it serves all comparisons
};

/// What of a frame a rubric's measures need.
struct FrameParts {
    bool flip = false, ids = false, depth = false, normals = false;
};
FrameParts partsFor(const Rubric& rubric);

/// Draws them. Throws Error as Renderer::draw does.
Frame drawFrame(render::Renderer& renderer, const render::Job& job, const Shot& shot,
                const FrameParts& parts);

}  // namespace farol::grade
