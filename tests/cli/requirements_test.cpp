// `farol explain`, grading by requirements, and the check of meshes, as a user runs them.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "run.h"
#include "tests/support/paths.h"

using namespace farol::test;
using nlohmann::json;

namespace {

constexpr const char* kScene2 = R"(<world><window width="64" height="64"/>
<camera><position x="4" y="3" z="8"/><lookAt x="0" y="0" z="0"/></camera>
<lights><light type="directional" dirx="1" diry="2" dirz="1"/></lights>
<group name="hub"><models><model file="sphere_1_16_12.3d"/></models>
 <group><transform><rotate time="5" x="0" y="1" z="0"/><translate x="3" y="0" z="0"/></transform>
  <models><model file="sphere_0.4_16_12.3d"/></models></group></group>
<group><transform><translate x="-3" y="0" z="0"/></transform>
 <models><model file="box_1_2.3d"/></models></group></world>)";

constexpr const char* kRubric = R"({
  "times": [0, 1],
  "define": [{ "id": "centre", "select": { "shape": ["sphere"], "moves": false } }],
  "requirements": [
    { "id": "sun", "text": "A sun", "points": 2, "select": { "shape": ["sphere"], "moves": false } },
    { "id": "planets", "text": "Two planets", "points": 4, "count": 2,
      "select": { "shape": ["sphere"], "turnsAbout": "centre" } },
    { "id": "cones", "text": "A cone or a torus", "points": 1, "select": { "shape": ["cone", "torus"] } }
  ]
})";

}  // namespace

TEST_CASE("explain shows matches and misses with their lines, in the reader's language") {
    freshFolder();
    writeFile("rubric.json", kRubric);
    writeFile("scene.xml", kScene2);
    const Outcome text = run("explain rubric.json scene.xml");
    INFO(text.out << text.err);
    REQUIRE(text.status == 0);
    CHECK_THAT(text.out, Catch::Contains("times 0 1 s"));
    CHECK_THAT(text.out, Catch::Contains("planets: 1 found"));
    CHECK_THAT(text.out, Catch::Contains("scene.xml:6: ") && Catch::Contains("orbit 3 in 5 s"));
    CHECK_THAT(text.out, Catch::Contains("not met  0 / 1  cones"));
    CHECK_THAT(text.out, Catch::Contains("expected cone or torus"));
    const Outcome found = run("explain rubric.json scene.xml --json");
    const json all = json::parse(found.out);
    REQUIRE(all["requirements"].size() == 3);
    CHECK(all["requirements"][0]["state"] == "met");
    CHECK(all["requirements"][0]["matches"][0]["line"] == 4);
    CHECK(all["requirements"][1]["state"] == "partly met");
    CHECK(all["requirements"][1]["reason"] == "1 of 2 found");
    CHECK(all["requirements"][2]["state"] == "not met");
    for (const auto& [language, words] :
         {std::pair{"pt", "não cumprido"}, {"es", "no cumplido"}, {"cs", "nesplněno"}}) {
        const Outcome other =
            run(std::string("explain --lang ") + language + " rubric.json scene.xml");
        CHECK_THAT(other.out, Catch::Contains(words));
        for (const char* english :
             {"not met", "found", "stands still", "radius", "expected", " or "})
            CHECK_THAT(other.out, !Catch::Contains(english));
    }
    writeFile(
        "rubric.json",
        "{\n \"requirements\": [{\"id\": \"a\", \"text\": \"t\", \"select\": {}, \"cout\": 3}]}");
    const Outcome wrong = run("explain rubric.json scene.xml");
    CHECK(wrong.status == 1);
    CHECK_THAT(wrong.err, Catch::Contains("rubric.json:2:") && Catch::Contains("did you mean"));
    CHECK(run("explain rubric.json").status == 2);
}

TEST_CASE("a class is graded by requirements without a reference, in every language") {
    freshFolder();
    writeFile("rubric.json", kRubric);
    writeFile("class/ana/scene.xml", kScene2);
    json english;
    for (const std::string language : {"en", "pt", "es", "cs"}) {
        const Outcome done = run("grade --jobs 1 --feedback --lang " + language +
                                 " --rubric rubric.json class -o " + language);
        INFO(done.err);
        REQUIRE(done.status == 0);
        const json grade =
            json::parse(readFile(language + "/report.json"))["submissions"][0]["tasks"][0]["grade"];
        CHECK(grade["points"] == 4.0);
        CHECK(grade["most"] == 7.0);
        const json& planets = grade["criteria"][1];
        CHECK(planets["state"] == "partly met");
        const json& finding = grade["findings"][0];
        CHECK(finding["code"] == "requirement.partly");
        if (language == "en") {
            english = grade;
            CHECK(finding["line"].get<int>() > 0);
            CHECK_THAT(readFile("en/class.html"), Catch::Contains("a requirement is partly met"));
            continue;
        }
        CHECK(planets["reason"] != english["criteria"][1]["reason"]);
        CHECK(finding["message"] != english["findings"][0]["message"]);
        CHECK(finding["places"][0]["message"] != english["findings"][0]["places"][0]["message"]);
        CHECK(finding["line"] == english["findings"][0]["line"]);
        CHECK_THAT(readFile(language + "/class.html"),
                   !Catch::Contains("a requirement is") && !Catch::Contains(" found"));
    }
}

TEST_CASE("one submission by requirements, in the formats of platforms") {
    freshFolder();
    writeFile("rubric.json", kRubric);
    writeFile("mine/scene.xml", kScene2);
    const Outcome done =
        run("grade --single --rubric rubric.json mine -o out --format gradescope,vpl,junit,sarif");
    INFO(done.err);
    REQUIRE(done.status == 0);
    const json results = json::parse(readFile("out/results.json"));
    CHECK(results["score"] == 4.0);
    REQUIRE(results["tests"].size() >= 3);
    CHECK(results["tests"][0]["score"] == 2.0);
    CHECK(results["tests"][1]["score"] == 2.0);
    CHECK(results["tests"][1]["max_score"] == 4.0);
    CHECK_THAT(readFile("out/vpl.txt"), Catch::Contains("Grade :=>> 4.00"));
    CHECK_THAT(readFile("out/findings.sarif"), Catch::Contains("requirement.unmet"));
}

TEST_CASE("a mesh file is checked against a shape and against another file") {
    freshFolder();
    REQUIRE(run("generate sphere 1 10 10 mine.3d").status == 0);
    const Outcome same = run("compare mine.3d --shape \"sphere 1 10 10\"");
    CHECK(same.status == 0);
    CHECK_THAT(same.out, Catch::Contains("it is the expected mesh"));
    const Outcome other = run("compare mine.3d --shape \"sphere 1 12 10\" --json");
    CHECK(other.status == 1);
    const json found = json::parse(other.out);
    CHECK(found["same"] == false);
    CHECK(found["triangles"] != found["expectedTriangles"]);
    REQUIRE(found["diagnostics"].size() > 0);
    CHECK(found["diagnostics"][0]["code"].get<std::string>().starts_with("check."));
    REQUIRE(run("generate sphere 1 12 10 other.3d").status == 0);
    CHECK(run("compare mine.3d other.3d").status == 1);
    CHECK(run("compare mine.3d mine.3d").status == 0);
    const Outcome czech = run("compare mine.3d other.3d --lang cs");
    CHECK_THAT(czech.out, Catch::Contains("není to očekávaná síť"));
    CHECK_THAT(czech.out + czech.err, !Catch::Contains("expected"));
    CHECK(run("compare mine.3d").status == 2);
    CHECK(run("compare mine.3d other.3d --shape \"sphere 1 10 10\"").status == 2);
    const Outcome unknown = run("compare mine.3d --shape \"spere 1 10 10\"");
    CHECK(unknown.status == 2);
    CHECK_THAT(unknown.err, Catch::Contains("did you mean \"sphere\"?"));
}

TEST_CASE("the lines of a comparison are in the reader's language") {
    freshFolder();
    writeFile("scene.xml", kScene2);
    REQUIRE(run("render scene.xml -o a.png").status == 0);
    REQUIRE(run("render scene.xml -o b.png --time 1").status == 0);
    const Outcome english = run("compare a.png b.png");
    CHECK_THAT(english.out, Catch::Contains("same pixel") && Catch::Contains("median"));
    for (const char* language : {"pt", "es", "cs"}) {
        const Outcome other = run(std::string("compare a.png b.png --lang ") + language);
        CHECK(other.status == 0);
        for (const char* word : {"same pixel", "least of", "mean ", "within", "levels are"})
            CHECK_THAT(other.out, !Catch::Contains(word));
    }
}

TEST_CASE("agreement without variation is not defined, and not nan") {
    freshFolder();
    writeFile("rubric.json", kRubric);
    writeFile("class/ana/scene.xml", kScene2);
    writeFile("class/rui/scene.xml", kScene2);
    writeFile("marks.csv", "student,mark\nana,4\nrui,4\n");
    const std::string command =
        "grade --jobs 1 --rubric rubric.json class -o report --agreement marks.csv";
    const Outcome done = run(command);
    INFO(done.err);
    REQUIRE(done.status == 0);
    CHECK_THAT(done.out, Catch::Contains("alpha not defined, tau-b not defined"));
    CHECK_THAT(done.out, !Catch::Contains("nan"));
    CHECK(json::parse(run(command + " --json").out)["agreement"]["alpha"].is_null());
    CHECK(json::parse(readFile("report/agreement.json"))["tauB"].is_null());
}
