#include "grade/rubric/rubric.h"

#include <algorithm>
#include <cmath>

#include "grade/requirements/requirement_form.h"
#include "grade/rubric/json_place.h"
#include "grade/rubric/rubric_form.h"

namespace farol::grade {
namespace {

/// "flip, ssim and depth".
std::string listed(const std::vector<std::string_view>& names) {
    const std::vector<std::string_view> first(names.begin(), names.end() - 1);
    return joined(first, ", ") + " and " + std::string(names.back());
}

std::vector<std::string_view> metricNames(bool (*isListed)(const MetricSpec&)) {
    std::vector<std::string_view> names;
    for (const MetricSpec& metric : metrics())
        if (isListed(metric)) names.push_back(metric.name);
    return names;
}

Criterion usualOf(const MetricSpec& metric) {
    Criterion criterion{&metric, metric.weight};
    if (const ImageMetric* image = metric.image()) {
        criterion.tolerance = image->tolerance;
        criterion.limit = image->limit;
    } else {
        criterion.perFinding = metric.causes()->perFinding;
    }
    return criterion;
}

template <typename Form>
void describePicture(Form& form, Rubric& rubric) {
    form.integer("width", rubric.width, 16, render::kMaxSide);
    form.integer("height", rubric.height, 16, render::kMaxSide);
    form.samples("samples", rubric.samples, 16, "Antialiasing, for both sides.");
    form.word("shading", rubric.shading, scene::kShadingWords, "null: each scene's own.");
    form.word("filter", rubric.filter, scene::kFilterWords, "Of textures; null: each scene's own.");
    form.flag("axes", rubric.axes);
    form.flag("crop", rubric.cropAuto, "Cut window frames and title bars off screenshots.");
    form.flag("maskAxes", rubric.maskAxes,
              "Where images are compared, coordinate axes do not count.");
    form.list("masks", rubric.masks, Rectangle{0, 0, 1, 1}, 0, 32,
              "Parts that do not count, px from the top left.",
              [](Form& each, Rectangle& mask, std::size_t) {
                  each.integer("x", mask.x, 0, render::kMaxSide);
                  each.integer("y", mask.y, 0, render::kMaxSide);
                  each.integer("width", mask.width, 1, render::kMaxSide);
                  each.integer("height", mask.height, 1, render::kMaxSide);
              });
}

template <typename Form>
void describeView(Form& form, View& view, std::size_t at) {
    form.text("name", view.name);
    if (Form::kReads && view.name.empty()) view.name = "view " + std::to_string(at + 1);
    form.word("camera", view.kind, kViewWords,
              "own: each scene's own; reference: the reference's for both; orbit: the "
              "reference's, turned about its target.");
    if (Form::kWrites && view.kind != View::Kind::orbit) return;
    form.number("azimuth", view.azimuthDeg, -360, 360, "Degrees about the reference's up.");
    form.number("elevation", view.elevationDeg, -180, 180,
                "Degrees upwards; the camera never goes over the top.");
    form.number("distance", view.distance, 0.01, 100,
                "Times the reference's distance from its target.");
}

template <typename Form>
void describeCriterion(Form& form, Criterion& criterion) {
    const std::vector<std::string_view> images =
        metricNames([](const MetricSpec& one) { return one.image() != nullptr; });
    const std::vector<std::string_view> counted =
        metricNames([](const MetricSpec& one) { return one.causes() != nullptr; });
    const std::size_t known = static_cast<std::size_t>(criterion.metric - metrics().data());
    const std::size_t at =
        form.requiredWord("measure", known, metricNames([](const MetricSpec&) { return true; }));
    const MetricSpec& metric = metrics()[at];
    if (Form::kReads) criterion = usualOf(metric);
    form.number("weight", criterion.weight, 0, 1000);
    const bool isSchema = !Form::kReads && !Form::kWrites;
    if (metric.image() != nullptr || isSchema) {
        const std::string about =
            "Up to this the measure costs nothing. Of " + listed(images) + ".";
        form.number("tolerance", criterion.tolerance, 0, 1, about.c_str());
        form.number("limit", criterion.limit, 0, 1,
                    "From this on it costs all of the criterion. Above tolerance.");
        form.template require<"rubric.range/tolerance">(criterion.tolerance < criterion.limit,
                                                        "tolerance");
    }
    if (metric.causes() != nullptr || isSchema) {
        const std::string about =
            "How much causes cost: 0.5 as the table of kinds says, 1 twice as much. Of " +
            listed(counted) + ".";
        form.number("perFinding", criterion.perFinding, 0, 1, about.c_str());
    }
}

/// Refuses an id that an earlier criterion has: the first `requirements` and `manual` of them.
template <typename Form>
void requireOwnName(const Form& form, const Rubric& rubric, const std::string& id,
                    std::size_t requirements, std::size_t manual) {
    bool isTaken = std::any_of(metrics().begin(), metrics().end(),
                               [&](const MetricSpec& metric) { return metric.name == id; });
    for (std::size_t i = 0; i < requirements; ++i)
        isTaken = isTaken || rubric.requirements[i].id == id;
    for (std::size_t i = 0; i < manual; ++i) isTaken = isTaken || rubric.manual[i].id == id;
    form.template require<"rubric.range/twice">(!isTaken, "id");
}

/// Each key of a rubric with its type and range, in the order of documents.
template <typename Form>
void describe(Form& form, Rubric& rubric) {
    form.comment("$schema");  // editors find the schema by it
    form.text("title", rubric.title);
    form.number("points", rubric.points, 0.01, 10'000, "Of a perfect submission.");
    form.number("weight", rubric.weight, 0, 1000, "Of the task among those of a class.");
    form.number("passMark", rubric.passMark, 0, 100, "Per cent of the points.");
    form.number("strictness", rubric.strictness, 0.1, 10, "Times every loss.");
    form.object("picture", [&](Form& picture) { describePicture(picture, rubric); });
    form.flag("lend", rubric.lend,
              "Images and models that a submission names and lacks are read from the "
              "reference's files, with a note grade.lent; documents and .3d meshes never are.");
    form.flag("images", rubric.takesImages,
              "Grade an image that was handed in for a scene, by the image measures; false: it has "
              "no mark, and its similarity is shown.");
    form.word("reveal", rubric.reveal, kRevealWords,
              "words: findings tell kinds and directions; values: the reference's numbers too.");
    form.numbers("times", rubric.timesS, 1, 8, -1e6, 1e6,
                 "Seconds; null: 0, and a later moment where the reference moves.");
    form.list("views", rubric.views, View{"", View::Kind::orbit}, 1, 16,
              "The cameras; each is used at each time.", describeView<Form>);
    KnownIds known;
    form.list("define", rubric.definitions, Definition{}, 0, kMaxRequirements,
              "Objects that later selectors name by their id.",
              [&](Form& each, Definition& definition, std::size_t) {
                  describeDefinition(each, definition, known);
              });
    form.list("requirements", rubric.requirements, Requirement{}, 0, kMaxRequirements,
              "What is asked of a scene, with or without a reference.",
              [&](Form& each, Requirement& requirement, std::size_t at) {
                  describeRequirement(each, requirement, known);
                  requireOwnName(each, rubric, requirement.id, at, 0);
              });
    form.list("manual", rubric.manual, ManualCriterion{}, 0, 16,
              "Parts that a person marks, in overrides.csv.",
              [&](Form& each, ManualCriterion& manual, std::size_t at) {
                  describeManual(each, manual);
                  requireOwnName(each, rubric, manual.id, rubric.requirements.size(), at);
              });
    form.list("criteria", rubric.criteria, usualOf(metrics().front()), 1, metrics().size(),
              "Each measure once; weights are shares of the points.",
              [&](Form& each, Criterion& criterion, std::size_t at) {
                  describeCriterion(each, criterion);
                  for (std::size_t i = 0; i < at; ++i)
                      each.template require<"rubric.range/twice">(
                          rubric.criteria[i].metric != criterion.metric, "measure");
              });
    form.object("penalties", [&](Form& penalties) {
        penalties.number("warning", rubric.perWarning, 0, 10'000, "Points for each warning.");
        penalties.number("most", rubric.mostPenalty, 0, 10'000,
                         "Points that all together may cost.");
        penalties.numbersByKey(
            "codes", rubric.byCode, 0, 10'000,
            "Points for each diagnostic of a code, in place of warning's, or for "
            "each finding of a code, beside what it costs.");
    });
}

Rubric readDocument(const json& document, const std::string& name) {
    Rubric rubric = defaultRubric();
    rubric.title = "Rubric";
    RubricReader reader(document, "", name);
    describe(reader, rubric);
    reader.end();
    double weights = 0.0;
    for (const Criterion& one : rubric.criteria) weights += one.weight;
    reader.require<"rubric.range/weights">(weights > 0.0, "criteria");
    const auto isThere = [&](const char* key) {
        return document.contains(key) && !document[key].is_null();
    };
    const double sum = requiredPoints(rubric);
    if (sum > 0.0 && !isThere("points") && !isThere("criteria")) rubric.points = sum;
    reader.require<"rubric.range/points">(comparedPoints(rubric) >= 0.0, "points",
                                          "points"_arg = shortNumber(rubric.points),
                                          "sum"_arg = shortNumber(sum));
    return rubric;
}

}  // namespace

double requiredPoints(const Rubric& rubric) {
    double sum = 0.0;
    for (const Requirement& one : rubric.requirements) sum += one.points;
    for (const ManualCriterion& one : rubric.manual) sum += one.points;
    return sum;
}

double comparedPoints(const Rubric& rubric) {
    const double left = rubric.points - requiredPoints(rubric);
    return std::abs(left) < 1e-6 ? 0.0 : left;
}

bool needsScene(const Rubric& rubric) {
    return comparedPoints(rubric) > 0.0 ||
           std::any_of(rubric.requirements.begin(), rubric.requirements.end(),
                       [](const Requirement& one) { return !one.mesh; });
}

Rubric defaultRubric() {
    Rubric rubric;
    rubric.title = "Default rubric";
    rubric.views = {{"own camera", View::Kind::own, 0, 0, 1},
                    {"from the side", View::Kind::orbit, 50, 5, 1},
                    {"from above", View::Kind::orbit, -30, 30, 1}};
    for (const MetricSpec& metric : metrics())
        if (metric.isInDefault) rubric.criteria.push_back(usualOf(metric));
    return rubric;
}

Rubric readRubric(const std::string& text, const std::string& name) {
    json document;
    try {
        document = parseJson(text, kRubricJson);
    } catch (const JsonError& error) {
        throw Error(message<"rubric.json">("reason"_arg = std::string(error.what())), {name, 0, 0});
    }
    try {
        return readDocument(document, name);
    } catch (const Error& error) {
        Diagnostic fault = error.primary();
        fault.where = placeIn(text, fault.field);
        fault.where.file = name;
        throw Error(Diagnostics{std::move(fault)});
    }
}

std::string writeRubric(const Rubric& rubric) {
    RubricWriter writer;
    Rubric copy = rubric;  // describe() takes a mutable rubric
    describe(writer, copy);
    return dumpJson(writer.out, 2) + "\n";
}

std::string rubricSchema() {
    RubricSchema schema;
    Rubric rubric = defaultRubric();
    describe(schema, rubric);
    ordered_json out{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                     {"title", "Rubric of farol grade"},
                     {"description",
                      "What is left out is the default's: farol grade "
                      "--print-rubric."}};
    out.update(schema.rule());
    return out.dump(2) + "\n";
}

}  // namespace farol::grade
