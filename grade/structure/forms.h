#pragma once

#include <map>
#include <vector>

#include "grade/structure/outline.h"
#include "grade/structure/surface.h"

namespace farol::grade {

/// How two meshes relate in object space, wherever they stand.
struct Likeness {
    Surface surface;
    /// Of places: a sphere of radius 2 is one of radius 1 that is scaled.
    glm::dmat4 mineFromTheirs{1.0};

    bool isOneForm() const { return surface.isOnePlace(); }
};

/// Rotations that do not change an untextured surface.
enum class Symmetry { none, axial, ball };
Symmetry symmetryOf(const Outline::Item& item);

/// Data of the meshes of a reference for comparisons; it serves all submissions.
class ReferenceMeshes {
  public:
    explicit ReferenceMeshes(std::shared_ptr<const scene::Assets> assets)
        : assets_(std::move(assets)) {}
    const KnownMesh& get(const Outline::Item& item);

  private:
    std::shared_ptr<const scene::Assets> assets_;
    std::map<std::uint64_t, KnownMesh> known_;
};

/// Compares meshes of both sides, each pair once.
class Forms {
  public:
    explicit Forms(ReferenceMeshes& reference) : reference_(reference) {}
    const Likeness& compare(const Outline::Item& theirs, const Outline::Item& mine);

  private:
    Likeness measure(const Outline::Item& theirs, const Outline::Item& mine);

    ReferenceMeshes& reference_;
    std::map<std::pair<std::uint64_t, std::uint64_t>, Likeness> known_;
};

/// Returns the bounds of a mesh with its origin, object space.
render::Box boundsOf(const render::MeshData& mesh);

/// Returns whether both matrices put an object of these bounds (object space) at the same place: no
/// corner differs by more than rounding to three digits. `sceneSize` is the extent of the
/// reference.
bool isSamePlace(const glm::dmat4& theirs, const glm::dmat4& mine, const render::Box& bounds,
                 Symmetry symmetry, double sceneSize);

/// Returns `theirs`, with the orientation of `mine` if they differ by the symmetry only.
glm::dmat4 alignedTo(const glm::dmat4& theirs, const glm::dmat4& mine, Symmetry symmetry);

}  // namespace farol::grade
