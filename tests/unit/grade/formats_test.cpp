#include "grade/formats/formats.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "core/base64.h"
#include "tests/support/paths.h"

// Each format is held to the fields that its platform's page requires
// (docs/reference/grading-formats.md) and to a stored specimen, which was read beside that page. No
// platform itself was tried.
using namespace farol::grade;
using nlohmann::json;

namespace {

/// A group's name that would forge a line of each text format.
constexpr const char* kForged = "door\nGrade :=>> 100\r\n::error::x\n--|>";

SubmissionResult graded() {
    SubmissionResult one{"ana", "Ana Alves", "17", 71.25, 100, true, {}};
    one.comments = {"well done"};
    TaskGrade grade;
    json document = json::parse(R"({"points":71.25,"most":100,"passed":true,"refused":false,
        "penalty":2.5,"unexplained":{"points":1.25,"share":0.01},
        "criteria":[{"measure":"models","points":40,"most":40,"reason":""},
                    {"measure":"transforms","points":35,"most":60,"reason":"35 of 60"}],
        "findings":[
          {"code":"transform.angle-sign","criterion":"transforms","points":25,"file":"scene.xml",
           "line":14,"column":9,"message":""},
          {"code":"light.color","criterion":"lights","points":0,"file":"scene.xml","line":3,
           "message":"100 % <other> colour, \"red\": none"}],
        "diagnostics":[{"code":"xml.repaired","severity":"warning","file":"scene.xml","line":5,
                        "message":"no end tag"}],
        "views":[{"name":"front","time":0,"width":4,"height":4}]})");
    document["findings"][0]["message"] = std::string("group \"") + kForged + "\": wrong sign";
    grade.json = document.dump();
    grade.pictures = {"", "heat"};
    TaskResult task{"", grade};
    task.document = "work/ana b/scene.xml";
    one.tasks.push_back(task);
    return one;
}

SubmissionResult failed() {
    SubmissionResult one{"rui", "", "", 0, 100, false, {}};
    one.graded = false;
    one.tasks.push_back({"", TaskFailure{"grade.no-scene", "it holds no scene"}});
    one.tasks.back().document = "work/rui/notes.txt";
    return one;
}

ClassResult classOf(const std::vector<SubmissionResult>& all) {
    ClassResult out;
    out.title = "Robot arm";
    out.count = all.size();
    out.at = [all](std::size_t i) { return all[i]; };
    out.tasks = {""};
    out.references = {{"reference"}};
    out.rubric = "{}";
    return out;
}

const FormatContext kContext{{{"CLASSROOM", "cg"},
                              {"ASSIGNMENT", "arm"},
                              {"SUBMISSION_TAG", "submit/1"},
                              {"COMMIT_URL", "https://example.org/commit/1"},
                              {"RELEASE_URL", "https://example.org/release/1"}},
                             "2026-11-30T10:00:00Z"};

std::string text(const Format& format, const SubmissionResult& one) {
    std::ostringstream out;
    if (format.ofOne != nullptr)
        format.ofOne(out, outcomeOf(classOf({one}), 0), kContext);
    else
        format.ofClass(out, classOf({one}));
    return out.str();
}

std::string text(const std::string& name, const SubmissionResult& one) {
    const Format* format = findFormat(name);
    REQUIRE(format != nullptr);
    return text(*format, one);
}

json parsed(const std::string& name, const SubmissionResult& one) {
    return json::parse(text(name, one));
}

std::vector<std::string> lines(const std::string& all) {
    std::vector<std::string> out;
    std::istringstream in(all);
    for (std::string line; std::getline(in, line);) out.push_back(line);
    return out;
}

}  // namespace

TEST_CASE("the table of formats is whole") {
    std::set<std::string_view> names;
    for (const Format& format : formats()) {
        INFO(format.name);
        CHECK(names.insert(format.name).second);
        CHECK((format.ofClass != nullptr) != (format.ofOne != nullptr));
        CHECK_FALSE(format.file.empty());
        CHECK_FALSE(format.summary.empty());
        if (format.source.empty()) continue;
        CHECK(format.source.starts_with("https://"));
        CHECK_FALSE(format.required.empty());
        CHECK_FALSE(format.sourceDate.empty());
    }
    CHECK(findFormat("gradescope") != nullptr);
    CHECK(findFormat("Gradescope") == nullptr);
}

TEST_CASE("each format of a platform is the stored specimen") {
    const std::filesystem::path folder =
        std::filesystem::path(farol::test::kSourceDir) / "tests/unit/grade/specimens";
    for (const Format& format : formats()) {
        if (format.ofOne == nullptr && format.name != "sarif" && format.name != "github") continue;
        for (const SubmissionResult& one : {graded(), failed()}) {
            const std::filesystem::path path =
                folder / (std::string(format.name) + "-" + one.id + ".txt");
            INFO(path.string());
            if (std::getenv("FAROL_UPDATE_GOLDENS") != nullptr)
                std::ofstream(path, std::ios::binary) << text(format, one);
            std::ifstream in(path, std::ios::binary);
            std::ostringstream stored;
            stored << in.rdbuf();
            CHECK(text(format, one) == stored.str());
        }
    }
}

TEST_CASE("Gradescope: a score, tests with their fields, escaped HTML with images") {
    const json result = parsed("gradescope", graded());
    CHECK(result.at("score") == 71.25);
    REQUIRE(result.at("tests").size() == 3);
    for (const json& test : result["tests"]) {
        CHECK(test.at("name").is_string());
        CHECK(test.at("number").is_string());
        CHECK(test.at("output_format") == "html");
        CHECK((test.at("status") == "passed" || test.at("status") == "failed"));
        CHECK(test.at("visibility") == "visible");
    }
    CHECK(result["tests"][0]["status"] == "passed");
    CHECK(result["tests"][1]["status"] == "failed");
    CHECK(result["tests"][1]["score"] == 35);
    CHECK(result["tests"][1]["max_score"] == 60);
    CHECK(result["tests"][1]["tags"] == json::array({"transform.angle-sign"}));
    const std::string document = result["tests"][2]["output"];
    CHECK_THAT(document, Catch::Contains("&lt;other&gt; colour"));
    CHECK_THAT(document, Catch::Contains("data:image/jpeg;base64," + farol::base64("heat")));
    // The render equals the reference's, and is shown as the submission's.
    CHECK_THAT(document, Catch::Contains("data:image/jpeg;base64," + farol::base64("reference")));
    CHECK_THAT(document, Catch::Contains("alt=\"submission, view 1 (front)\""));
    CHECK(parsed("gradescope", failed()).at("score") == 0);
}

TEST_CASE("no format shows the reference's render where the submission has its own") {
    SubmissionResult other = graded();
    TaskGrade grade = *other.tasks[0].grade();
    grade.pictures = {"own", "heat"};
    other.tasks[0].result = grade;
    for (const Format& format : formats())
        if (format.ofOne != nullptr)
            CHECK_THAT(text(format, other), !Catch::Contains(farol::base64("reference")));
}

TEST_CASE("PrairieLearn: score 0 to 1, and at most 1 MB whatever the images and texts") {
    const json result = parsed("prairielearn", graded());
    CHECK(result.at("gradable") == true);
    CHECK(result.at("score") == 0.7125);
    CHECK(result.at("images").size() == 2);
    CHECK(result["images"][1]["url"] == "data:image/jpeg;base64," + farol::base64("heat"));
    CHECK(result["tests"][1].at("points") == 35);
    CHECK(result["tests"][1].at("max_points") == 60);
    const json none = parsed("prairielearn", failed());
    CHECK(none.at("gradable") == false);
    CHECK_FALSE(none.contains("score"));
    CHECK(none.at("format_errors") == json::array({"it holds no scene"}));

    SubmissionResult large = graded();
    TaskGrade grade = *large.tasks[0].grade();
    grade.pictures.assign(12, std::string(200'000, 'x'));
    large.tasks[0].result = grade;
    std::string bytes = text("prairielearn", large);
    CHECK(bytes.size() <= 1'000'000);
    CHECK(bytes.size() > 700'000);  // what fits is there
    CHECK(json::parse(bytes).at("images").size() == 3);
    CHECK_THAT(json::parse(bytes).at("message").get<std::string>(), Catch::Contains("9 images"));

    json document = json::parse(grade.json);
    for (int i = 0; i < 30'000; ++i)
        document["findings"].push_back({{"code", "light.color"},
                                        {"criterion", "transforms"},
                                        {"message", std::string(100, 'm')},
                                        {"points", 0}});
    grade.json = document.dump();
    large.tasks[0].result = grade;
    bytes = text("prairielearn", large);
    CHECK(bytes.size() <= 1'000'000);
    CHECK(json::parse(bytes).at("score") == 0.7125);
    CHECK(json::parse(bytes).at("tests").size() == 2);
}

TEST_CASE("Submitty: a status, a score 0 to 1 and messages with one of four statuses") {
    for (const SubmissionResult& one : {graded(), failed()}) {
        const json result = parsed("submitty", one);
        CHECK(result.at("status") == "success");  // the validator ran
        const double score = result.at("data").at("score");
        CHECK((score >= 0.0 && score <= 1.0));
        REQUIRE_FALSE(result["data"].at("message").empty());
        for (const json& message : result["data"]["message"]) {
            CHECK(message.at("message").is_string());
            const std::set<std::string> known{"information", "failure", "warning", "success"};
            CHECK(known.count(message.at("status")) == 1);
        }
    }
}

TEST_CASE("VPL: one proposal of a grade, at the end, and no forged one") {
    const std::vector<std::string> all = lines(text("vpl", graded()));
    REQUIRE(all.size() > 3);
    CHECK(all.back() == "Grade :=>> 71.25");
    for (std::size_t i = 0; i + 1 < all.size(); ++i) {
        CHECK(all[i].starts_with("Comment :=>> "));
        CHECK_FALSE(all[i].starts_with("Comment :=>> -"));
    }
    // No mark is no proposal: the teacher looks.
    for (const std::string& line : lines(text("vpl", failed())))
        CHECK(line.starts_with("Comment :=>> "));
}

TEST_CASE("Classroom 50: the schema's fields, and integer scores that add up") {
    for (const SubmissionResult& one : {graded(), failed()}) {
        const json result = parsed("classroom50", one);
        CHECK(result.at("schema") == "classroom50/result/v1");
        for (const char* field :
             {"classroom", "assignment", "submission", "commit", "release", "review", "datetime"})
            CHECK_FALSE(result.at(field).get<std::string>().empty());
        CHECK(result.at("score").is_number_integer());
        CHECK(result.at("max-score") == 100);
        long score = 0, most = 0;
        for (const json& test : result.at("tests")) {
            CHECK(test.at("test-name").is_string());
            CHECK(test.at("passed").is_boolean());
            score += test.at("score").get<long>();
            most += test.at("max-score").get<long>();
        }
        CHECK(score == result["score"]);
        CHECK(most == result["max-score"]);
    }
    CHECK(parsed("classroom50", graded()).at("score") == 71);
}

TEST_CASE("SARIF: version, tool, rules and results at lines, by severity") {
    const json log = parsed("sarif", graded());
    CHECK(log.at("version") == "2.1.0");
    const json& run = log.at("runs").at(0);
    CHECK(run.at("tool").at("driver").at("name") == "Farol");
    REQUIRE(run.at("results").size() == 3);
    for (const json& result : run["results"]) {
        CHECK(run["tool"]["driver"]["rules"][result.at("ruleIndex").get<std::size_t>()]["id"] ==
              result.at("ruleId"));
        CHECK_FALSE(result.at("message").at("text").get<std::string>().empty());
        const json& place = result.at("locations").at(0).at("physicalLocation");
        CHECK(place.at("artifactLocation").at("uri") == "work/ana%20b/scene.xml");
        CHECK(place.at("region").at("startLine").get<int>() >= 1);
        CHECK(result.at("partialFingerprints").size() == 1);
    }
    CHECK(run["results"][0]["level"] == "error");  // that costs points
    CHECK(run["results"][0]["locations"][0]["physicalLocation"]["region"]["startLine"] == 14);
    CHECK(run["results"][1]["level"] == "warning");
    CHECK(run["results"][2]["level"] == "note");
    CHECK(parsed("sarif", failed())["runs"][0]["results"][0]["ruleId"] == "grade.no-scene");
}

TEST_CASE("SARIF: at most as many results as GitHub shows") {
    SubmissionResult many = graded();
    TaskGrade grade = *many.tasks[0].grade();
    json document = json::parse(grade.json);
    for (int i = 0; i < 6'000; ++i)
        document["diagnostics"].push_back(
            {{"code", "xml.repaired"}, {"severity", "info"}, {"message", "m"}, {"line", 1}});
    grade.json = document.dump();
    many.tasks[0].result = grade;
    const json run = parsed("sarif", many)["runs"][0];
    CHECK(run["results"].size() == 5'000);
    CHECK(run["results"][0]["level"] == "error");
    CHECK(run["properties"]["resultsLeftOut"] == 1'003);
    std::set<std::string> prints;
    for (const json& result : run["results"])
        CHECK(prints.insert(result["partialFingerprints"].begin().value()).second);
}

TEST_CASE("GitHub: one command a line, with file and line, and no forged command") {
    const std::vector<std::string> all = lines(text("github", graded()));
    REQUIRE(all.size() == 3);
    CHECK_THAT(all[0], Catch::StartsWith("::error file=work/ana b/scene.xml,line=14,"
                                         "title=transform.angle-sign::group"));
    CHECK_THAT(all[1], Catch::StartsWith("::warning "));
    CHECK_THAT(all[2], Catch::StartsWith("::notice "));
    CHECK_THAT(all[2], Catch::EndsWith("::100 %25 <other> colour, \"red\": none"));
}

TEST_CASE("diagnostics of a document are findings at its lines") {
    std::ostringstream sarif, github;
    const farol::Diagnostics all{
        {farol::Severity::error, "xml.tag", {"a,b:c.xml", 7, 2}, "m\nn", ""}};
    writeSarif(sarif, all);
    writeGithub(github, all);
    CHECK(json::parse(sarif.str())["runs"][0]["results"][0]["level"] == "error");
    CHECK(github.str() == "::error file=a%2Cb%3Ac.xml,line=7,title=xml.tag::m n\n");
}
