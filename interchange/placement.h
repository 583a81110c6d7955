#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace farol::interchange {

/// Largest place or factor that models are written with: floats hold it.
inline constexpr double kMaxFloat = 3.4e38;

/// A node of glTF: parentFromNode = translation * rotation * scale. At most one of its parts
/// follows the time.
struct Placement {
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< unit length
    glm::dvec3 scale{1.0};
    const scene::FollowCurve* curve = nullptr;  ///< gives the translation, aligned the rotation too
    const scene::Spin* spin = nullptr;          ///< gives the rotation

    bool isIdentity() const;
};

/// Returns nodes, each a child of the one before it, whose product is that of a group's transforms
/// at `timeS`. A product of scales and rotations may shear, which one node cannot: there are as few
/// nodes as keep each in the form above. The transforms must outlive it. At least one.
std::vector<Placement> placementsOf(const std::vector<scene::Transform>& transforms, double timeS);

/// Times and values of a node's motion, interpolated linearly (rotations spherically).
struct Motion {
    std::vector<double> timesS;  ///< ascending from 0
    std::vector<glm::dvec3> translations;
    std::vector<glm::dquat> rotations;
    bool empty() const { return timesS.empty(); }
};

/// Most distance between a curve and its samples, as a share of the diagonal of its points' box,
/// where kMaxCurveSteps between two points suffice.
inline constexpr double kCurveError = 1e-3;
inline constexpr int kMaxCurveSteps = 64;

/// Returns the number of samples of the motion.
std::size_t countSamples(const Placement& node, double durationS);

/// Samples the motion of a node from `beginS` for `durationS`. A turn is exact at all times: its
/// samples are at most 90 degrees apart. A curve passes through its points and errs by
/// at most kCurveError between them.
Motion sample(const Placement& node, double beginS, double durationS);

/// Returns the rotation that turns -Z to the direction; none for a zero vector.
glm::dquat facing(const glm::dvec3& direction);

}  // namespace farol::interchange
