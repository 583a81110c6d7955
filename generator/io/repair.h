#pragma once

#include <string>

#include "core/error.h"
#include "generator/mesh.h"

namespace farol::generator::io {

/// Makes a mesh read from a file fit to draw, with a warning for each kind of repair:
/// missing normals are the normalised sum of the unit normals of the adjacent faces (one pass,
/// faces without area skipped); zero or NaN normals are replaced by the same; normals of another
/// length are normalised; a closed mesh whose volume is negative is turned to face outwards; a
/// mesh without any area is only reported.
/// `smooth`: RawMesh::smooth. Precondition: checkStructure; `smooth` is empty or as long as the
/// positions, each number below that length.
void repair(MeshArrays& mesh, const std::vector<std::uint32_t>& smooth, const std::string& fileName,
            Diagnostics& findings);

/// The sums described above, one a vertex; +Y for a vertex without a face that has an area.
std::vector<glm::vec3> vertexNormals(const std::vector<glm::vec3>& positions,
                                     const std::vector<std::uint32_t>& indices,
                                     const std::vector<std::uint32_t>& smooth = {});

/// True when, with equal positions taken as one vertex, every edge is used as often in one
/// direction as in the other. Triangles that then have two equal corners do not count.
bool isClosed(const MeshArrays& mesh);

/// The volume by the divergence theorem: positive for a closed mesh that faces outwards.
double signedVolume(const MeshArrays& mesh);

}  // namespace farol::generator::io
