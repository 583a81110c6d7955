#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "render/plan/frame_plan.h"

/// Bounds the cost of a frame by its pixels, for any number of models.
namespace farol::render {

/// Reductions of a frame that holds more detail than its pixels can show.
struct Crowd {
    double coarsening = 1.0;   ///< factor of the requested error of adaptive shapes
    bool isOneSample = false;  ///< one sample a pixel, unless their number is set
};

/// Coarsest that a crowd gets: beyond it shapes are as coarse as they come.
inline constexpr double kMostCoarsening = 65536.0;
/// Layers of models' boxes over the whole image from which on a pixel gets one sample: four cost
/// up to seven times as much, and hundreds of layers leave no outline of any model.
inline constexpr double kMaxLayers = 256.0;

/// Triangles that the open shapes of an image may have: a million, and eight a pixel; 16 million at
/// most.
std::int64_t triangleBudget(const glm::ivec2& size);

/// Orders models front to back within each run of equal neighbours in a crowd of more than
/// kSortedLayers: pixels are shaded less often. Only models of one material without texture trade
/// places: where two of them tie they look the same. `layers`: boxes over the whole image.
void sortCrowd(std::vector<DrawItem>& items, double layers);
inline constexpr double kSortedLayers = 64.0;

}  // namespace farol::render
