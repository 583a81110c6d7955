#include "render/plan/depth_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "render/plan/cost.h"
#include "render/plan/frustum.h"

namespace farol::render {
namespace {

constexpr int kCells = 32;       // along each side of the image
constexpr double kFilled = 0.7;  // the share of its box's view that a model covers, about
constexpr std::size_t kMaxRuns = 64;
/// Core-seconds; a model with less shading occludes and is occluded for nothing that shows.
constexpr double kMinShading = 5e-6;
/// Estimates of boxes are rough: what is saved has to be more than the cost by so much.
constexpr double kCertainty = 1.5;

/// What is in front in a cell so far.
struct Cell {
    double distance = std::numeric_limits<double>::infinity();  ///< in lengths of the cell's ray
    double covered = 0.0;                                       ///< share of the cell
    double cost = 0.0;                                          ///< of shading what shows
};

/// Where the ray from the eye along `direction` enters the box, in lengths of it; where it leaves
/// a box that the eye is in; infinite where it misses.
double entryOf(const Box& box, const glm::dvec3& eye, const glm::dvec3& direction) {
    double first = 0.0, last = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double toMin = box.min[axis] - eye[axis], toMax = box.max[axis] - eye[axis];
        if (direction[axis] == 0.0) {
            if (toMin > 0.0 || toMax < 0.0) return std::numeric_limits<double>::infinity();
            continue;
        }
        const double a = toMin / direction[axis], b = toMax / direction[axis];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    if (first == 0.0) return last;
    return first <= last ? first : std::numeric_limits<double>::infinity();
}

class Estimate {
  public:
    Estimate(const FramePlan& plan, int shadings) : plan_(plan), shadings_(shadings) {}

    /// Draws a model; returns the cost of the shading that it hides.
    double draw(const DrawItem& item) {
        const glm::dmat4 viewFromObject(item.viewFromObject);
        const glm::ivec2& size = plan_.view.size;
        const std::optional<PixelRect> rect =
            pixelRect(item.mesh->bounds, viewFromObject, plan_.view);
        const double part =
            static_cast<double>(item.indices / 3) /
            static_cast<double>(std::max<std::size_t>(1, item.mesh->mesh.triangles()));
        const double perPixel = fragmentCost(plan_, item) * shadings_;
        if (coveredArea(rect, size) * part * perPixel < kMinShading) return 0.0;
        const glm::dmat4 objectFromView = glm::inverse(viewFromObject);
        if (!std::isfinite(objectFromView[0][0])) return 0.0;  // flat: nothing is behind it
        const glm::dvec3 eye(objectFromView[3]);
        const glm::dvec2 cell = glm::dvec2(size) / double(kCells);
        glm::ivec2 first(0), last(kCells - 1);
        if (rect) {
            first = glm::ivec2(glm::clamp(rect->min / cell, 0.0, kCells - 1.0));
            last = glm::ivec2(glm::clamp(rect->max / cell, 0.0, kCells - 1.0));
        }
        const double cost = perPixel * cell.x * cell.y;
        double hidden = 0.0;
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; ++x) {
                const glm::dvec2 clip = (glm::dvec2(x, y) + 0.5) * (2.0 / kCells) - 1.0;
                const glm::dvec3 ray =
                    glm::dmat3(objectFromView) * glm::dvec3(clip * plan_.view.tanHalfFov, -1.0);
                const double distance = entryOf(item.mesh->bounds, eye, ray);
                if (std::isinf(distance)) continue;
                hidden += cover(cells_[static_cast<std::size_t>(y * kCells + x)], distance,
                                std::min(1.0, part * kFilled), cost);
            }
        return hidden;
    }
    double visible() const {
        double sum = 0.0;
        for (const Cell& cell : cells_) sum += cell.cost;
        return sum;
    }

  private:
    /// Adds what covers `share` of the cell, whose shading would cost `cost` over all of it.
    static double cover(Cell& cell, double distance, double share, double cost) {
        const double both = cell.covered * share;
        double hidden = 0.0;
        if (distance < cell.distance) {
            hidden = cell.cost * share;
            cell.cost += share * cost - hidden;
            cell.distance = distance;
        } else {
            cell.cost += (share - both) * cost;
        }
        cell.covered += share - both;
        return hidden;
    }

    const FramePlan& plan_;
    int shadings_;
    std::array<Cell, std::size_t{kCells} * kCells> cells_{};
};

/// Core-seconds of a batch's depths, in all passes.
double depthCost(const FramePlan& plan, const Batch& batch, int shadings, int passes) {
    double cost = 0.0;
    for (std::size_t i = batch.first; i < batch.first + batch.count; ++i) {
        const DrawItem& item = plan.items[plan.batches.order[i]];
        const double area =
            coveredArea(pixelRect(item.mesh->bounds, glm::dmat4(item.viewFromObject), plan.view),
                        plan.view.size);
        cost +=
            depthCostOf(static_cast<double>(item.indices / 3), kFilled * area * shadings, passes);
    }
    return cost;
}

}  // namespace

DepthPass planDepthPass(const FramePlan& plan, int shadings, int passes) {
    DepthPass chosen;
    Estimate estimate(plan, shadings);
    double hidden = 0.0;
    std::size_t firstFree = 0;  ///< behind the last batch that no run may span
    const std::vector<Batch>& batches = plan.batches.batches;
    for (std::size_t b = 0; b < batches.size(); ++b) {
        // Behind what is seen through, all shows.
        if (plan.items[plan.batches.order[batches[b].first]].alpha != image::Alpha::opaque) {
            firstFree = b + 1;
            continue;
        }
        double saved = 0.0;
        for (std::size_t i = batches[b].first; i < batches[b].first + batches[b].count; ++i)
            saved += estimate.draw(plan.items[plan.batches.order[i]]);
        hidden += saved;
        // Depths that the shading pass writes itself may lie behind those of the mesh.
        const bool isExact = plan.items[plan.batches.order[batches[b].first]].hasExactDepth;
        if (isExact) firstFree = b + 1;
        if (isExact || saved == 0.0 ||
            saved < kCertainty * depthCost(plan, batches[b], shadings, passes))
            continue;
        if (chosen.occluders.size() == kMaxRuns && chosen.occluders.back().first < firstFree)
            continue;
        chosen.models += static_cast<int>(batches[b].count);
        if (!chosen.occluders.empty() &&
            (chosen.occluders.back().first + chosen.occluders.back().count == b ||
             chosen.occluders.size() == kMaxRuns))
            chosen.occluders.back().count = b + 1 - chosen.occluders.back().first;
        else
            chosen.occluders.push_back({PassItem::Kind::models, b, 1, -1});
    }
    if (const double visible = estimate.visible(); visible > 0.0)
        chosen.overdraw = 1.0 + hidden / visible;
    return chosen;
}

}  // namespace farol::render
