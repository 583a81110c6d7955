#include "render/plan/choose_mesh.h"

#include <algorithm>
#include <cmath>

#include "render/plan/ball_cap.h"
#include "render/plan/messages.h"

namespace farol::render {
namespace {

/// Most vertices of a frame that are placed in double; further meshes are drawn in float.
constexpr std::size_t kMaxNearVertices = 4'000'000;
/// Error up to which pixels follow their rays: a coarser mesh of a thin ring is beside its surface.
constexpr double kMostFollowedPx = 16.0;

}  // namespace

bool drawsLines(const FrameStyle& style) {
    return style.shading == scene::Shading::wireframe || style.shading == scene::Shading::points;
}

/// True where faces are filled and a pixel can show the surface itself, not its facets or their
/// corners' light.
bool MeshChoice::showsSurface() const {
    if (style_.layer != Layer::color) return true;
    if (style_.lit) return style_.shading == scene::Shading::phong;
    return !drawsLines(style_) && style_.shading != scene::Shading::chess;
}

void MeshChoice::refine(DrawItem& item, const Instance& instance, const InstanceList& list,
                        const ViewTransform& view, glm::dmat4& viewFromObject, bool isClose) {
    const scene::Model& model = *instance.model;
    std::optional<ProjectedSurface> seen;
    if (instance.surface >= 0 && showsSurface())
        seen = projectSurface(list.surfaces[static_cast<std::size_t>(instance.surface)],
                              viewFromObject);
    generator::Fineness fine = finenessOf(instance, seen, view, viewFromObject);
    if (seen) {
        const double finestPx = finestErrorPx(*seen, fine, errorPx_);
        const bool isShort = isTooClose(*seen) || finestPx > errorPx_;
        if (isShort && takeCap(item, instance, seen->surface, view, viewFromObject)) return;
        warnOfOutline(model, finestPx * outlineShare(*seen));
        if (isTooClose(*seen)) {
            seen.reset();
            fine = finenessOf(instance, seen, view, viewFromObject);
        }
    }
    item.mesh = meshes_.get(*instance.mesh, model, assets_, fine);
    if (!seen) return;
    const glm::dvec3& balance = item.mesh->balance;
    for (int i = 0; i < 3; ++i) viewFromObject[i] *= balance[i];
    const generator::SurfaceKind& kind = *seen->surface.kind;
    const bool isFollowed = errorPx_ <= kMostFollowedPx;
    item.hasExactDepth = isFollowed && isClose && kind.raySteps > 0;
    if (item.hasExactDepth || (isFollowed && kind.isNeeded(seen->surface, item.mesh->fullTurn,
                                                           model.texture.has_value())))
        item.surface = seen->surface;
    item.unitFromObject = glm::vec3(balance / seen->surface.lengths);
    item.surfaceEye = glm::vec3(seen->eye);
}

generator::Fineness MeshChoice::finenessOf(const Instance& instance,
                                           const std::optional<ProjectedSurface>& seen,
                                           const ViewTransform& view,
                                           const glm::dmat4& viewFromObject) const {
    return fineness(instance.mesh->bounds, viewFromObject, seen,
                    instance.model->texture.has_value(), {errorPx_, style_.shading}, view);
}

/// Takes the cap of a ball beneath the viewer in place of all of it, where there is one.
bool MeshChoice::takeCap(DrawItem& item, const Instance& instance,
                         const generator::Surface& surface, const ViewTransform& view,
                         glm::dmat4& viewFromObject) {
    std::optional<BallCap> cap = ballCap(surface, instance.worldFromObject, view, errorPx_);
    if (!cap) return false;
    MeshPlace place{instance.worldFromObject};
    place.hasSurface = true;
    if (!take(item, placeInDouble(std::move(cap->mesh), place, view, verticesLeft()),
              viewFromObject))
        return false;
    item.surface = surface;
    item.isOnSurface = true;
    item.unitFromObject = glm::vec3(1.0 / surface.lengths);
    item.surfaceEye = glm::vec3(cap->eye);
    warnOfOutline(*instance.model, cap->errorPx);
    return true;
}

void MeshChoice::warnOfOutline(const scene::Model& model, double errorPx) {
    if (!(errorPx > std::max(1.0, errorPx_))) return;
    if (!warned_.insert(&model).second) return;  // a copy of it has been named
    findings_.push_back(
        diagnosticOf(Severity::warning,
                     message<"scene.outline">("error"_arg = std::ceil(errorPx),
                                              "most"_arg = generator::kMaxDivisions),
                     model.where));
}

std::size_t MeshChoice::verticesLeft() const { return kMaxNearVertices - nearVertices_; }

/// Draws the mesh as placed in double. False where there is none.
bool MeshChoice::take(DrawItem& item, const std::optional<NearMesh>& near,
                      glm::dmat4& viewFromObject) {
    if (!near) return false;
    item.mesh = near->mesh;
    viewFromObject[3] += glm::dvec4(glm::dmat3(viewFromObject) * near->eye, 0.0);
    nearVertices_ += near->mesh->mesh.positions().size();
    return true;
}

bool MeshChoice::placeNear(DrawItem& item, const Instance& instance, const ViewTransform& view,
                           glm::dmat4& viewFromObject) {
    const bool isLit = style_.lit && style_.layer == Layer::color;
    if (drawsLines(style_)) return true;  // they would show the cuts
    MeshPlace place{instance.worldFromObject};
    for (int i = 0; i < 3; ++i) place.worldFromObject[i] *= item.mesh->balance[i];
    place.isGouraud = isLit && style_.shading == scene::Shading::gouraud;
    place.isFlat = isLit && style_.shading == scene::Shading::flat;
    place.keepsParity = style_.shading == scene::Shading::chess;
    place.hasSurface = item.surface.has_value();
    if (!item.mesh->eyePositions.empty()) return true;  // it is
    take(item, placeInDouble(*item.mesh, place, view, verticesLeft()), viewFromObject);
    return !item.mesh->mesh.indices().empty();
}

}  // namespace farol::render
