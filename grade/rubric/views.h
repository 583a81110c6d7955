#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "grade/rubric/frame.h"
#include "grade/rubric/rubric.h"
#include "render/plan/mesh_library.h"
#include "render/renderer.h"

namespace farol::grade {

/// A view at a time: with the options that give it.
struct Shot {
    std::string name;
    bool own = false;  ///< by each scene's own camera
    render::PictureOptions options;
};

/// The views of a rubric for a reference scene of these bounds, at each of `timesS`. Pictures are
/// as large as the rubric sets, else as the reference's window, but at most 512 px a side.
/// `isFixed`: all renders use the reference's camera as the scene's own.
std::vector<Shot> planShots(const Rubric& rubric, const scene::Scene& reference,
                            const render::Box& bounds, const std::vector<double>& timesS,
                            bool isFixed);

/// Sets the options that give the camera.
void useCamera(render::PictureOptions& options, const scene::Camera& camera);

/// The rubric's times; where it has none 0, and for scenes that move a later moment too.
std::vector<double> chooseTimes(const Rubric& rubric, const scene::Scene& reference);

/// The parts of a frame that a rubric's metrics need.
FrameParts partsFor(const Rubric& rubric);

/// Draws them. Throws Error as Renderer::draw does.
Frame drawFrame(render::Renderer& renderer, const render::Job& job, const Shot& shot,
                const FrameParts& parts);

}  // namespace farol::grade
