#include "render/plan/coverage.h"

#include <algorithm>
#include <cmath>

#include "render/plan/frustum.h"

namespace farol::render {
namespace {

constexpr int kTile = 64;  // of llvmpipe, px
constexpr double kMostOfImage = 0.9;
constexpr std::size_t kMaxItems = 4096;  // to be looked at in a frame
constexpr double kMarginPx = 2.0;        // more than rounding and snapping move a vertex

/// Columns of a row of tiles: [first, last), none at first.
struct Columns {
    int first = 0, last = 0;
};

/// Whether all that the frame draws are faces of models.
bool hasFacesOnly(const FramePlan& plan) {
    return plan.passes.size() == 1 && plan.passes[0].target.clearColor &&
           plan.passes[0].state.polygons == Polygons::filled && plan.lines.empty();
}

}  // namespace

std::vector<glm::ivec4> coveredRects(const FramePlan& plan) {
    if (!hasFacesOnly(plan) || plan.items.size() > kMaxItems) return {};
    const glm::ivec2 size = plan.view.size;
    std::vector<Columns> rows(static_cast<std::size_t>((size.y + kTile - 1) / kTile));
    for (const DrawItem& item : plan.items) {
        // Near the eye vertices have places without the matrix.
        if (!item.mesh->eyePositions.empty() || item.mesh->bounds.empty()) return {};
        const std::optional<PixelRect> rect =
            visibleRect(item.mesh->bounds, glm::dmat4(item.viewFromObject), plan.view);
        if (!rect) continue;
        const glm::ivec2 from(glm::clamp(rect->min - kMarginPx, glm::dvec2(0.0), glm::dvec2(size)));
        const glm::ivec2 to(
            glm::ceil(glm::clamp(rect->max + kMarginPx, glm::dvec2(0.0), glm::dvec2(size))));
        if (from.x >= to.x || from.y >= to.y) continue;
        for (int row = from.y / kTile; row <= (to.y - 1) / kTile; ++row) {
            Columns& columns = rows[static_cast<std::size_t>(row)];
            const bool isFirst = columns.last == 0;
            columns.first = isFirst ? from.x : std::min(columns.first, from.x);
            columns.last = std::max(columns.last, to.x);
        }
    }
    std::vector<glm::ivec4> rects;
    double area = 0.0;
    for (std::size_t row = 0; row < rows.size(); ++row) {
        if (rows[row].last == 0) continue;
        const int x = rows[row].first / kTile * kTile, y = static_cast<int>(row) * kTile;
        const int right = std::min(size.x, (rows[row].last + kTile - 1) / kTile * kTile);
        const int height = std::min(kTile, size.y - y);
        area += static_cast<double>(right - x) * height;
        if (!rects.empty() && rects.back().x == x && rects.back().z == right - x &&
            rects.back().y + rects.back().w == y)
            rects.back().w += height;
        else
            rects.emplace_back(x, y, right - x, height);
    }
    if (area > kMostOfImage * size.x * size.y) return {};
    return rects;
}

}  // namespace farol::render
