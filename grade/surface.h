#pragma once

#include "grade/tree.h"

namespace farol::grade {

/// How two meshes at their places differ: shares 0..1 of the corners that both have. Positions,
/// normals and texture coordinates are compared in world space, whatever the order of vertices and
/// triangles, and however they were split.
struct Surface {
    bool compared = false;  ///< false: too large, or nothing to compare
    double common = 0;      ///< the smaller share, of either, of vertices that the other has too
    double normalsSame = 0, normalsOpposite = 0;
    double normalsUntransposed = 0;  ///< transformed as directions, not by the inverse transpose
    double normalsOfFaces = 0;       ///< those of the face where the reference is smooth
    double windingReversed = 0;      ///< triangles whose front is where the reference has its back
    bool uvs = false;                ///< both have texture coordinates
    double uvSame = 0, uvUpsideDown = 0, uvMirrored = 0, uvBoth = 0, uvSwapped = 0;

    /// The same surface to look at: nothing of what is above differs by more than rounding.
    bool same() const;
};

/// Compares a reference's piece with a submission's.
Surface compareSurfaces(const Piece& reference, const Piece& submission);

}  // namespace farol::grade
