#include "render/plan/cost.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "render/plan/frustum.h"
#include "render/plan/messages.h"
#include "render/plan/see_through.h"

namespace farol::render {
namespace {

// Core-seconds, the largest seen for each of several scenes (docs/benchmarks/rendering.md).
constexpr double kPixelCost = 60e-9;  // once
// Clear and read a pass, of the target's pixels: of a process's first frame, whose pages are fresh;
// a tenth in later ones.
constexpr double kPixelPassCost = 35e-9;
constexpr double kFragmentCost = 6e-9;  // without light
constexpr double kLightCost = 18e-9;    // of a fragment
constexpr double kSurfaceCost = 25e-9;  // of a fragment that takes its normal from a surface
constexpr double kTexelCost = 12e-9, kAnisotropicCost = 36e-9;
constexpr double kTriangleCost = 0.25e-6, kLineCost = 1.5e-6;  // of a pass
constexpr double kCallCost = 15e-6;                            // of a pass
// A pass of depths alone, measured against frames without it.
constexpr double kDepthCallCost = 5e-6, kDepthTriangleCost = 0.15e-6, kDepthFragmentCost = 1.5e-9;
// Of shadow maps: clearing and filling a texel, and looking one light's up for a fragment.
constexpr double kShadowTexelCost = 4e-9, kShadowLookupCost = 80e-9;
// Of a layer that is peeled: clear it and blend it over the others, of a sample; and of a fragment,
// the two depths that it is compared with.
constexpr double kPeelSampleCost = 12e-9, kPeelFragmentCost = 12e-9;
constexpr double kLineWidth = 4.0;  // px that a line's fragments are counted as

/// How many layers of triangles a mesh has before each other, about: 1 for closed shapes.
double layersOf(const MeshData& data) {
    const generator::Mesh& mesh = data.mesh;
    double area = 0.0;
    for (std::size_t i = 0; i + 2 < mesh.indices().size(); i += 3) {
        const glm::vec3& a = mesh.positions()[mesh.indices()[i]];
        area += 0.5 * static_cast<double>(
                          glm::length(glm::cross(mesh.positions()[mesh.indices()[i + 1]] - a,
                                                 mesh.positions()[mesh.indices()[i + 2]] - a)));
    }
    const glm::dvec3 side = data.bounds.max - data.bounds.min;
    const double faces = side.x * side.y + side.y * side.z + side.z * side.x;
    return faces > 0.0 ? std::max(1.0, area / (2.0 * faces)) : 1.0;
}

/// How often the passes draw a model, how often by its outlines, how many times they shade a pixel
/// of it, and how often a pixel of it is compared with depths of layers.
struct DrawShare {
    double draws = 0.0, outlines = 0.0, shadings = 0.0, peelings = 0.0;
};

void addShares(const FramePlan& plan, const Pass& pass, const PassItem& item, double peels,
               std::vector<DrawShare>& shares) {
    const bool isPeeled = item.kind == PassItem::Kind::peeled;
    if (item.kind != PassItem::Kind::models && item.kind != PassItem::Kind::blended && !isPeeled)
        return;
    if (pass.state.depthOnly) return;  // saves more than it costs, or is not there
    const double targets = static_cast<double>(pass.target.scale) * pass.target.scale *
                           pass.target.rows / plan.view.size.y;
    const double samples = isPeeled ? pass.target.samples : pass.target.samples > 1 ? 1.5 : 1.0;
    // Of the draws of a layered pixel's surface, those that peel layers at or before it shade it.
    const double shadings = targets * samples * (isPeeled ? std::max(1.0, 0.5 * peels) : 1.0);
    const bool outlined = pass.state.polygons != Polygons::filled;
    for (std::size_t b = item.first; b < item.first + item.count; ++b) {
        const Batch& batch = plan.batches.batches[b];
        for (std::size_t i = batch.first; i < batch.first + batch.count; ++i) {
            DrawShare& share = shares[plan.batches.order[i]];
            share.draws += isPeeled ? peels : 1.0;
            share.outlines += outlined ? 1.0 : 0.0;
            share.shadings += shadings;
            if (isPeeled) share.peelings += targets * samples * peels;
        }
    }
}

Message adviceFor(const FramePlan& plan, const FrameCost& cost, int frames) {
    if (frames > 1) return message<"part.lower-frames">();
    constexpr double kManyLayers = 8.0;  // draws of a peeled model, to a blended one's single draw
    if (plan.style.transparency == scene::Transparency::exact &&
        peelsOf(deepestSeeThrough(plan)) > kManyLayers)
        return message<"part.fewer-see-through">();
    if (cost.geometry > cost.fragments + cost.pixels)
        return plan.style.samples > 4 ? message<"part.lower-aa-or-triangles">()
                                      : message<"part.fewer-triangles">();
    if (plan.style.samples > 4) return message<"part.lower-aa">();
    if (cost.fragments > cost.pixels && plan.items.size() > 1)
        return message<"part.lower-size-or-layers">();
    return message<"part.lower-size">();
}

/// Core-seconds with three digits.
std::string rounded(double coreSeconds) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", coreSeconds);
    return text.data();
}

}  // namespace

double deepestSeeThrough(const FramePlan& plan) {
    SeeThroughSurfaces surfaces(plan.view.size);
    // Inner sides are items already.
    for (const DrawItem& item : plan.items)
        if (item.alpha == image::Alpha::blended)
            surfaces.add(pixelRect(item.mesh->bounds, glm::dmat4(item.viewFromObject), plan.view),
                         1.0);
    return surfaces.deepest();
}

double fragmentCost(const FramePlan& plan, const DrawItem& item) {
    double cost = kFragmentCost;
    if (static_cast<std::size_t>(item.lightSet) < plan.lightSets.size())
        for (const EyeLight& light : plan.lightSets[static_cast<std::size_t>(item.lightSet)])
            cost += kLightCost + (light.diffuse.w > 0.0F ? kShadowLookupCost : 0.0);
    if (item.surface) cost += kSurfaceCost;
    if (item.texture >= 0)
        cost += plan.textures[static_cast<std::size_t>(item.texture)].filter ==
                        scene::Filter::anisotropic
                    ? kAnisotropicCost
                    : kTexelCost;
    return cost;
}

double depthCostOf(double triangles, double fragments, int passes) {
    return passes * (kDepthCallCost + triangles * kDepthTriangleCost) +
           fragments * kDepthFragmentCost;
}

FrameCost estimateCost(const FramePlan& plan) {
    FrameCost cost;
    const double pixels = static_cast<double>(plan.view.size.x) * plan.view.size.y;
    cost.pixels = pixels * kPixelCost;
    for (const Pass& pass : plan.passes)
        if (!pass.state.depthOnly)
            cost.pixels += kPixelPassCost * pass.target.scale * pass.target.scale *
                           pass.target.rows * plan.view.size.x;
    std::vector<DrawShare> shares(plan.items.size());
    double peels = 0.0;
    for (const Pass& pass : plan.passes)
        for (const PassItem& item : pass.items) {
            if (item.kind == PassItem::Kind::peeled) {
                if (peels == 0.0) peels = peelsOf(deepestSeeThrough(plan));
                cost.pixels += kPeelSampleCost * peels * pass.target.samples * pass.target.scale *
                               pass.target.scale * pass.target.rows * plan.view.size.x;
            }
            addShares(plan, pass, item, peels, shares);
        }
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const DrawItem& item = plan.items[i];
        const DrawShare& share = shares[i];
        const auto triangles = static_cast<double>(item.indices / 3);
        cost.geometry +=
            share.draws * kCallCost + triangles * ((share.draws - share.outlines) * kTriangleCost +
                                                   share.outlines * kLineCost);
        // A part of a mesh covers its share of it, about.
        const auto whole =
            static_cast<double>(std::max<std::size_t>(1, item.mesh->mesh.triangles()));
        double area =
            coveredArea(pixelRect(item.mesh->bounds, glm::dmat4(item.viewFromObject), plan.view),
                        plan.view.size) *
            (triangles / whole);
        if (share.outlines > 0.0) {
            // Three sides of triangles that share the area.
            area = std::min(3.0 * kLineWidth * std::sqrt(triangles * area), 3.0 * pixels);
        } else if (triangles * area * fragmentCost(plan, item) > 1.0) {
            area *= layersOf(*item.mesh);  // costs time itself: where it may matter alone
        }
        cost.fragments += share.shadings * area * fragmentCost(plan, item) +
                          share.peelings * area * kPeelFragmentCost;
    }
    const auto maps = static_cast<double>(plan.shadowMaps.size());
    cost.pixels += maps * kShadowTexelCost * plan.shadowSide * plan.shadowSide;
    cost.geometry += static_cast<double>(plan.stats.shadowTriangles) * kDepthTriangleCost;
    for (const ShadowMap& map : plan.shadowMaps)
        cost.geometry += static_cast<double>(map.casters.size()) * kDepthCallCost;
    return cost;
}

void CostBudget::spend(const FramePlan& plan) {
    if (whole_ <= 0.0) return;
    const FrameCost cost = estimateCost(plan);
    const double needed = cost.total() * frames_;
    if (needed > left_) {
        const std::string size =
            std::to_string(plan.view.size.x) + " x " + std::to_string(plan.view.size.y);
        throw Error(message<"limit.cost/frames">(
            "cost"_arg = rounded(needed), "size"_arg = size, "samples"_arg = plan.style.samples,
            "triangles"_arg = plan.stats.triangles, "frames"_arg = frames_,
            "most"_arg = left_ < whole_ ? message<"part.cost-rest">("left"_arg = rounded(left_))
                                        : message<"part.cost-whole">("whole"_arg = rounded(left_)),
            "advice"_arg = adviceFor(plan, cost, frames_)));
    }
    left_ -= cost.total();
    frames_ = std::max(1, frames_ - 1);
}

void CostBudget::spend(double coreSeconds, const std::string& work) {
    if (whole_ <= 0.0) return;
    if (coreSeconds > left_)
        throw Error(message<"limit.cost/images">("cost"_arg = rounded(coreSeconds),
                                                 "work"_arg = work, "most"_arg = rounded(left_)));
    left_ -= coreSeconds;
}

}  // namespace farol::render
