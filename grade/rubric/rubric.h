#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/bounded_json.h"
#include "core/enum_words.h"
#include "grade/images/mask.h"
#include "grade/requirements/requirement.h"
#include "grade/rubric/metrics.h"
#include "render/options.h"
#include "scene/scene.h"

namespace farol::grade {

/// One line of the rubric. A loss from `tolerance` down costs nothing, from `limit` up all.
struct Criterion {
    const MetricSpec* metric;             ///< of metrics()
    double weight = 1.0;                  ///< 0..1000; shares of the points
    double tolerance = 0.0, limit = 1.0;  ///< 0..1, tolerance < limit; of image metrics
    double perFinding = 0.5;              ///< of topics: 0.5 costs as in the table of kinds
};

/// A camera to look at both scenes with.
struct View {
    std::string name;
    enum class Kind { own, reference, orbit } kind = Kind::own;
    double azimuthDeg = 0.0, elevationDeg = 0.0;  ///< orbit: turned about the reference's target
    double distance = 1.0;                        ///< orbit: times the reference's
};
inline constexpr EnumWords<View::Kind, View::Kind::orbit> kViewWords{"own", "reference", "orbit"};

/// How a cause shows the reference's numbers.
enum class Reveal { words, values };
inline constexpr EnumWords<Reveal, Reveal::values> kRevealWords{"words", "values"};

/// How submissions are judged (api/rubric.schema.json).
struct Rubric {
    std::string title = "Rubric";
    double points = 100.0;    ///< of a perfect submission
    double weight = 1.0;      ///< of the task among those of a class, 0..1000
    double passMark = 50.0;   ///< per cent of the points
    double strictness = 1.0;  ///< times every loss
    std::optional<int> width, height;
    int samples = 1;
    std::optional<scene::Shading> shading;
    std::optional<scene::Filter> filter;
    bool axes = false;
    std::vector<double> timesS;  ///< empty: 0, and a moment later where the reference moves
    std::vector<View> views;
    bool cropAuto = true;  ///< cuts window frames off screenshots
    bool maskAxes = true;  ///< where a picture is compared with a screenshot
    std::vector<Rectangle> masks;
    bool lend = true;  ///< the reference's pictures and models to submissions that lack them
    bool takesImages = false;  ///< grades a picture in place of a scene
    Reveal reveal = Reveal::words;
    std::vector<Definition> definitions;
    std::vector<Requirement> requirements;
    std::vector<ManualCriterion> manual;
    std::vector<Criterion> criteria;       ///< of the comparison with a reference
    double perWarning = 0.0;               ///< points
    std::map<std::string, double> byCode;  ///< points for each diagnostic or finding of that code
    double mostPenalty = 10.0;             ///< points
};

/// The points that requirements and marks by hand share.
double requiredPoints(const Rubric& rubric);

/// The points that the comparison with a reference shares: what requirements and marks by hand
/// leave. 0: no reference is needed.
double comparedPoints(const Rubric& rubric);

/// Returns whether a submission must hold a scene: not where all that is asked for are mesh files.
bool needsScene(const Rubric& rubric);

/// The rubric that is used where none is given.
Rubric defaultRubric();

inline constexpr JsonLimits kRubricJson{.bytes = 262'144, .stringBytes = 4'096};
/// Reads a rubric (at most kRubricJson); missing keys have the default's values. Throws Error
/// rubric.json, rubric.key, rubric.type, rubric.range, each with line, column and JSON pointer of
/// the value: "/criteria/2/weight", also in `field`.
/// Without "points" and "criteria" a rubric with requirements has the sum of their points.
Rubric readRubric(const std::string& json, const std::string& name);

/// The rubric as readRubric takes it, every key written.
std::string writeRubric(const Rubric& rubric);

/// The JSON schema of rubrics: api/rubric.schema.json.
std::string rubricSchema();

}  // namespace farol::grade
