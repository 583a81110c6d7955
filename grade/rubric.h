#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "grade/mask.h"
#include "render/options.h"
#include "scene/scene.h"

namespace farol::grade {

/// What a criterion measures. The first three take pictures alone; the others take two scenes.
enum class Measure {
    difference,  ///< share of the content that differs beyond a pixel's shift
    flip,        ///< mean FLIP over the content
    ssim,        ///< 1 - mean SSIM
    coverage,    ///< 1 - IoU of the objects' pixels, mean over objects
    depth,       ///< share of the objects' pixels at another depth
    normals,     ///< share of the objects' pixels with another normal
    transforms,  ///< the structural comparison: findings of each topic
    models,
    textures,
    materials,
    lights,
    camera
};
inline constexpr std::size_t kMeasures = 12;
const char* nameOf(Measure measure);
/// True for those that count findings of the structural comparison.
bool isStructural(Measure measure);

/// One line of the rubric. A measure from `tolerance` down costs nothing, from `limit` up all.
struct Criterion {
    Measure measure = Measure::difference;
    double weight = 1.0;                  ///< 0..1000; shares of the points
    double tolerance = 0.0, limit = 1.0;  ///< 0..1, tolerance < limit; of measured ones
    double perFinding = 0.5;              ///< share lost by each finding; of structural ones
};

/// A camera to look at both scenes with.
struct View {
    std::string name;
    enum class Kind { own, reference, orbit } kind = Kind::own;
    double azimuthDeg = 0.0, elevationDeg = 0.0;  ///< orbit: turned about the reference's target
    double distance = 1.0;                        ///< orbit: times the reference's
};

/// How submissions are judged (api/rubric.schema.json).
struct Rubric {
    std::string title = "Rubric";
    double points = 100.0;    ///< of a perfect submission
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
    std::vector<Criterion> criteria;
    double perWarning = 0.0;               ///< points
    std::map<std::string, double> byCode;  ///< points for each diagnostic of that code
    double mostPenalty = 10.0;             ///< points
};

/// What is used where no rubric is given.
Rubric defaultRubric();

/// Reads a rubric; what it leaves out is the default's. Throws Error rubric.json, rubric.key,
/// rubric.type, rubric.range, each with the path of the value: "criteria[2].weight".
Rubric readRubric(const std::string& json, const std::string& name);

/// The rubric as readRubric takes it, every key written.
std::string writeRubric(const Rubric& rubric);

}  // namespace farol::grade
