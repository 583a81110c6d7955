#include "grade/structure/forms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "generator/entry.h"
#include "generator/registry.h"

namespace farol::grade {
namespace {

constexpr double kBoxesAlike = 0.06;    // of the extents: coarse divisions shrink a box by this
constexpr double kMomentsAlike = 0.03;  // of the extents

/// unitFromMesh^-1: brings the cube of -1..1 to the bounds; flat directions keep their scale.
glm::dmat4 meshFromUnit(const render::Box& bounds) {
    if (bounds.empty()) return glm::dmat4(1.0);
    const glm::dvec3 half = 0.5 * (bounds.max - bounds.min);
    const double most = std::max({half.x, half.y, half.z, 1e-12});
    glm::dvec3 scale = half;
    for (int axis = 0; axis < 3; ++axis)
        if (scale[axis] < 1e-6 * most) scale[axis] = 1.0;
    glm::dmat4 out = glm::translate(glm::dmat4(1.0), 0.5 * (bounds.max + bounds.min));
    return glm::scale(out, scale);
}

bool boxesAlike(const render::Box& a, const render::Box& b) {
    if (a.empty() || b.empty()) return false;
    const double reach = kBoxesAlike * glm::length(a.max - a.min);
    const glm::dvec3 off = glm::max(glm::abs(a.min - b.min), glm::abs(a.max - b.max));
    return std::max({off.x, off.y, off.z}) <= reach;
}

bool momentsAlike(const Moments& a, const Moments& b, double size) {
    if (glm::length(a.middle - b.middle) > kMomentsAlike * size) return false;
    double off = 0.0;
    for (int column = 0; column < 3; ++column)
        off = std::max(off, glm::length(a.spread[column] - b.spread[column]));
    return off <= kMomentsAlike * size * size;
}

glm::dmat3 gram(const glm::dmat3& m) { return m * glm::transpose(m); }

double largest(const glm::dmat3& m) {
    double most = 0.0;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) most = std::max(most, std::abs(m[column][row]));
    return most;
}

/// Returns the part of an axial object's matrix that determines its width around the axis.
glm::dmat3 across(const glm::dmat4& m) {
    glm::dmat3 out(m);
    out[1] = glm::dvec3(0.0);
    return gram(out);
}

/// How far corners may be off, world units.
double toleranceFor(const glm::dmat4& m, const render::Box& bounds, double sceneSize) {
    constexpr double kOfScene = 4e-4, kOfObject = 0.01;
    const glm::dvec3 size = bounds.empty() ? glm::dvec3(1.0) : bounds.max - bounds.min;
    const double extent = glm::length(glm::dvec3(glm::length(glm::dvec3(m[0])) * size.x,
                                                 glm::length(glm::dvec3(m[1])) * size.y,
                                                 glm::length(glm::dvec3(m[2])) * size.z));
    return std::min(kOfScene * sceneSize + kOfObject * extent, 2e-3 * sceneSize);
}

/// A matrix between two meshes: of their positions, and of their places, which have the meshes'
/// origins, too.
struct Way {
    glm::dmat4 mineFromTheirs, placesMineFromTheirs;
};

std::vector<Way> waysBetween(const render::MeshData& theirs, const render::MeshData& mine) {
    const render::Box &a = theirs.bounds, &b = mine.bounds;
    const glm::dvec3 &from = theirs.mesh.origin(), &to = mine.mesh.origin(), off = to - from;
    const glm::dmat4 same(1.0);
    std::vector<Way> ways;
    if (boxesAlike(a, {b.min + off, b.max + off}))
        ways.push_back({glm::translate(same, -off), same});
    const glm::dmat4 scaled = meshFromUnit(b) * glm::inverse(meshFromUnit(a));
    ways.push_back({scaled, glm::translate(same, to) * scaled * glm::translate(same, -from)});
    return ways;
}

}  // namespace

render::Box boundsOf(const render::MeshData& mesh) {
    if (mesh.bounds.empty()) return mesh.bounds;
    return {mesh.mesh.origin() + mesh.bounds.min, mesh.mesh.origin() + mesh.bounds.max};
}

Symmetry symmetryOf(const Outline::Item& item) {
    const scene::ShapeCall& call = item.model.source.shape;
    if (item.model.texture || item.model.source.kind != scene::ModelSource::Kind::shape ||
        call.entry == nullptr || call.entry->surface == nullptr)
        return Symmetry::none;
    constexpr double kRound = 12;  // divisions: fewer are seen to turn
    double turn = 0.0;
    for (std::size_t i = 0; i < call.arguments.size() && turn == 0.0; ++i)
        if (call.entry->arguments[i].isLevel()) turn = call.arguments[i].value;
    if (turn < kRound && !generator::isAdaptive(item.model)) return Symmetry::none;
    if (call.entry->name == "sphere") return Symmetry::ball;
    const bool isRound = call.entry->name == "cone" || call.entry->name == "cylinder" ||
                         call.entry->name == "torus" || call.entry->name == "ring" ||
                         call.entry->name == "frustum" || call.entry->name == "dome";
    return isRound ? Symmetry::axial : Symmetry::none;
}

const KnownMesh& ReferenceMeshes::get(const Outline::Item& item) {
    const auto found = known_.find(item.mesh->id);
    if (found != known_.end()) return found->second;
    return known_.emplace(item.mesh->id, KnownMesh(item.model, item.mesh->mesh, *assets_))
        .first->second;
}

const Likeness& Forms::compare(const Outline::Item& theirs, const Outline::Item& mine) {
    const auto key = std::make_pair(theirs.mesh->id, mine.mesh->id);
    const auto found = known_.find(key);
    if (found != known_.end()) return found->second;
    return known_.emplace(key, measure(theirs, mine)).first->second;
}

Likeness Forms::measure(const Outline::Item& theirs, const Outline::Item& mine) {
    Likeness out;
    if (theirs.mesh->id == mine.mesh->id || theirs.mesh->mesh == mine.mesh->mesh) {
        out.surface.isCompared = true;
        out.surface.common = out.surface.normalsSame = 1.0;
        out.surface.hasUvs = !theirs.mesh->mesh.uvs().empty();
        out.surface.uvSame = 1.0;
        return out;
    }
    const render::Box& bounds = theirs.mesh->bounds;
    if (bounds.empty() || mine.mesh->bounds.empty()) return out;
    const std::vector<Way> ways = waysBetween(*theirs.mesh, *mine.mesh);
    const double size = glm::length(bounds.max - bounds.min);
    const Moments wanted = momentsOf(theirs.mesh->mesh, glm::dmat4(1.0));
    for (const Way& way : ways) {
        const glm::dmat4 theirsFromMine = glm::inverse(way.mineFromTheirs);
        if (!momentsAlike(wanted, momentsOf(mine.mesh->mesh, theirsFromMine), size)) continue;
        const Surface surface =
            compareSurfaces(reference_.get(theirs), mine.mesh->mesh, theirsFromMine);
        if (surface.common > out.surface.common || !out.surface.isCompared)
            out = {surface, way.placesMineFromTheirs};
        if (out.isOneForm()) break;
    }
    if (!out.isOneForm()) out.mineFromTheirs = ways.back().placesMineFromTheirs;
    return out;
}

bool isSamePlace(const glm::dmat4& theirs, const glm::dmat4& mine, const render::Box& bounds,
                 Symmetry symmetry, double sceneSize) {
    const double reach = toleranceFor(theirs, bounds, sceneSize);
    if (symmetry != Symmetry::none && !bounds.empty()) {
        const glm::dvec4 middle(0.5 * (bounds.max + bounds.min), 1.0);
        if (glm::length(glm::dvec3((theirs - mine) * middle)) > reach) return false;
        const double radius = 0.5 * std::max(bounds.max.x - bounds.min.x, 1e-12);
        // |LL' - MM'| is about twice the length times the difference.
        const auto alike = [&](const glm::dmat3& a, const glm::dmat3& b) {
            const double length = std::sqrt(std::max(largest(a), largest(b)));
            return largest(a - b) * radius <= 2.0 * std::max(length, 1e-12) * reach;
        };
        if (symmetry == Symmetry::ball)
            return alike(gram(glm::dmat3(theirs)), gram(glm::dmat3(mine)));
        const double half = 0.5 * (bounds.max.y - bounds.min.y);
        return half * glm::length(glm::dvec3(theirs[1] - mine[1])) <= reach &&
               alike(across(theirs), across(mine));
    }
    const render::Box box = bounds.empty() ? render::Box{glm::dvec3(-1), glm::dvec3(1)} : bounds;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec4 p(box.corner(i), 1.0);
        if (glm::length(glm::dvec3(theirs * p - mine * p)) > reach) return false;
    }
    return true;
}

glm::dmat4 alignedTo(const glm::dmat4& theirs, const glm::dmat4& mine, Symmetry symmetry) {
    if (symmetry == Symmetry::none) return theirs;
    const glm::dmat3 a(theirs), b(mine);
    const double size = std::max(largest(a), 1e-12);
    glm::dmat4 out = mine;
    out[3] = theirs[3];
    if (symmetry == Symmetry::ball)
        return largest(gram(a) - gram(b)) < 0.02 * size * size ? out : theirs;
    const bool alike = glm::length(a[1] - b[1]) < 0.02 * size &&
                       largest(across(theirs) - across(mine)) < 0.02 * size * size;
    return alike ? out : theirs;
}

}  // namespace farol::grade
