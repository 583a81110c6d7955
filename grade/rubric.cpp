#include "grade/rubric.h"

#include <array>
#include <nlohmann/json.hpp>
#include <set>

#include "scene/error.h"
#include "scene/words.h"

namespace farol::grade {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::array<const char*, kMeasures> kMeasureNames{
    "difference", "flip",   "ssim",     "coverage",  "depth",  "normals",
    "transforms", "models", "textures", "materials", "lights", "camera"};
const std::vector<std::string> kShadings{"points", "wireframe", "solid", "chess",
                                         "flat",   "gouraud",   "phong"};
const std::vector<std::string> kFilters{"nearest", "linear", "mipmap", "anisotropic"};
const std::vector<std::string> kViewKinds{"own", "reference", "orbit"};

/// One object of the document. Every key that is asked for is known; `end` refuses the others.
class Reader {
  public:
    Reader(const json& value, std::string path, const std::string& file)
        : value_(value), path_(std::move(path)), file_(file) {
        if (!value.is_object()) fail("rubric.type", path_, "takes an object");
    }

    bool has(const std::string& key) {
        known_.insert(key);
        return value_.contains(key) && !value_.at(key).is_null();
    }
    void number(const std::string& key, double& out, double least, double most) {
        if (!has(key)) return;
        out = asNumber(value_.at(key), at(key), least, most);
    }
    void integer(const std::string& key, std::optional<int>& out, int least, int most) {
        if (!has(key)) return;
        if (!value_.at(key).is_number_integer()) fail("rubric.type", at(key), "takes an integer");
        out = static_cast<int>(asNumber(value_.at(key), at(key), least, most));
    }
    void text(const std::string& key, std::string& out) {
        if (!has(key)) return;
        if (!value_.at(key).is_string()) fail("rubric.type", at(key), "takes a string");
        out = value_.at(key).get<std::string>().substr(0, 200);
    }
    void flag(const std::string& key, bool& out) {
        if (!has(key)) return;
        if (!value_.at(key).is_boolean()) fail("rubric.type", at(key), "takes true or false");
        out = value_.at(key).get<bool>();
    }
    /// The place of the word among `words`.
    template <typename Enum>
    void word(const std::string& key, std::optional<Enum>& out,
              const std::vector<std::string>& words) {
        std::string given;
        text(key, given);
        if (!has(key)) return;
        std::string all;
        for (std::size_t i = 0; i < words.size(); ++i) {
            if (words[i] == given) {
                out = static_cast<Enum>(i);
                return;
            }
            all += (i == 0 ? "" : ", ") + words[i];
        }
        fail("rubric.range", at(key), "is " + scene::quoted(given) + "; takes one of " + all);
    }
    template <typename Each>
    void list(const std::string& key, std::size_t least, std::size_t most, Each each) {
        if (!has(key)) return;
        const json& all = value_.at(key);
        if (!all.is_array()) fail("rubric.type", at(key), "takes a list");
        if (all.size() < least || all.size() > most)
            fail("rubric.range", at(key),
                 "has " + std::to_string(all.size()) + " entries; takes " + std::to_string(least) +
                     " to " + std::to_string(most));
        for (std::size_t i = 0; i < all.size(); ++i)
            each(all[i], at(key) + "[" + std::to_string(i) + "]");
    }
    Reader object(const std::string& key) { return {value_.at(key), at(key), file_}; }
    double asNumber(const json& value, const std::string& path, double least, double most) const {
        if (!value.is_number()) fail("rubric.type", path, "takes a number");
        const double number = value.get<double>();
        if (!(number >= least && number <= most))
            fail("rubric.range", path,
                 "is " + value.dump() + "; takes " + json(least).dump() + " to " +
                     json(most).dump());
        return number;
    }
    void end() const {
        for (const auto& [key, value] : value_.items()) {
            if (known_.count(key) != 0) continue;
            std::string all;
            for (const std::string& one : known_) all += (all.empty() ? "" : ", ") + one;
            fail("rubric.key", path_.empty() ? key : path_ + "." + key,
                 "is not known here; known are " + all);
        }
    }
    [[noreturn]] void fail(const char* code, const std::string& path,
                           const std::string& what) const {
        throw Error(code, (path.empty() ? "the rubric" : scene::shown(path)) + " " + what,
                    {file_, 0, 0}, path);
    }
    const json& raw() const { return value_; }

  private:
    std::string at(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }

    const json& value_;
    std::string path_;
    const std::string& file_;
    std::set<std::string> known_;
};

void readPicture(Reader reader, Rubric& rubric) {
    reader.integer("width", rubric.width, 16, render::kMaxSide);
    reader.integer("height", rubric.height, 16, render::kMaxSide);
    std::optional<int> samples;
    reader.integer("samples", samples, 1, 16);
    if (samples && (*samples & (*samples - 1)) != 0)
        reader.fail("rubric.range", "picture.samples", "takes 1, 2, 4, 8 or 16");
    rubric.samples = samples.value_or(rubric.samples);
    reader.word("shading", rubric.shading, kShadings);
    reader.word("filter", rubric.filter, kFilters);
    reader.flag("axes", rubric.axes);
    reader.flag("crop", rubric.cropAuto);
    reader.flag("maskAxes", rubric.maskAxes);
    reader.list("masks", 0, 32, [&](const json& value, const std::string& path) {
        Reader one(value, path, "");
        std::optional<int> x, y, width, height;
        one.integer("x", x, 0, render::kMaxSide);
        one.integer("y", y, 0, render::kMaxSide);
        one.integer("width", width, 1, render::kMaxSide);
        one.integer("height", height, 1, render::kMaxSide);
        one.end();
        rubric.masks.push_back(
            {x.value_or(0), y.value_or(0), width.value_or(1), height.value_or(1)});
    });
    reader.end();
}

View readView(Reader reader) {
    View view;
    std::optional<View::Kind> kind;
    reader.text("name", view.name);
    reader.word("camera", kind, kViewKinds);
    reader.number("azimuth", view.azimuthDeg, -360, 360);
    reader.number("elevation", view.elevationDeg, -180, 180);
    reader.number("distance", view.distance, 0.01, 100);
    reader.end();
    view.kind = kind.value_or(View::Kind::orbit);
    return view;
}

Criterion readCriterion(Reader reader, const std::string& path) {
    Criterion one;
    std::optional<Measure> measure;
    reader.word("measure", measure, {kMeasureNames.begin(), kMeasureNames.end()});
    if (!measure) reader.fail("rubric.type", path, "lacks its measure");
    one.measure = *measure;
    for (const Criterion& usual : defaultRubric().criteria)
        if (usual.measure == *measure) one = usual;
    reader.number("weight", one.weight, 0, 1000);
    if (isStructural(one.measure)) {
        reader.number("perFinding", one.perFinding, 0, 1);
    } else {
        reader.number("tolerance", one.tolerance, 0, 1);
        reader.number("limit", one.limit, 0, 1);
        if (one.tolerance >= one.limit)
            reader.fail("rubric.range", path + ".tolerance", "is not below its limit");
    }
    reader.end();
    return one;
}

}  // namespace

const char* nameOf(Measure measure) { return kMeasureNames[static_cast<std::size_t>(measure)]; }
bool isStructural(Measure measure) { return measure >= Measure::transforms; }

Rubric defaultRubric() {
    Rubric rubric;
    rubric.title = "Default rubric";
    rubric.views = {{"own camera", View::Kind::own, 0, 0, 1},
                    {"from the side", View::Kind::orbit, 50, 5, 1},
                    {"from above", View::Kind::orbit, -30, 30, 1}};
    // The tolerances are what rounding, another tessellation order and a pixel's shift make in
    // docs/grading.md's table, and some more.
    rubric.criteria = {{Measure::difference, 35, 0.002, 0.25, 0},
                       {Measure::flip, 5, 0.05, 0.5, 0},
                       {Measure::coverage, 10, 0.02, 0.6, 0},
                       {Measure::depth, 5, 0.01, 0.5, 0},
                       {Measure::normals, 5, 0.01, 0.5, 0},
                       {Measure::transforms, 10, 0, 1, 0.5},
                       {Measure::models, 10, 0, 1, 0.5},
                       {Measure::textures, 5, 0, 1, 0.5},
                       {Measure::materials, 5, 0, 1, 0.5},
                       {Measure::lights, 5, 0, 1, 0.5},
                       {Measure::camera, 5, 0, 1, 0.5}};
    return rubric;
}

Rubric readRubric(const std::string& text, const std::string& name) {
    json document;
    try {
        document = json::parse(text);
    } catch (const json::exception& fault) {
        throw Error("rubric.json",
                    "the rubric is not JSON: " + scene::shown(std::string(fault.what())),
                    {name, 0, 0});
    }
    Rubric rubric = defaultRubric();
    rubric.title = "Rubric";
    Reader reader(document, "", name);
    if (reader.has("$schema")) std::string();  // editors find the schema by it
    reader.text("title", rubric.title);
    reader.number("points", rubric.points, 0.01, 10'000);
    reader.number("passMark", rubric.passMark, 0, 100);
    reader.number("strictness", rubric.strictness, 0.1, 10);
    if (reader.has("picture")) readPicture(reader.object("picture"), rubric);
    reader.list("times", 1, 8, [&](const json& value, const std::string& path) {
        rubric.timesS.push_back(reader.asNumber(value, path, -1e6, 1e6));
    });
    reader.flag("lend", rubric.lend);
    if (reader.has("views")) rubric.views.clear();
    reader.list("views", 1, 16, [&](const json& value, const std::string& path) {
        rubric.views.push_back(readView({value, path, name}));
        if (rubric.views.back().name.empty())
            rubric.views.back().name = "view " + std::to_string(rubric.views.size());
    });
    if (reader.has("criteria")) rubric.criteria.clear();
    reader.list("criteria", 1, kMeasures, [&](const json& value, const std::string& path) {
        rubric.criteria.push_back(readCriterion({value, path, name}, path));
        for (std::size_t i = 0; i + 1 < rubric.criteria.size(); ++i)
            if (rubric.criteria[i].measure == rubric.criteria.back().measure)
                reader.fail("rubric.range", path + ".measure", "is there twice");
    });
    if (reader.has("penalties")) {
        Reader penalties = reader.object("penalties");
        penalties.number("warning", rubric.perWarning, 0, 10'000);
        penalties.number("most", rubric.mostPenalty, 0, 10'000);
        if (penalties.has("codes")) {
            const Reader codes = penalties.object("codes");
            for (const auto& [code, points] : codes.raw().items())
                rubric.byCode[code.substr(0, 80)] =
                    codes.asNumber(points, "penalties.codes." + code, 0, 10'000);
        }
        penalties.end();
    }
    reader.end();
    double weights = 0.0;
    for (const Criterion& one : rubric.criteria) weights += one.weight;
    if (!(weights > 0.0)) reader.fail("rubric.range", "criteria", "weigh nothing");
    return rubric;
}

std::string writeRubric(const Rubric& rubric) {
    ordered_json picture{{"width", nullptr},          {"height", nullptr},
                         {"samples", rubric.samples}, {"shading", nullptr},
                         {"filter", nullptr},         {"axes", rubric.axes},
                         {"crop", rubric.cropAuto},   {"maskAxes", rubric.maskAxes}};
    if (rubric.width) picture["width"] = *rubric.width;
    if (rubric.height) picture["height"] = *rubric.height;
    if (rubric.shading) picture["shading"] = kShadings[static_cast<std::size_t>(*rubric.shading)];
    if (rubric.filter) picture["filter"] = kFilters[static_cast<std::size_t>(*rubric.filter)];
    picture["masks"] = ordered_json::array();
    for (const Rectangle& one : rubric.masks)
        picture["masks"].push_back(
            {{"x", one.x}, {"y", one.y}, {"width", one.width}, {"height", one.height}});
    ordered_json views = ordered_json::array(), criteria = ordered_json::array();
    for (const View& view : rubric.views) {
        ordered_json one{{"name", view.name},
                         {"camera", kViewKinds[static_cast<std::size_t>(view.kind)]}};
        if (view.kind == View::Kind::orbit) {
            one["azimuth"] = view.azimuthDeg;
            one["elevation"] = view.elevationDeg;
            one["distance"] = view.distance;
        }
        views.push_back(one);
    }
    for (const Criterion& rule : rubric.criteria) {
        ordered_json one{{"measure", nameOf(rule.measure)}, {"weight", rule.weight}};
        if (isStructural(rule.measure)) {
            one["perFinding"] = rule.perFinding;
        } else {
            one["tolerance"] = rule.tolerance;
            one["limit"] = rule.limit;
        }
        criteria.push_back(one);
    }
    ordered_json out{
        {"title", rubric.title},
        {"points", rubric.points},
        {"passMark", rubric.passMark},
        {"strictness", rubric.strictness},
        {"picture", picture},
        {"lend", rubric.lend},
        {"times", nullptr},
        {"views", views},
        {"criteria", criteria},
        {"penalties",
         {{"warning", rubric.perWarning}, {"most", rubric.mostPenalty}, {"codes", rubric.byCode}}}};
    if (!rubric.timesS.empty()) out["times"] = rubric.timesS;
    return out.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace farol::grade
