#pragma once

#include <memory>
#include <string>
#include <vector>

#include "grade/structure/fix.h"
#include "grade/structure/forms.h"
#include "grade/structure/matching.h"

namespace farol::grade {

/// One mistake: the same slip at one place, or at several.
struct Cause {
    std::string code;
    std::vector<Fix> fixes;  ///< at least one
};

/// Why a submission is not the reference.
struct Diagnosis {
    Outline submitted;          ///< as handed in
    std::vector<Cause> causes;  ///< in the order of the document
    std::vector<Fix> harmless;  ///< other divisions of the same surface: always repaired
    Matching matching;          ///< with all causes repaired
    std::vector<int> missing;   ///< the reference's items that are not there
    double sceneSize = 1.0;

    /// The submission with all causes repaired but one; with all, for -1.
    Outline mendedBut(int cause) const;
};

/// A reference, prepared for diagnoses.
struct ReferenceScene {
    ReferenceScene(std::shared_ptr<const render::Prepared> prepared, render::MeshLibrary& meshes);

    std::shared_ptr<const render::Prepared> prepared;
    Outline outline;
    ReferenceMeshes meshes;
    double sceneSize = 1.0;  ///< its extent, world units
    bool isLit = true;
};

/// The times to compare at: `timesS`, and later ones where either scene moves.
std::vector<double> comparedTimes(const std::vector<double>& timesS, bool moves);

/// Searches the fewest changes of the submission's document that make it equal the reference:
/// places first, then the items' appearance, lights, the camera and settings. Throws Error as
/// MeshLibrary::get and image decoding do.
Diagnosis diagnose(ReferenceScene& reference, const render::Prepared& submission,
                   const std::vector<double>& timesS, render::MeshLibrary& meshes);

}  // namespace farol::grade
