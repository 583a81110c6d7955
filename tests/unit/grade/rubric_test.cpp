#include "grade/rubric/rubric.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "tests/support/paths.h"

namespace {

using farol::Error;
using farol::grade::readRubric;
using farol::grade::Rubric;
using nlohmann::json;

json schema() {
    std::ifstream in(std::string(farol::test::kSourceDir) + "/api/rubric.schema.json");
    return json::parse(in);
}

std::string codeOf(const json& rubric) {
    try {
        readRubric(rubric.dump(), "r.json");
        return "";
    } catch (const Error& error) {
        return error.code() + " " + error.primary().field;
    }
}

/// A document whose only content is `value` at a path of keys and places.
json at(std::vector<std::string> path, const json& value) {
    json out = value;
    while (!path.empty()) {
        out = path.back() == "[]" ? json::array({out}) : json{{path.back(), out}};
        path.pop_back();
    }
    return out;
}

/// Calls `each` with the path and the schema of every number.
template <typename Each>
void numbers(const json& schema, std::vector<std::string> path, const Each& each) {
    const json type = schema.value("type", json());
    const auto is = [&](const char* name) {
        return type == name ||
               (type.is_array() && std::find(type.begin(), type.end(), name) != type.end());
    };
    if (is("number") || is("integer")) each(path, schema);
    const json properties = schema.value("properties", json::object());
    for (const auto& [name, inner] : properties.items()) {
        auto longer = path;
        longer.push_back(name);
        numbers(inner, longer, each);
    }
    if (schema.contains("items")) {
        path.emplace_back("[]");
        numbers(schema["items"], path, each);
    }
}

/// The other keys that an object needs.
void complete(json& rubric, const std::vector<std::string>& path) {
    if (path[0] == "define") rubric["define"][0]["id"] = "a";
    if (path[0] == "manual") rubric["manual"][0].update({{"id", "a"}, {"text", "t"}});
    if (path[0] == "requirements") {
        json& one = rubric["requirements"][0];
        one.update({{"id", "a"}, {"text", "t"}});
        if (!one.contains("select") && !one.contains("light") && !one.contains("mesh"))
            one["select"] = json::object();
    }
    // The sum of a rubric's points stays within them.
    if (path[0] == "requirements" || path[0] == "manual") rubric["points"] = 10'000;
    // An interval's end must not pass the other one.
    if (path.back() == "least" || path.back() == "most") {
        json* at = &rubric;
        for (std::size_t i = 0; i + 1 < path.size(); ++i)
            at = path[i] == "[]" ? &(*at)[0] : &(*at)[path[i]];
        if (path[0] != "penalties") {
            const bool isDepth = path[path.size() - 2] == "depth";
            const bool isShine = path[path.size() - 2] == "shininess";
            if (path.back() == "least") (*at)["most"] = isDepth ? 256 : isShine ? 128 : 1;
            if (path.back() == "most") (*at)["least"] = 0;
        }
    }
    if (path[0] != "criteria") return;
    const bool finding = path.back() == "perFinding";
    rubric["criteria"][0]["measure"] = finding ? "lights" : "difference";
    if (path.back() == "tolerance") rubric["criteria"][0]["limit"] = 1.0;
    if (path.back() == "limit") rubric["criteria"][0]["tolerance"] = 0.0;
    rubric["criteria"].push_back({{"measure", "camera"}, {"weight", 1}});
}

}  // namespace

TEST_CASE("the default rubric reads back as it is, and shares a hundred points") {
    const Rubric usual = farol::grade::defaultRubric();
    const std::string text = farol::grade::writeRubric(usual);
    Rubric again = readRubric(text, "r.json");
    CHECK(farol::grade::writeRubric(again) == text);
    double weights = 0.0;
    for (const auto& one : usual.criteria) weights += one.weight;
    CHECK(weights == 100.0);
    CHECK(codeOf(json::object()).empty());
}

TEST_CASE("the schema's ranges are those of the reader") {
    int tried = 0;
    numbers(schema(), {}, [&](const std::vector<std::string>& path, const json& rule) {
        if (!rule.contains("minimum") || !rule.contains("maximum")) return;
        const double least = rule["minimum"], most = rule["maximum"];
        const bool whole = rule["type"] != "number";
        const auto tryValue = [&](double value) {
            json rubric = at(path, whole ? json(static_cast<long>(value)) : json(value));
            complete(rubric, path);
            return codeOf(rubric);
        };
        std::string name;
        for (const std::string& part : path) name += part + " ";
        INFO(name);
        ++tried;
        // A tolerance must stay below its limit, a limit above its tolerance.
        CHECK(tryValue(path.back() == "limit" ? 0.01 : least).empty());
        CHECK(tryValue(path.back() == "tolerance" ? 0.99 : most).empty());
        CHECK_THAT(tryValue(least - 1), Catch::StartsWith("rubric.range"));
        CHECK_THAT(tryValue(most + 1), Catch::StartsWith("rubric.range"));
    });
    CHECK(tried >= 18);
}

TEST_CASE("faults of a rubric are named with their path") {
    struct Case {
        const char* json;
        const char* expected;
    };
    const Case one = GENERATE(values<Case>({
        {R"({"pionts": 5})", "rubric.key /pionts"},
        {R"({"picture": {"hight": 5}})", "rubric.key /picture/hight"},
        {R"({"points": "many"})", "rubric.type /points"},
        {R"({"picture": []})", "rubric.type /picture"},
        {R"({"picture": {"samples": 3}})", "rubric.range /picture/samples"},
        {R"({"picture": {"shading": "cel"}})", "rubric.range /picture/shading"},
        {R"({"views": []})", "rubric.range /views"},
        {R"({"views": [{"camera": "mine"}]})", "rubric.range /views/0/camera"},
        {R"({"criteria": [{"measure": "beauty"}]})", "rubric.range /criteria/0/measure"},
        {R"({"criteria": [{"measure": "flip"}, {"measure": "flip"}]})",
         "rubric.range /criteria/1/measure"},
        {R"({"criteria": [{"measure": "flip", "tolerance": 0.9, "limit": 0.2}]})",
         "rubric.range /criteria/0/tolerance"},
        {R"({"criteria": [{"measure": "lights", "limit": 0.2}]})", "rubric.key /criteria/0/limit"},
        {R"({"criteria": [{"measure": "flip", "weight": 0}]})", "rubric.range /criteria"},
        {R"({"penalties": {"codes": {"xml.quotes": -1}}})",
         "rubric.range /penalties/codes/xml.quotes"},
        {R"([1])", "rubric.type "},
    }));
    INFO(one.json);
    CHECK(codeOf(json::parse(one.json)) == one.expected);
    CHECK_THROWS_AS(readRubric("{", "r.json"), Error);
}

TEST_CASE("the schema knows every key of the default") {
    const json rules = schema()["properties"];
    const json written = json::parse(farol::grade::writeRubric(farol::grade::defaultRubric()));
    for (const auto& [key, value] : written.items()) CHECK(rules.contains(key));
    for (const auto& [key, value] : written["picture"].items())
        CHECK(rules["picture"]["properties"].contains(key));
}

TEST_CASE("a rubric is read within limits") {
    const auto codeOf = [](const std::string& text) {
        try {
            readRubric(text, "r.json");
            return std::string("done");
        } catch (const Error& error) {
            return error.code() + ": " + error.what();
        }
    };
    CHECK(codeOf("{}") == "done");
    CHECK(codeOf("{\"views\": " + std::string(100'000, '[')).rfind("rubric.json: ", 0) == 0);
    CHECK(codeOf("{\"views\": " + std::string(100'000, '[')).find("line 1, column ") !=
          std::string::npos);
    CHECK(codeOf(std::string((std::size_t{1} << 20U), ' ') + "{}").rfind("rubric.json: ", 0) == 0);
    CHECK(codeOf(R"({"points": 5, "points": 6})").rfind("rubric.json: ", 0) == 0);
    CHECK(codeOf(R"({"points": 1e999})").rfind("rubric.json: ", 0) == 0);
}
