#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/bounded_json.h"
#include "core/language.h"
#include "grade/requirements/evaluate.h"
#include "grade/rubric/rubric.h"
#include "grade/rubric/severity.h"
#include "grade/rubric/subject.h"
#include "grade/rubric/traits.h"
#include "render/renderer.h"

namespace farol::grade {

/// One criterion's share in a grade.
struct CriterionGrade {
    const MetricSpec* metric;  ///< of metrics()
    double points = 0, most = 0;
    double measured = 0;  ///< of image metrics: the loss 0 (alike) to 1, mean over the views
    Message reason;       ///< the points explained
};

/// A place of the document that a cause stands at.
struct CausePlace {
    Message who;          ///< "group \"door\""
    Location where;       ///< line 0 where the submission lacks something
    std::string excerpt;  ///< the lines of the document there
};

/// A mistake and its cost in points: 0 if no view shows it.
struct GradedCause {
    std::string code;  ///< of kinds()
    Message message;
    std::vector<CausePlace> places;
    double points = 0;   ///< that it costs
    double spoiled = 0;  ///< share of the weighted work that it changes, 0..1
    bool isSeen = true;
};

/// The cause as a sentence in a language, with its places.
std::string textIn(Language language, const GradedCause& cause);

/// One view of both, at one time.
struct ViewGrade {
    std::string name;
    double timeS = 0;
    int width = 0, height = 0;
    std::map<const MetricSpec*, Measurement> measured;  ///< of those that were computed
    std::optional<std::string> picture;  ///< JPEG of the submission, unless it is the reference's
    std::optional<std::string> heat;     ///< JPEG of the difference, where there is one
    std::string mask;                    ///< coarseMask() of the difference; empty: none
};

/// Wall time of the stages, ms: reports leave it out, so that they stay the same.
struct GradeTimes {
    double readMs = 0, drawMs = 0, compareMs = 0;
};

/// Why a submission has no mark.
struct NotGraded {
    std::string code;  ///< "grade.image", "xml.empty"
    Message reason;
};

struct Grade {
    std::optional<NotGraded> notGraded;  ///< then there are no points
    double points = 0, most = 0;
    bool passed = false;
    bool visible = false;              ///< some picture differs by more than rounding
    double present = 1;                ///< share of the reference's work that is there, 0..1
    double penalty = 0;                ///< points, for diagnostics and repairs of the document
    double unexplained = 0;            ///< points, for differences without a cause
    double unexplainedShare = 0;       ///< share of the weighted work
    std::optional<double> similarity;  ///< of a picture that was handed in for a scene, 0..1
    std::vector<CriterionGrade> criteria;
    std::vector<RequirementGrade> requirements;
    std::vector<ManualCriterion> manual;  ///< open: a person marks them
    std::vector<GradedCause> causes;
    Diagnostics diagnostics;
    std::vector<std::string> excerpts;  ///< the lines at each diagnostic's place, or ""
    std::vector<ViewGrade> views;
    Traits traits;         ///< of a scene
    std::string document;  ///< its text in UTF-8, at most 60,000 bytes, to be shown
    GradeTimes times;
};

/// Grades submissions with one renderer. References are kept: the same one costs once.
class Grader {
  public:
    /// `renderer` outlives the grader.
    explicit Grader(render::Renderer& renderer);
    ~Grader();

    /// Without a reference (Subject::isNone) the submission is graded by the rubric's requirements.
    /// Throws Error when the reference is at fault; a submission that cannot be read is not graded.
    /// The grade depends on the arguments only, not on earlier calls.
    Grade grade(const Subject& reference, const Subject& submission, const Rubric& rubric);

    /// The image of the reference in each view, JPEG, in the order of Grade::views; none where
    /// there is no reference. Throws Error.
    std::vector<std::string> picturesOf(const Subject& reference, const Rubric& rubric);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// The grade as JSON (docs/grading.md), without the pictures.
std::string toJson(const Grade& grade, Language language = Language::en);
/// Bounds of that document where it is read again.
inline constexpr JsonLimits kGradeJson{.bytes = std::size_t{16} << 20U,
                                       .depth = 8,
                                       .keys = 1'000,
                                       .values = 400'000,
                                       .stringBytes = 65'536};

}  // namespace farol::grade
