#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "run.h"

// `farol grade --format`, `--single` and `--agreement`, and `farol validate --format`, as a user
// runs them.
using namespace farol::test;
using nlohmann::json;

namespace {

constexpr const char* kReference = R"(<world><window width="64" height="64"/>
<camera><position x="4" y="3" z="5"/><lookAt x="0" y="0" z="0"/></camera>
<lights><light type="directional" dirx="1" diry="2" dirz="1"/></lights>
<group>
 <transform>
  <translate x="1" y="0" z="0"/>
  <rotate angle="40" x="0" y="0" z="1"/>
 </transform>
 <models><model file="box_1_2.3d"/></models>
</group></world>)";

std::string negated() {
    std::string text = kReference;
    const std::string angle = "angle=\"40\"";
    return text.replace(text.find(angle), angle.size(), "angle=\"-40\"");
}

void makeClass() {
    freshFolder();
    writeFile("reference.xml", kReference);
    writeFile("class/ana/scene.xml", kReference);
    writeFile("class/rui/work/scene.xml", negated());
    writeFile("class/eva/notes.txt", "nothing");
}

}  // namespace

TEST_CASE("formats of a class: the chosen files and no others") {
    makeClass();
    const Outcome done = run(
        "grade --reference reference.xml class -o report --format gradescope,sarif --format vpl");
    REQUIRE(done.status == 0);
    CHECK_FALSE(exists("report/report.html"));
    CHECK(json::parse(readFile("report/gradescope/ana/results.json")).at("score") == 100);
    CHECK(json::parse(readFile("report/gradescope/rui/results.json")).at("score") < 100);
    CHECK(json::parse(readFile("report/gradescope/eva/results.json")).at("score") == 0);
    CHECK_THAT(readFile("report/vpl/ana/vpl.txt"), Catch::Contains("Grade :=>> 100.00\n"));
    const json results = json::parse(readFile("report/findings.sarif"))["runs"][0]["results"];
    REQUIRE(results.size() > 1);
    CHECK(results[0]["ruleId"] == "grade.no-scene");
    CHECK(results[1]["ruleId"] == "transform.angle-sign");
    const json place = results[1]["locations"][0]["physicalLocation"];
    CHECK(place["artifactLocation"]["uri"] == "class/rui/work/scene.xml");
    CHECK(place["region"]["startLine"] == 7);
}

TEST_CASE("one submission: a folder or a file, with its files in the report's folder") {
    makeClass();
    REQUIRE(run("grade --single --reference reference.xml class/rui -o one --format "
                "gradescope,submitty,github")
                .status == 0);
    CHECK(json::parse(readFile("one/results.json")).at("score") < 100);
    CHECK(json::parse(readFile("one/validation_results.json")).at("status") == "success");
    CHECK_THAT(readFile("one/annotations.txt"),
               Catch::StartsWith("::error file=class/rui/work/scene.xml,line=7,title="));
    REQUIRE(run("grade --single --reference reference.xml class/ana/scene.xml -o two --format "
                "prairielearn,junit")
                .status == 0);
    CHECK(json::parse(readFile("two/results.json")).at("score") == 1.0);
    CHECK_THAT(readFile("two/junit.xml"), Catch::Contains("failures=\"0\""));
    const Outcome none = run("grade --single --reference reference.xml class/zoe -o three");
    CHECK(none.status == 1);
    CHECK_THAT(none.err, Catch::Contains("[asset.missing]"));
}

TEST_CASE("an unknown format, and a variable that is missing, are the command line's fault") {
    makeClass();
    Outcome wrong = run("grade --reference reference.xml class -o report --format gradescop");
    CHECK(wrong.status == 2);
    CHECK_THAT(wrong.err, Catch::Contains("did you mean \"gradescope\"?"));
    wrong = run("grade --reference reference.xml class -o report --format classroom50");
    CHECK(wrong.status == 2);
    CHECK_THAT(wrong.err, Catch::Contains("environment variable CLASSROOM"));
    CHECK_FALSE(exists("report"));
}

TEST_CASE("marks of people beside the program's") {
    makeClass();
    writeFile("marks.csv",
              "student,rater,mark,comment\nana,P,95,fine\nana,Q,100,\nrui,P,60,sign\nrui,Q,70,\n"
              "nobody,P,5,\n");
    const Outcome done =
        run("grade --reference reference.xml class -o report --agreement marks.csv");
    REQUIRE(done.status == 0);
    CHECK_THAT(done.out, Catch::Contains("agreement of 2 submissions: alpha "));
    CHECK_THAT(done.err, Catch::Contains("marks.csv:6: warning:"));
    const json found = json::parse(readFile("report/agreement.json"));
    CHECK(found.at("submissions").size() == 2);
    CHECK(found.at("raters") == json::array({"P", "Q"}));
    CHECK(found.at("alpha").is_number());
    CHECK(found.at("alphaPeople").is_number());
    CHECK_THAT(readFile("report/agreement.html"), Catch::Contains("report.html#rui"));
    writeFile("marks.csv", "student,mark\nana,good\n");
    const Outcome wrong =
        run("grade --reference reference.xml class -o report --agreement marks.csv");
    CHECK(wrong.status == 1);
    CHECK_THAT(wrong.err, Catch::Contains("marks.csv:2: error:"));
}

TEST_CASE("validate writes SARIF and workflow commands, also for what cannot be read") {
    freshFolder();
    writeFile("a/scene.xml",
              "<world>\n<group>\n<models><model file=\"none.3d\"/></models>\n"
              "</group></world>");
    Outcome done = run("validate a/scene.xml --format github");
    CHECK(done.status == 1);
    CHECK_THAT(done.out,
               Catch::StartsWith("::error file=a/scene.xml,line=3,title=asset.missing::"));
    CHECK(done.err.empty());
    done = run("validate a/scene.xml --format sarif");
    CHECK(done.status == 1);
    const json result = json::parse(done.out)["runs"][0]["results"][0];
    CHECK(result["ruleId"] == "asset.missing");
    CHECK(result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] == "a/scene.xml");
    writeFile("b.xml", kScene);
    done = run("validate b.xml --format github");
    CHECK(done.status == 0);
    CHECK_THAT(done.out, Catch::StartsWith("::notice ") && !Catch::Contains("::error"));
    CHECK(run("validate b.xml --format sarif --json").status == 2);
}
