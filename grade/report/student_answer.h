#pragma once

#include <string>
#include <vector>

#include "core/bounded_json.h"
#include "grade/rubric/grader.h"

namespace farol::grade {

/// What a student may see of a grade. `requirements` and `document` depend on the student's own
/// submission alone; the criteria say where it differs from the reference, never how.
enum class Shown {
    requirements,  ///< which are met, partly met or not, with lines
    document,      ///< diagnostics of the document
    models,
    transforms,
    textures,
    materials,
    lights,
    camera,
    animation
};
inline constexpr EnumWords<Shown, Shown::animation> kShownWords{
    "requirements", "document", "models", "transforms", "textures",
    "materials",    "lights",   "camera", "animation"};

inline constexpr int kMinBands = 2, kMaxBands = 10;
/// Tries of one student where an assignment does not say more: with them and four bands no hidden
/// number becomes known (tests/unit/grade/leak_test.cpp).
inline constexpr int kDefaultTriesPerHour = 2, kDefaultTries = 12;

struct StudentView {
    int bands = 4;                   ///< kMinBands..kMaxBands, of the same width
    std::vector<std::string> shows;  ///< of kShownWords
    bool hasMask = false;            ///< coarseMask() of the first view

    bool isShown(Shown what) const;
};

/// Returns the band of a grade, 0..bands - 1. Marks by hand are left out of it; what is not graded
/// is in band 0.
int bandOf(const Grade& grade, int bands);

/// Returns the JSON object of an answer (docs/reference/http.md) without the own image: the band,
/// requirements, findings and the mask. No text, number or order in it depends on the reference
/// beyond the band, which lines have a finding of a criterion that `view` shows, and the mask.
std::string studentAnswer(const Grade& grade, const StudentView& view, Language language);
inline constexpr JsonLimits kStudentAnswerJson{.bytes = std::size_t{4} << 20U,
                                               .depth = 6,
                                               .keys = 1'000,
                                               .values = 100'000,
                                               .stringBytes = 65'536};

}  // namespace farol::grade
