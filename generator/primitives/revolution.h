#pragma once

#include "generator/entry.h"

namespace farol::generator::primitives {

/// The profile (x = radius, y = height; z is not used) turned about Y in `copies` copies, the
/// first in the +X half of the XY plane, the last upon the first: copies - 1 slices, turning from
/// +X towards -Z. s = copy/(copies - 1); t grows with arc length along the profile. Points keep
/// their places; a point given twice makes a crease; a point on the axis has one vertex a slice.
/// Normals are smooth along the profile. A profile that runs downwards is turned inside out, so
/// that faces look away from the axis. Open ends stay open. Throws mesh.profile for a profile of
/// fewer than two different points, or one on both sides of the axis.
Mesh revolution(const std::vector<glm::dvec3>& profile, std::size_t copies,
                const std::string& fileName);

ShapeEntry revolutionEntry();

}  // namespace farol::generator::primitives
