#include "render/plan/quality.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/plan/plan.h"
#include "render/plan/sampling.h"
#include "render/plan/see_through.h"

namespace farol::render {
namespace {

struct SampleCost {
    int samples;
    double msPerMegapixel;  ///< of filled pixels
    double msPerMegatriangle;
};
struct Candidate {
    int samples;
    double errorPx;
};

#include "render/plan/quality_front.inc"

constexpr int kGlSamples = 4;  // of the GL that the front was measured with

const SampleCost& costOf(int samples) {
    const auto found = std::find_if(kCosts.begin(), kCosts.end(),
                                    [&](const SampleCost& one) { return one.samples >= samples; });
    return found == kCosts.end() ? kCosts.back() : *found;
}

// Of shadows, like the figures of the front but for two scenes alone
// (docs/benchmarks/rendering.md): looking a light up for each shading of a pixel, and drawing a
// map.
constexpr double kShadowMsPerMegapixel = 32.0, kShadowMsPerMap = 2.0;

/// How often a pixel is shaded, about: samples share their shading up to 4.
double shadingsOf(int samples) {
    return samples >= 16 ? 16.0 : samples >= 8 ? 9.0 : samples >= 2 ? 2.0 : 1.0;
}

void countShadows(const InstanceList& list, FrameLoad& load) {
    for (const PlacedLight& placed : list.lights) {
        load.shadowLights += 1.0;
        // A point light seldom needs all sides of its cube.
        load.shadowMaps += placed.light->type == scene::LightType::point ? 4.0 : 1.0;
    }
}

void count(const InstanceList& list, FrameLoad& load) {
    for (const Instance& one : list.instances)
        if (one.open)
            load.openModels += 1.0;
        else
            load.writtenTriangles += static_cast<double>(one.mesh->mesh.triangles());
    load.lights += static_cast<double>(list.lights.size());
}

/// Of opacities: the alpha of a texture is known once it is decoded. Not of the entity.
void countSeeThrough(const PictureOptions& options, const scene::Scene& scene, const Placed& placed,
                     const glm::ivec2& size, FrameLoad& load) {
    const scene::Transparency transparency = options.transparency.value_or(
        scene.settings.transparency.value_or(scene::Transparency::on));
    if (transparency == scene::Transparency::off) return;
    SeeThroughSurfaces surfaces(size);
    const double aspect = static_cast<double>(size.x) / size.y;
    addSeeThrough(placed.scene,
                  viewOf(chooseCamera(scene, options, placed.scene.bounds, aspect), size),
                  surfaces);
    if (surfaces.area() <= 0.0) return;
    load.seeThrough = surfaces.area() / load.pixels;
    if (transparency == scene::Transparency::exact) load.peels = peelsOf(surfaces.deepest());
}

}  // namespace

double expectedMs(const FrameLoad& load, int samples, double errorPx) {
    const SampleCost& cost = costOf(samples);
    // A shape of r px has about r / error triangles, and r is about the root of pixels / models.
    const double triangles = load.writtenTriangles + kTrianglesOpen *
                                                         std::sqrt(load.pixels * load.openModels) /
                                                         errorOf(errorPx, samples);
    // A peeled fragment is shaded in each of the GL's samples, as often as there are layers at or
    // before it: half of the draws.
    const double shadings =
        load.seeThrough *
        (load.peels > 0.0 ? 0.5 * load.peels * std::min(samples, kGlSamples) : 1.0);
    return kFixedMs + kShadowMsPerMap * load.shadowMaps +
           1e-6 * load.pixels * load.shadowLights * kShadowMsPerMegapixel * shadingsOf(samples) *
               (1.0 + shadings) +
           1e-6 * load.pixels * cost.msPerMegapixel * (1.0 + shadings) *
               (1.0 + kPerLight * std::max(0.0, load.lights - 1.0)) +
           1e-6 * triangles * cost.msPerMegatriangle * (1.0 + load.peels);
}

int samplesFor(double errorPx) {
    const auto found = std::find_if(  // best first
        kFront.begin(), kFront.end(), [&](const Candidate& one) { return one.errorPx >= errorPx; });
    return found == kFront.end() ? kFront.back().samples : found->samples;
}

Quality chooseQuality(double budgetMs, const FrameLoad& load, std::optional<int> samples,
                      std::optional<double> errorPx) {
    Quality chosen;
    for (const Candidate& one : kFront) {  // best first
        chosen.samples = samples.value_or(one.samples);
        chosen.errorPx = errorPx.value_or(one.errorPx);
        chosen.expectedMs = expectedMs(load, chosen.samples, chosen.errorPx);
        chosen.within = chosen.expectedMs <= budgetMs;
        if (chosen.within) break;
    }
    return chosen;
}

std::optional<Quality> resolveBudget(PictureOptions& options, const scene::Scene& scene,
                                     const Placed& placed) {
    if (!options.budgetMs) return std::nullopt;
    const glm::ivec2 size = pictureSize(scene, options);
    FrameLoad load;
    load.pixels = static_cast<double>(size.x) * size.y;
    count(placed.scene, load);
    if (placed.entity) count(*placed.entity, load);
    const scene::Shadows shadows =
        options.shadows.value_or(scene.settings.shadows.value_or(scene::Shadows::off));
    if (shadows == scene::Shadows::map) countShadows(placed.scene, load);
    countSeeThrough(options, scene, placed, size, load);
    const Quality chosen =
        chooseQuality(*options.budgetMs, load,
                      options.samples ? options.samples : scene.settings.samples, options.errorPx);
    options.samples = chosen.samples;
    options.errorPx = chosen.errorPx;
    return chosen;
}

}  // namespace farol::render
