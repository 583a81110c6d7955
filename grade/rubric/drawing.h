#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "grade/rubric/rubric.h"
#include "grade/rubric/subject.h"
#include "grade/rubric/views.h"
#include "grade/rubric/work.h"
#include "grade/structure/diagnosis.h"
#include "render/renderer.h"

namespace farol::grade {

/// A reference with the data that all comparisons share.
struct Reference {
    std::optional<image::Image> screen;  ///< where it is a picture
    render::Job job;
    std::vector<double> timesS;
    std::optional<ReferenceScene> scene;
    std::vector<Shot> shots;    ///< by the rubric's views; some by each scene's own camera
    std::vector<Shot> fixed;    ///< the same, all by the reference's cameras
    std::vector<Frame> frames;  ///< of the shots
    Work work;                  ///< by the views of `fixed`
};

/// Renders repaired scenes and measures the effect of a repair.
class RepairPainter {
  public:
    /// `own`: the submission's files. All outlive the painter.
    RepairPainter(render::Renderer& renderer, const Reference& reference,
                  std::shared_ptr<const scene::Assets> own);

    /// Draws the views of `fixed`. Throws Error as Renderer::draw does.
    std::vector<image::Image> draw(const Outline& outline);
    /// The share of weighted work that differs between two drawings of the views, 0..1.
    double spoiled(const std::vector<image::Image>& right,
                   const std::vector<image::Image>& wrong) const;
    /// The share of the picture that another camera changes of the reference, 0..1.
    double spoiledByCamera(const scene::Camera& camera);

  private:
    image::Image drawOne(const std::shared_ptr<const render::Prepared>& prepared, const Shot& shot);

    render::Renderer& renderer_;
    const Reference& reference_;
    std::shared_ptr<const scene::Assets> files_;
};

}  // namespace farol::grade
