#pragma once

#include <vector>

#include "grade/rubric/grader.h"
#include "grade/structure/diagnosis.h"

namespace farol::grade {

/// Measurements of a scene against a reference scene.
struct Evidence {
    const Diagnosis* diagnosis = nullptr;
    std::vector<double> spoiled;  ///< by cause: share of the weighted work, 0..1
    double unexplained = 0;       ///< share of the weighted work that all repairs leave wrong
    double present = 1;           ///< share of the weighted work that is there
    int lights = 0;               ///< of the reference
    bool hasCamera = true, moves = false;  ///< the reference
    double penalty = 0;                    ///< hundredths, for errors repaired to read the document
    bool isUnclosed = false;  ///< an end tag is missing: groups under wrong parents follow
};

/// The rubric's criteria that apply to pictures; where it has none, `difference` and `flip`.
std::vector<Criterion> pictureCriteria(const Rubric& rubric);

/// Turns measurements and causes into points: fills in criteria, causes, penalty, points and
/// passed. `evidence`: both sides are scenes, or without a diagnosis one that is graded alone;
/// null: criteria of images share all points of the comparison. `xml` is the submission's
/// document, for excerpts, `name` its name in locations.
void score(Grade& grade, const Evidence* evidence, const Rubric& rubric, const std::string& xml,
           const std::string& name);

}  // namespace farol::grade
