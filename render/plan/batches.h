#pragma once

#include <cstddef>
#include <vector>

#include "render/plan/frame_plan.h"

namespace farol::render {

/// The smallest batch that is one instanced call: fewer do not pay for its shader.
inline constexpr std::size_t kMinInstances = 8;

/// True where two models have the same material and texture, laid out alike.
bool sameMaterial(const DrawItem& a, const DrawItem& b);

/// Orders all items. Where two surfaces lie in one place the first of the document wins: a model
/// moves up to its likes only past models that it cannot meet, since no pixel is theirs in common
/// or their distances differ. Items from `blendedFrom` on keep their order. Without `merge` each
/// item is a batch.
Batches batchesOf(const std::vector<DrawItem>& items, const ViewTransform& view, bool merge,
                  std::size_t blendedFrom);

}  // namespace farol::render
