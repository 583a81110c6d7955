#pragma once

#include <memory>
#include <string>
#include <vector>

#include "grade/requirements/requirement.h"
#include "grade/rubric/rubric.h"
#include "render/plan/mesh_library.h"
#include "render/renderer.h"

namespace farol::grade {

/// How far a requirement is met.
enum class Met { no, partly, yes };
inline constexpr EnumWords<Met, Met::yes> kMetWords{"not met", "partly met", "met"};

/// An object, light or file that matches a requirement, or nearly does.
struct RequiredThing {
    Message who;          ///< "\"Earth\"", "model 4 (sphere)"
    Location where;       ///< its lines in the document, or a vertex's in its file
    std::string excerpt;  ///< the lines there
    Message reason;       ///< why it does not match; empty: it does
};

/// One requirement as it was found.
struct RequirementGrade {
    std::string id, text;  ///< of the rubric
    double points = 0, most = 0;
    Met met = Met::no;
    int found = 0, needed = 0;
    Message reason;                      ///< "7 of 8 found"
    std::vector<RequiredThing> matches;  ///< the first kShownThings
    std::vector<RequiredThing> misses;   ///< likewise; none where the requirement is met
};
inline constexpr std::size_t kShownThings = 24;

/// What is known of an object, for `farol explain`.
struct ExplainedObject {
    RequiredThing thing;
    std::string shape, image;
    int depth = 0;
    double radius = 0;  ///< world units, at the first time
    bool moves = false;
    std::vector<int> pixels;  ///< by time
    std::optional<double> orbitRadius, periodS;
};
struct ExplainedSelector {
    std::string id;
    bool isDefinition = false;
    std::vector<ExplainedObject> objects;  ///< the first kShownThings
    std::size_t count = 0;                 ///< of all matches
    std::vector<RequiredThing> misses;
};

/// Turns a count into points. `base`: the number of objects of Requirement::each.
RequirementGrade gradeOf(const Requirement& rule, int found, int base);

/// Evaluates a rubric's requirements on a scene. `prepared` was read from `job`.
class Requirements {
  public:
    /// All outlive it.
    Requirements(const Rubric& rubric, render::Renderer& renderer, render::MeshLibrary& meshes,
                 std::shared_ptr<const render::Prepared> prepared, const render::Job& job);
    ~Requirements();

    /// Throws Error as Renderer::draw does.
    std::vector<RequirementGrade> grade();
    std::vector<ExplainedSelector> explain();
    /// Returns the times of the measured facts.
    const std::vector<double>& timesS() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Evaluates mesh requirements on files alone, for submissions without a scene; the others are not
/// met.
std::vector<RequirementGrade> gradeFiles(const Rubric& rubric, const scene::Assets& files);

}  // namespace farol::grade
