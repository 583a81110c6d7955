#pragma once

#include "render/plan/frame_plan.h"

namespace farol::render {

/// Surfaces sorted in a pixel or a sample; those behind the last are left out.
inline constexpr int kMaxPeeledLayers = 64;

/// True where a box has no thickness along an axis, as that of a sheet.
bool isFlat(const Box& box);

/// Sorts see-through items behind the opaque ones, for composePasses; may be called again once
/// FramePlan::textureAlphas is known. Sets DrawItem::alpha, adds the inner sides of bodies with
/// holes or opacity under 1 (their own would be culled), and counts them in the statistics.
///
/// Blended items come in the order in which they are drawn: the farthest first, by the middle of
/// their depths along the view; of a body's inner side the middle of the farther half, of its outer
/// side that of the nearer, so that bodies within bodies are right. Of equal ones the first in the
/// document is in front, as of opaque ones. In layers other than the colours the nearest surface of
/// at least half opacity shows: items that cannot have it are removed, and none is blended.
///
/// Returns the number of items that are not blended.
std::size_t arrangeSeeThrough(FramePlan& plan);

}  // namespace farol::render
