#pragma once

#include <memory>
#include <string>
#include <vector>

#include "grade/finding.h"
#include "grade/rubric.h"
#include "grade/subject.h"
#include "render/renderer.h"

namespace farol::grade {

/// One criterion's share in a grade.
struct CriterionGrade {
    Measure measure = Measure::difference;
    double points = 0, most = 0;
    double measured = 0;  ///< of measured ones: 0 (alike) to 1, mean over the views
    std::string reason;   ///< the points explained in one sentence
};

/// A finding, and what it cost: nothing where the pictures are the same all the same.
struct CostedFinding {
    Finding finding;
    double points = 0;
    std::string excerpt;  ///< the lines of the document at its place
};

/// One view of both, at one time.
struct ViewGrade {
    std::string name;
    double timeS = 0;
    int width = 0, height = 0;
    double difference = 0, flipMean = 0, flipP95 = 0, ssim = 1, coverage = 0, depth = 0,
           normals = 0;   ///< as the measures of the same names; ssim: the mean itself
    std::string picture;  ///< JPEG of the submission; empty where it is the reference's
    std::string heat;     ///< JPEG of the difference; empty where there is none
};

/// Wall time of the stages, ms: reports leave it out, so that they stay the same.
struct GradeTimes {
    double readMs = 0, drawMs = 0, compareMs = 0;
};

struct Grade {
    double points = 0, most = 0;
    bool passed = false, refused = false;  ///< refused: it could not be read
    bool visible = false;                  ///< some picture differs by more than rounding
    double penalty = 0;                    ///< points, for diagnostics
    std::vector<CriterionGrade> criteria;
    std::vector<CostedFinding> findings;
    Diagnostics diagnostics;
    std::vector<std::string> excerpts;  ///< the lines at each diagnostic's place, or ""
    std::vector<ViewGrade> views;
    GradeTimes times;
};

/// Grades submissions with one renderer. References are kept: the same one costs once.
class Grader {
  public:
    /// `renderer` outlives the grader.
    explicit Grader(render::Renderer& renderer);
    ~Grader();

    /// Throws Error when the reference is at fault; a submission that is at fault is refused.
    /// The same arguments give the same grade, whatever was graded before.
    Grade grade(const Subject& reference, const Subject& submission, const Rubric& rubric);

    /// What each view shows of the reference, JPEG, in the order of Grade::views. Throws Error.
    std::vector<std::string> picturesOf(const Subject& reference, const Rubric& rubric);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// The grade as JSON (docs/grading.md), without the pictures.
std::string toJson(const Grade& grade);

}  // namespace farol::grade
