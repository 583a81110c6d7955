// Requirements without a reference: the example rubric on scenes that meet it, and that do not.
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/error.h"
#include "grade/requirements/evaluate.h"
#include "grade/requirements/select.h"
#include "grade/rubric/grader.h"
#include "tests/support/paths.h"
#include "tests/unit/grade/solar_scenes.h"

using namespace farol;

namespace {

grade::Rubric example() {
    const std::string path = std::string(test::kSourceDir) + "/api/examples/solar.json";
    std::ifstream in(path);
    std::stringstream text;
    text << in.rdbuf();
    return grade::readRubric(text.str(), "solar.json");
}

render::Renderer& renderer() {
    static render::Renderer shared;
    return shared;
}

grade::Grade gradeOf(const grade::Subject& subject, const grade::Rubric& rubric) {
    grade::Grader grader(renderer());
    return grader.grade(grade::Subject{}, subject, rubric);
}

/// "planets not met: ...; moon ..." of all that is not met.
std::string unmetOf(const grade::Grade& grade) {
    std::string out;
    for (const grade::RequirementGrade& one : grade.requirements) {
        if (one.met == grade::Met::yes) continue;
        out += one.id + " " + std::string(grade::kMetWords[one.met]) + ": " + one.reason.text;
        for (const grade::RequiredThing& miss : one.misses)
            out += "; line " + std::to_string(miss.where.line) + " " + miss.who.text + " " +
                   miss.reason.text;
        out += "\n";
    }
    return out;
}

std::string box(const std::string& more) {
    return "<world><camera><position x=\"4\" y=\"3\" z=\"5\"/><lookAt x=\"0\" y=\"0\" "
           "z=\"0\"/></camera><lights><light type=\"directional\" dirx=\"1\" diry=\"2\" "
           "dirz=\"3\"/></lights>" +
           more + "</world>";
}

grade::Subject subjectOf(const std::string& xml, scene::BundleAssets::Files files = {}) {
    grade::Subject subject;
    subject.job.name = "scene.xml";
    subject.job.xml = xml;
    subject.job.assets = std::make_shared<scene::BundleAssets>(std::move(files));
    subject.job.options.missing = render::Missing::placeholder;
    return subject;
}

grade::Rubric rubricOf(const std::string& requirements) {
    return grade::readRubric("{\"requirements\": " + requirements + "}", "r.json");
}

std::string faultOf(const std::string& text) {
    try {
        grade::readRubric(text, "r.json");
        return "";
    } catch (const Error& error) {
        const Diagnostic& fault = error.primary();
        return std::to_string(fault.where.line) + ":" + std::to_string(fault.where.column) + " " +
               fault.field + " " + fault.message;
    }
}

}  // namespace

TEST_CASE("the example of a solar system meets all requirements") {
    const grade::Rubric rubric = example();
    CHECK(grade::comparedPoints(rubric) == 0.0);
    const grade::Grade grade = gradeOf(test::solarScene().subject(), rubric);
    REQUIRE_FALSE(grade.notGraded);
    CHECK(unmetOf(grade) == "");
    CHECK(grade.points == 20.0);  // and 5 by hand
    CHECK(grade.most == 25.0);
    const auto& planets = grade.requirements.at(1);
    REQUIRE(planets.matches.size() == 8);
    CHECK(planets.matches.front().where.line == 21);
    CHECK(planets.matches.front().excerpt.find("21 > <model") != std::string::npos);
}

TEST_CASE("the scene of the repository meets the example rubric") {
    const std::string folder = std::string(test::kSourceDir) + "/scenes/solar-system";
    std::ifstream in(folder + "/scene.xml");
    std::stringstream text;
    text << in.rdbuf();
    grade::Subject subject;
    subject.job.xml = text.str();
    subject.job.assets = std::make_shared<scene::FolderAssets>(folder);
    CHECK(unmetOf(gradeOf(subject, example())) == "");
}

TEST_CASE("each requirement that is missing is the only one that is not met, with its line") {
    const grade::Rubric rubric = example();
    const std::vector<test::SolarScene> scenes = test::solarMisses();
    CHECK(scenes.size() == rubric.requirements.size());
    for (const test::SolarScene& scene : scenes) {
        INFO(scene.name);
        const grade::Grade grade = gradeOf(scene.subject(), rubric);
        INFO(unmetOf(grade));
        std::string matches;
        for (const grade::RequirementGrade& one : grade.requirements)
            for (const grade::RequiredThing& match : one.matches)
                if (one.id == scene.unmet) matches += match.who.text + "\n";
        INFO(matches);
        for (const grade::RequirementGrade& one : grade.requirements)
            CHECK((one.met != grade::Met::yes) == (one.id == scene.unmet));
        for (const grade::RequirementGrade& one : grade.requirements) {
            if (one.id != scene.unmet) continue;
            CHECK(one.points < one.most);
            std::vector<int> lines;
            for (const grade::RequiredThing& miss : one.misses) lines.push_back(miss.where.line);
            CHECK(std::find(lines.begin(), lines.end(), scene.line) != lines.end());
        }
    }
}

TEST_CASE("scenes that meet the requirements by other means have all points") {
    const grade::Rubric rubric = example();
    const std::vector<test::SolarScene> scenes = test::otherSolarScenes();
    CHECK(scenes.size() == 10);
    for (const test::SolarScene& scene : scenes) {
        INFO(scene.name);
        const grade::Grade grade = gradeOf(scene.subject(), rubric);
        std::string errors;
        for (const Diagnostic& one : grade.diagnostics)
            if (one.severity != Severity::info)
                errors += std::to_string(one.where.line) + " " + one.message + "\n";
        INFO(errors);
        REQUIRE_FALSE(grade.notGraded);
        CHECK(unmetOf(grade) == "");
    }
}

TEST_CASE("counts give points by their share, and too many cost") {
    const std::string boxes =
        box("<group><models><model file=\"box_1_1.3d\"/></models></group>"
            "<group><transform><translate x=\"2\" y=\"0\" z=\"0\"/></transform><models>"
            "<model file=\"box_1_1.3d\"/></models></group>");
    const auto points = [&](const std::string& more) {
        const grade::Grade grade = gradeOf(
            subjectOf(boxes),
            rubricOf("[{\"id\": \"a\", \"text\": \"boxes\", \"points\": 6, \"select\": {\"shape\": "
                     "[\"box\"]}" +
                     more + "}]"));
        return grade.points;
    };
    CHECK(points(", \"count\": 2") == 6.0);
    CHECK(points(", \"count\": 3") == 4.0);
    CHECK(points(", \"count\": 3, \"partial\": false") == 0.0);
    CHECK(points(", \"count\": 1, \"atMost\": 1") == 3.0);
    CHECK(points(", \"count\": 1, \"distinct\": \"meshes\"") == 6.0);
    CHECK(points(", \"count\": 2, \"distinct\": \"meshes\"") == 3.0);
}

TEST_CASE("what an image without light, texture or normals shows decides whether it matters") {
    const auto met = [](const std::string& model, const std::string& effect) {
        return gradeOf(subjectOf(box("<group><models>" + model + "</models></group>")),
                       rubricOf("[{\"id\": \"a\", \"text\": \"t\", \"select\": {\"matters\": [\"" +
                                effect + "\"]}}]"))
                   .points == 1.0;
    };
    const std::string plain = "<model file=\"sphere_1_16_12.3d\"/>";
    const std::string glowing =
        "<model file=\"sphere_1_16_12.3d\"><color><diffuse R=\"0\" G=\"0\" B=\"0\"/><ambient "
        "R=\"0\" "
        "G=\"0\" B=\"0\"/><emissive R=\"200\" G=\"0\" B=\"0\"/></color></model>";
    CHECK(met(plain, "light"));
    CHECK(met(plain, "normals"));
    CHECK_FALSE(met(plain, "texture"));
    CHECK_FALSE(met(glowing, "light"));
    CHECK_FALSE(met(glowing, "normals"));
    CHECK(met("<model file=\"sphere_1_16_12.3d\" texture=\"chess:4x4\"/>", "texture"));
}

TEST_CASE("an object inside another solid is buried; one under a sky is not") {
    const std::string rule =
        "[{\"id\": \"a\", \"text\": \"t\", \"count\": 9, \"select\": {\"buried\": true}}]";
    const auto count = [&](const std::string& models) {
        return gradeOf(subjectOf(box(models)), rubricOf(rule)).requirements.at(0).found;
    };
    const std::string inner = "<group><models><model file=\"box_1_1.3d\"/></models></group>";
    CHECK(count(inner) == 0);
    CHECK(count(inner + "<group><models><model file=\"sphere_2_12_12.3d\"/></models></group>") ==
          1);
    // It looks out of the front.
    CHECK(
        count("<group><transform><translate x=\"1.8\" y=\"0\" z=\"0\"/></transform><models><model "
              "file=\"box_1_1.3d\"/></models></group><group><models><model "
              "file=\"sphere_2_12_12.3d\"/></models></group>") == 0);
    CHECK(count(inner + "<group><models><model file=\"sphere_50_12_12.3d\"/></models></group>") ==
          0);
}

TEST_CASE("mesh files are checked against a shape, with the vertex's line") {
    const grade::Rubric rubric = rubricOf(
        "[{\"id\": \"a\", \"text\": \"t\", \"points\": 4, \"count\": 1, \"mesh\": {\"file\": "
        "\"box*.3d\", \"shape\": \"box 2 1\"}}]");
    const test::SolarScene own = test::otherSolarScenes().at(2);
    const std::string sphere = own.files.at("bola.3d");
    const grade::Grade wrong = gradeOf(subjectOf("", {{"box.3d", sphere}}), rubric);
    REQUIRE_FALSE(wrong.notGraded);
    CHECK(wrong.points == 0.0);
    REQUIRE_FALSE(wrong.requirements.at(0).misses.empty());
    CHECK(wrong.requirements.at(0).misses.front().reason.text.find("other divisions") !=
          std::string::npos);
}

TEST_CASE("a wrong rubric of requirements is refused with place and fix") {
    const std::string head = "{\n  \"requirements\": [\n    {\"id\": \"a\", \"text\": \"t\",\n";
    CHECK(faultOf(head + "     \"cout\": 3, \"select\": {}}]}").find("4:6 /requirements/0/cout") ==
          0);
    CHECK(faultOf(head + "     \"cout\": 3, \"select\": {}}]}").find("did you mean \"count\"?") !=
          std::string::npos);
    CHECK(faultOf(head + "     \"select\": {\"shape\": [\"spere\"]}}]}")
              .find("/requirements/0/select/shape/0 ") != std::string::npos);
    CHECK(faultOf(head + "     \"select\": {\"shape\": [\"spere\"]}}]}")
              .find("did you mean \"sphere\"?") != std::string::npos);
    CHECK(faultOf(head + "     \"select\": {\"below\": \"planet\"}}]}")
              .find("/requirements/0/select/below ") != std::string::npos);
    CHECK(faultOf(head + "     \"points\": 1}]}").find("exactly one of") != std::string::npos);
    CHECK(faultOf(head + "     \"mesh\": {\"shape\": \"spere 1\"}}]}")
              .find("/requirements/0/mesh/shape ") != std::string::npos);
    CHECK(faultOf(head + "     \"select\": {}, \"order\": {\"by\": \"orbit\"}}]}")
              .find("add \"turnsAbout\"") != std::string::npos);
    CHECK(faultOf(head + "     \"points\": 9, \"select\": {}}], \"points\": 5}")
              .find("add up to 9") != std::string::npos);
    CHECK(faultOf(head + "     \"select\": {}}, {\"id\": \"a\", \"text\": \"t\", \"select\": {}}]}")
              .find("is duplicated") != std::string::npos);
    CHECK(faultOf(head + "     \"select\": {}}]}") == "");
}

TEST_CASE("requirements and a reference share the points") {
    const std::string xml = box("<group><models><model file=\"box_1_1.3d\"/></models></group>");
    const grade::Rubric rubric = grade::readRubric(
        "{\"points\": 20, \"requirements\": [{\"id\": \"a\", \"text\": \"t\", \"points\": 6, "
        "\"select\": {\"shape\": [\"box\"]}}, {\"id\": \"b\", \"text\": \"t\", \"points\": 4, "
        "\"select\": {\"shape\": [\"cone\"]}}], \"penalties\": {\"codes\": {\"transform.missing\": "
        "2}}}",
        "r.json");
    CHECK(grade::comparedPoints(rubric) == 10.0);
    grade::Grader grader(renderer());
    const grade::Grade same = grader.grade(subjectOf(xml), subjectOf(xml), rubric);
    CHECK(same.points == 16.0);
    // A penalty by the code of a finding, beside what the cause costs.
    const std::string moved =
        box("<group><transform><translate x=\"1\" y=\"0\" z=\"0\"/></transform><models><model "
            "file=\"box_1_1.3d\"/></models></group>");
    const grade::Grade other = grader.grade(subjectOf(moved), subjectOf(xml), rubric);
    REQUIRE(other.causes.size() == 1);
    CHECK(other.causes.front().code == "transform.missing");
    CHECK(other.penalty == 2.0);
    CHECK(other.points < 14.0);
}

TEST_CASE("patterns of names") {
    CHECK(grade::isLike("Comet tail", "comet*"));
    CHECK(grade::isLike("a.3d", "?.3D"));
    CHECK(grade::isLike("abcbd", "a*bd"));
    CHECK_FALSE(grade::isLike("comet", "comet?"));
    CHECK_FALSE(grade::isLike("", "*"));
}
