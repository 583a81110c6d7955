#pragma once

#include <optional>

#include "scene/scene.h"

namespace farol::scene {

/// The time after which every motion and colour of the scene is where it was: the least common
/// multiple of all laps, turns and hue cycles, taken to the millisecond. Nothing for a scene that
/// stands still, or whose loop is longer than kMaxLoopSeconds.
std::optional<double> loopSeconds(const Scene& scene);

inline constexpr double kMaxLoopSeconds = 3600.0;

}  // namespace farol::scene
