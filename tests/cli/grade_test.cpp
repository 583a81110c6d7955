#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "run.h"

// A class graded by the program itself: sandboxed workers, reports, going on after an interruption.
using namespace farol::test;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

constexpr const char* kReference = R"(<world><window width="96" height="96"/>
<camera><position x="4" y="3" z="5"/><lookAt x="0" y="0" z="0"/><projection fov="50" near="1" far="50"/></camera>
<lights><light type="directional" dirx="1" diry="2" dirz="1"/></lights>
<group>
 <transform>
  <translate x="1" y="0" z="0"/>
  <rotate angle="40" x="0" y="0" z="1"/>
 </transform>
 <models><model file="box_1_2.3d"/></models>
</group></world>)";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    text.replace(text.find(what), what.size(), by);
    return text;
}

void makeClass() {
    freshFolder("grade");
    writeFile("reference.xml", kReference);
    writeFile("class/Ana Alves_101_assignsubmission_file_/scene.xml", kReference);
    writeFile("class/Bento_102_assignsubmission_file_/work/s.xml",
              replaced(kReference, "angle=\"40\"", "angle=\"-40\""));
    writeFile("class/carla.xml", replaced(kReference, "</world>", ""));
    writeFile("class/duarte/notes.txt", "nothing to see");
    writeFile("class/eva.zip", "PK\x03\x04 this is no archive");
    // More than may be drawn; nested deeper than may be read.
    writeFile("class/filipe.xml", replaced(kReference, "box_1_2", "sphere_1_3000_3000"));
    std::string deep = "<world>";
    for (int i = 0; i < 5000; ++i) deep += "<group>";
    writeFile("class/gil.xml", deep);
    writeFile("class/=1+1/scene.xml", kReference);
}

json reportOf(const std::string& folder) { return json::parse(readFile(folder + "/report.json")); }

json gradeOf(const json& report, const std::string& id) {
    for (const json& one : report.at("submissions"))
        if (one.at("id") == id) return one;
    FAIL("no submission " << id);
    return {};
}

}  // namespace

TEST_CASE("a class is graded, whatever is in it") {
    makeClass();
    const Outcome first =
        run("grade --reference reference.xml class -o out --jobs 2 --deadline 20");
    INFO(first.err);
    REQUIRE(first.status == 0);
    const json report = reportOf("out");
    REQUIRE(report.at("submissions").size() == 8);
    const json ana = gradeOf(report, "Ana Alves_101_assignsubmission_file_");
    CHECK(ana.at("points") == 100.0);
    CHECK(ana.at("name") == "Ana Alves");
    CHECK(ana.at("identifier") == "Participant 101");
    const json bento = gradeOf(report, "Bento_102_assignsubmission_file_").at("tasks").at(0);
    const json finding = bento.at("grade").at("findings").at(0);
    CHECK(finding.at("code") == "transform.angle-sign");
    CHECK(finding.at("line") == 7);
    CHECK_THAT(finding.at("message").get<std::string>(),
               Catch::Contains("group 1") && Catch::Contains("(line 7)"));
    CHECK_THAT(finding.at("excerpt").get<std::string>(), Catch::Contains("7 > "));
    CHECK(gradeOf(report, "carla.xml").at("tasks").at(0).at("grade").at("refused") == true);
    CHECK(gradeOf(report, "duarte").at("tasks").at(0).at("failure").at("code") == "grade.no-scene");
    CHECK(gradeOf(report, "eva.zip").at("points") == 0.0);
    CHECK(gradeOf(report, "filipe.xml").at("passed") == false);
    CHECK_THAT(readFile("out/grades.csv"), Catch::Contains("\"'=1+1\""));

    // Again, and elsewhere with other jobs: the same bytes; what was graded is kept.
    const Outcome again = run("grade --reference reference.xml class -o out --json");
    REQUIRE(again.status == 0);
    CHECK(json::parse(again.out).at("kept").get<int>() >= 5);
    REQUIRE(run("grade --reference reference.xml class -o other --jobs 1").status == 0);
    for (const char* file : {"report.html", "grades.csv", "junit.xml", "report.json"})
        CHECK(readFile(std::string("out/") + file) == readFile(std::string("other/") + file));
}

TEST_CASE("tasks of a folder are found by their names, and pictures are references too") {
    makeClass();
    writeFile("tasks/one.xml", kReference);
    writeFile("tasks/two.xml", replaced(kReference, "box_1_2", "sphere_1_8_8"));
    writeFile("work/ana/ONE.xml", kReference);
    writeFile("work/ana/two/scene.xml", replaced(kReference, "box_1_2", "sphere_1_8_8"));
    writeFile("work/bento/one.xml", kReference);
    REQUIRE(run("grade --reference tasks work -o tasked").status == 0);
    const json report = reportOf("tasked");
    CHECK(gradeOf(report, "ana").at("points") == 100.0);
    CHECK(gradeOf(report, "bento").at("points") == 50.0);

    REQUIRE(run("render reference.xml -o expected.png --aa 1").status == 0);
    REQUIRE(run("grade --reference expected.png class -o pictured").status == 0);
    const json pictured = reportOf("pictured");
    CHECK(gradeOf(pictured, "Ana Alves_101_assignsubmission_file_").at("points") == 100.0);
    CHECK(gradeOf(pictured, "Bento_102_assignsubmission_file_").at("points") < 90.0);
}

TEST_CASE("what grade is told wrongly is said, with its exit code") {
    makeClass();
    writeFile("rubric.json", R"({"criteria": [{"measure": "beauty"}]})");
    fs::create_directories(fs::path(FAROL_TEST_OUTPUT) / "cli" / "grade" / "empty");
    struct Case {
        const char* arguments;
        int status;
        const char* says;
    };
    const Case one = GENERATE(values<Case>({
        {"class -o out", 2, "--reference"},
        {"--reference nosuch.xml class -o out", 1, "[asset.missing]"},
        {"--reference reference.xml nosuch -o out", 1, "[asset.missing]"},
        {"--reference reference.xml empty -o out", 1, "[grade.no-submissions]"},
        {"--reference reference.xml class -o out --rubric rubric.json", 1, "criteria[0].measure"},
        {"--reference class/carla.xml class -o out", 1, "[xml."},
        {"--reference reference.xml class -o out --jobs 99", 2, "--jobs"},
    }));
    INFO(one.arguments);
    const Outcome found = run(std::string("grade ") + one.arguments);
    CHECK(found.status == one.status);
    CHECK_THAT(found.err, Catch::Contains(one.says));
}
