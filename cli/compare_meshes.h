#pragma once

#include <string>

#include "cli/confine.h"

namespace farol::cli {

struct MeshComparison {
    std::string file, expected;  ///< paths
    std::string shape;           ///< a call, in place of the expected file
    ConfinementFlags confinement;
};

/// Returns whether `farol compare` is about meshes: a shape, or a mesh file's name.
bool isMeshComparison(const std::string& file, const std::string& shape);

/// Checks a mesh file against another one or a shape. Findings go to the report; kInputFault where
/// one is a mistake.
int compareMeshes(const MeshComparison& comparison, Report& report);

}  // namespace farol::cli
