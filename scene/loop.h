#pragma once

#include <optional>

#include "scene/scene.h"

namespace farol::scene {

/// Returns the period of all motions and colours of the scene: the least common multiple of all
/// laps, turns and hue cycles, rounded to the millisecond. Nothing for a still scene, or a period
/// longer than kMaxLoopSeconds.
std::optional<double> loopSeconds(const Scene& scene);

inline constexpr double kMaxLoopSeconds = 3600.0;

}  // namespace farol::scene
