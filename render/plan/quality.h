#pragma once

#include <optional>

#include "render/options.h"
#include "render/plan/instances.h"
#include "render/plan/report.h"
#include "scene/scene.h"

/// `budget_ms`: how fine a picture may be for a given time, resolved without any clock, so that
/// the same request gives the same bytes. Costs and order come from measurements that ship with
/// the build (quality_front.inc, written by `scripts/bench front`): a millisecond is one of the
/// machine that they were taken on.
namespace farol::render {

/// The values from which the cost of a frame is estimated.
struct FrameLoad {
    double pixels = 0.0;            ///< of the picture
    double openModels = 0.0;        ///< whose divisions the renderer chooses
    double writtenTriangles = 0.0;  ///< of the others
    double lights = 0.0;
    double shadowLights = 0.0, shadowMaps = 0.0;  ///< of the lights, with shadows=map
    double seeThrough = 0.0;                      ///< surfaces blended over each pixel, on average
    double peels = 0.0;  ///< draws of them all that sort each pixel's; 0: sorted by model
};

/// Expected time of a frame, ms; `samples` 1, 2, 4, 8 or 16.
double expectedMs(const FrameLoad& load, int samples, double errorPx);

/// Samples a pixel that the front has with meshes of this error: those of its best setting that is
/// no finer, else of its cheapest. The default of `aa`.
int samplesFor(double errorPx);

/// Returns the best quality of the front within `budgetMs`, else its cheapest. Keeps given values.
/// A larger budget never gives a worse one: samples and error are chosen along one order.
Quality chooseQuality(double budgetMs, const FrameLoad& load, std::optional<int> samples,
                      std::optional<double> errorPx);

/// Fills in the options that options.budgetMs decides and neither the request nor the scene sets.
/// Returns nothing without a budget.
std::optional<Quality> resolveBudget(PictureOptions& options, const scene::Scene& scene,
                                     const Placed& placed);

}  // namespace farol::render
