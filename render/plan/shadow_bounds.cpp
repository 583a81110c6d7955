#include "render/plan/shadow_bounds.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "render/plan/polygon.h"

namespace farol::render {
namespace {

/// Models larger than this share of the scene's diagonal, or of the sum of all, are looked at
/// closely; at most so many.
constexpr double kLarge = 0.25;
constexpr int kMaxLarge = 8;
constexpr std::size_t kMaxConvexTriangles = 64;

struct Plane : ClipPlane {
    double slack = 0.0;  ///< rounding of its places along the normal, world units
};

bool isSeenThrough(const scene::Model& model) {
    return model.opacity < 1.0F || (model.material && model.material->opacity < 1.0F);
}

double diagonalOf(const CastingBox& box) { return glm::length(box.corners[7] - box.corners[0]); }

/// Rounding along a normal of what a mesh's floats, up to `most`, times the columns of `linear`,
/// are in the world at a place. A ground's is that of doubles alone, however wide it is.
double roundingOf(const glm::dvec3& normal, const glm::dmat3& linear, const glm::dvec3& most,
                  const glm::dvec3& place) {
    double rounding = 1e-15 * glm::length(place);
    for (int axis = 0; axis < 3; ++axis)
        rounding += most[axis] * (1e-7 * std::abs(glm::dot(normal, linear[axis])) +
                                  1e-15 * glm::length(linear[axis]));
    return rounding;
}

double roundingOf(const glm::dvec3& normal, const CastingBox& box) {
    const auto& c = box.corners;
    return roundingOf(normal, glm::dmat3(c[1] - c[0], c[2] - c[0], c[4] - c[0]), glm::dvec3(1.0),
                      c[0]);
}

/// The planes of a small convex mesh's faces, world space; none of any other mesh.
std::vector<Plane> facesOf(const Instance& instance) {
    const generator::Mesh& mesh = instance.mesh->mesh;
    if (mesh.triangles() > kMaxConvexTriangles) return {};
    std::vector<glm::dvec3> places;
    for (const glm::vec3& position : mesh.positions())
        places.emplace_back(instance.worldFromObject * glm::dvec4(position, 1.0));
    glm::dvec3 most(0.0);
    for (const glm::vec3& position : mesh.positions())
        most = glm::max(most, glm::abs(glm::dvec3(position)));
    const bool isMirrored = glm::determinant(glm::dmat3(instance.worldFromObject)) < 0.0;
    std::vector<Plane> planes;
    for (std::size_t i = 0; i + 2 < mesh.indices().size(); i += 3) {
        const glm::dvec3& a = places[mesh.indices()[i]];
        glm::dvec3 normal =
            glm::cross(places[mesh.indices()[i + 1]] - a, places[mesh.indices()[i + 2]] - a);
        const double length = glm::length(normal);
        if (!(length > 0.0)) continue;
        normal *= (isMirrored ? -1.0 : 1.0) / length;
        const double slack = roundingOf(normal, glm::dmat3(instance.worldFromObject), most,
                                        glm::dvec3(instance.worldFromObject[3]));
        const Plane plane{{normal, -glm::dot(normal, a)}, slack};
        bool isHull = true, isFlat = true;
        for (const glm::dvec3& place : places) {
            isHull &= plane.distance(place) <= slack;
            isFlat &= std::abs(plane.distance(place)) <= slack;
        }
        if (!isHull) return {};
        planes.push_back(plane);
        if (isFlat) planes.push_back({-plane.normal, -plane.offset, slack});
    }
    return planes;
}

/// True if the light and all others are before one of the instance's faces.
bool standsBehind(const InstanceList& list, const std::vector<CastingBox>& boxes, std::size_t index,
                  const LightPlace& light) {
    for (const Plane& plane : facesOf(list.instances[index])) {
        const double side =
            light.isPositional ? plane.distance(light.at) : glm::dot(plane.normal, light.at);
        if (!(side > (light.isPositional ? plane.slack : 1e-9))) continue;
        bool areBefore = true;
        for (std::size_t i = 0; i < boxes.size() && areBefore; ++i) {
            if (i == index || !boxes[i].isThere) continue;
            const double either = plane.slack + roundingOf(plane.normal, boxes[i]);
            for (const glm::dvec3& corner : boxes[i].corners)
                areBefore &= plane.distance(corner) >= -either;
        }
        if (areBefore) return true;
    }
    return false;
}

/// Six corners' quads of a box or a frustum, whose corner i has the bits of its three sides.
constexpr std::array<std::array<int, 4>, 6> kQuads{
    {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};

/// The planes of those quads, with what the corners enclose before them.
std::vector<Plane> planesOf(const std::array<glm::dvec3, 8>& corners) {
    glm::dvec3 middle(0.0);
    for (const glm::dvec3& corner : corners) middle += corner / 8.0;
    std::vector<Plane> planes;
    for (const auto& quad : kQuads) {
        const auto at = [&](int i) {
            return corners[static_cast<std::size_t>(quad[static_cast<std::size_t>(i)])];
        };
        glm::dvec3 normal = glm::cross(at(2) - at(0), at(3) - at(1));
        const double length = glm::length(normal);
        if (!(length > 0.0)) continue;  // a flat box
        normal /= length;
        Plane plane{{normal, -glm::dot(normal, 0.25 * (at(0) + at(1) + at(2) + at(3)))}};
        if (plane.distance(middle) < 0.0) plane = {-plane.normal, -plane.offset};
        planes.push_back(plane);
    }
    return planes;
}

void addCut(const std::array<glm::dvec3, 8>& corners, const std::vector<Plane>& planes,
            std::vector<glm::dvec3>& out) {
    for (const auto& quad : kQuads) {
        Polygon polygon;
        for (const int i : quad) polygon.push_back(corners[static_cast<std::size_t>(i)]);
        for (const Plane& plane : planes) polygon = cutPolygon(polygon, plane);
        out.insert(out.end(), polygon.begin(), polygon.end());
    }
}

std::array<glm::dvec3, 8> cornersOf(const ViewTransform& view) {
    std::array<glm::dvec3, 8> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const double away = i & 4 ? view.far : view.near;
        const glm::dvec3 eye((i & 1 ? 1.0 : -1.0) * view.tanHalfFov.x * away,
                             (i & 2 ? 1.0 : -1.0) * view.tanHalfFov.y * away, -away);
        corners[i] = view.eye + glm::transpose(view.rotation) * eye;
    }
    return corners;
}

/// Adds the corners of the part of a box that is in the view of these corners and planes.
void addVisible(const std::array<glm::dvec3, 8>& box, const std::array<glm::dvec3, 8>& view,
                const std::vector<Plane>& planes, std::vector<glm::dvec3>& out) {
    bool isInside = true;
    for (const Plane& plane : planes) {
        const auto before = std::count_if(box.begin(), box.end(), [&](const glm::dvec3& corner) {
            return plane.distance(corner) >= 0.0;
        });
        if (before == 0) return;
        isInside &= before == 8;
    }
    if (isInside) {
        out.insert(out.end(), box.begin(), box.end());
        return;
    }
    addCut(box, planes, out);
    // A flat box has no inside to cut the view by.
    const std::vector<Plane> sides = planesOf(box);
    if (sides.size() == kQuads.size()) addCut(view, sides, out);
}

}  // namespace

std::vector<CastingBox> castingBoxes(const InstanceList& list, bool isTransparent) {
    std::vector<CastingBox> boxes(list.instances.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const Instance& instance = list.instances[i];
        const Box& box = instance.mesh->bounds;
        boxes[i].isThere = !box.empty() && !instance.mesh->mesh.indices().empty();
        if (!boxes[i].isThere) continue;
        boxes[i].casts = !(isTransparent && isSeenThrough(*instance.model));
        for (int corner = 0; corner < 8; ++corner)
            boxes[i].corners[static_cast<std::size_t>(corner)] =
                glm::dvec3(instance.worldFromObject * glm::dvec4(box.corner(corner), 1.0));
    }
    return boxes;
}

std::vector<std::size_t> castersUnder(const InstanceList& list,
                                      const std::vector<CastingBox>& boxes,
                                      const LightPlace& light) {
    const double large =
        kLarge * std::min(glm::length(list.bounds.max - list.bounds.min), sumOfDiagonals(boxes));
    std::vector<std::size_t> casters;
    int looks = 0;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        if (!boxes[i].casts) continue;
        if (diagonalOf(boxes[i]) > large && looks < kMaxLarge) {
            ++looks;
            if (standsBehind(list, boxes, i, light)) continue;
        }
        casters.push_back(i);
    }
    return casters;
}

double sumOfDiagonals(const std::vector<CastingBox>& boxes) {
    double sum = 0.0;
    for (const CastingBox& box : boxes)
        if (box.isThere) sum += diagonalOf(box);
    return sum;
}

std::vector<glm::dvec3> visibleCorners(const std::array<glm::dvec3, 8>& box,
                                       const ViewTransform& view) {
    std::vector<glm::dvec3> corners;
    const std::array<glm::dvec3, 8> ofView = cornersOf(view);
    addVisible(box, ofView, planesOf(ofView), corners);
    return corners;
}

std::vector<glm::dvec3> visibleCorners(const std::vector<CastingBox>& boxes,
                                       const ViewTransform& view) {
    std::vector<glm::dvec3> corners;
    const std::array<glm::dvec3, 8> ofView = cornersOf(view);
    const std::vector<Plane> planes = planesOf(ofView);
    for (const CastingBox& box : boxes)
        if (box.isThere) addVisible(box.corners, ofView, planes, corners);
    return corners;
}

}  // namespace farol::render
