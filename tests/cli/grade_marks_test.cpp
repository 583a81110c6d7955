#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "core/text.h"
#include "run.h"
#include "tests/support/skip.h"

// What a teacher does with marks: overrides, groups, rubrics and weights of tasks, pseudonyms,
// feedback.
using namespace farol::test;
using nlohmann::json;

namespace {

constexpr const char* kTask = R"(<world><window width="96" height="96"/>
<camera><position x="4" y="3" z="5"/><lookAt x="0" y="0" z="0"/><projection fov="50" near="1" far="50"/></camera>
<lights><light type="directional" dirx="1" diry="2" dirz="1"/></lights>
<group><transform><translate x="1" y="0" z="0"/><rotate angle="40" x="0" y="0" z="1"/></transform>
 <models><model file="box_1_2.3d"/></models></group></world>)";

std::string withAngle(const std::string& angle) {
    std::string text = kTask;
    return text.replace(text.find("\"40\""), 4, "\"" + angle + "\"");
}

void makeStudents() {
    freshFolder();
    writeFile("reference.xml", kTask);
    writeFile("class/Ana Alves_101_assignsubmission_file_/scene.xml", kTask);
    writeFile("class/Bento_102_assignsubmission_file/scene.xml", withAngle("-40"));
    writeFile("class/Carla_103_assignsubmission_file_/notes.txt", "by hand");
}

std::map<std::string, json> rowsByName(const std::string& output) {
    std::map<std::string, json> rows;
    const json report = json::parse(readFile(output + "/report.json"));
    for (const json& one : report.at("submissions")) rows[one.at("name")] = one;
    return rows;
}

}  // namespace

TEST_CASE("marks by hand survive a rerun, and nothing is graded again for them") {
    makeStudents();
    const std::string command = "grade --reference reference.xml class -o out --json";
    REQUIRE(run(command).status == 0);
    const std::string table =
        "student,criterion,mark,comment\nBento,transforms,11,half\n103,,42,seen on paper\n"
        "Dora,,1,\n";
    writeFile("out/overrides.csv", table);
    for (int again = 0; again < 2; ++again) {
        const Outcome outcome = run(command);
        INFO(outcome.err << outcome.out);
        REQUIRE(outcome.status == 0);
        CHECK(json::parse(outcome.out).at("graded") == 0);
        const auto rows = rowsByName("out");
        CHECK(rows.at("Carla").at("points") == 42.0);
        CHECK(rows.at("Carla").at("graded") == true);
        CHECK(rows.at("Ana Alves").at("points") == 100.0);
        const json bento = rows.at("Bento").at("tasks").at(0).at("grade");
        for (const json& one : bento.at("criteria"))
            if (one.at("measure") == "transforms") CHECK(one.at("points") == 11.0);
        CHECK(rows.at("Bento").at("points") == bento.at("points"));
        CHECK_THAT(outcome.out, Catch::Contains("grade.override-unused"));
        CHECK(readFile("out/overrides.csv") == table);
        CHECK_THAT(readFile("out/grades.csv"), Catch::Contains("seen on paper"));
        CHECK_THAT(readFile("out/criteria.csv"), Catch::Contains("\"transforms\""));
    }
    writeFile("bad.csv", "student,mark,comment\nBento,good,\n");
    const Outcome bad = run("grade --reference reference.xml class -o out --overrides bad.csv");
    CHECK(bad.status == 1);
    CHECK_THAT(bad.err, Catch::Contains("bad.csv:2") && Catch::Contains("[grade.table]"));
}

TEST_CASE("tasks have their own rubrics and weights") {
    freshFolder();
    writeFile("tasks/one.xml", kTask);
    writeFile("tasks/two.xml", kTask);
    writeFile("class/ana/one.xml", kTask);
    writeFile("rubrics/one.json", R"({"weight": 3, "points": 20})");
    writeFile("rubrics/rubric.json", R"({"weight": 1, "points": 20})");
    REQUIRE(run("grade --reference tasks class -o out --rubric rubrics").status == 0);
    const json report = json::parse(readFile("out/report.json"));
    CHECK(report.at("submissions").at(0).at("points") == 15.0);
    CHECK(report.at("submissions").at(0).at("most") == 20.0);
}

TEST_CASE("anonymous reports hold no name, and the key keeps who is who") {
    makeStudents();
    const std::string command =
        "grade --reference reference.xml class -o out --anonymous key.csv --feedback";
    const Outcome first = run(command);
    INFO(first.err << first.out);
    REQUIRE(first.status == 0);
    const std::string key = readFile("key.csv");
    for (const char* name : {"Ana Alves", "Bento", "Carla"}) CHECK_THAT(key, Catch::Contains(name));
    for (const char* file : {"report.html", "grades.csv", "criteria.csv", "junit.xml",
                             "report.json", "feedback.zip", "class.html"})
        for (const char* name : {"Ana Alves", "Bento", "Carla", "102"})
            CHECK_THAT(readFile(std::string("out/") + file), !Catch::Contains(name));
    const auto before = rowsByName("out");
    writeFile("class/Aaron_100_assignsubmission_file_/scene.xml", withAngle("50"));
    REQUIRE(run(command).status == 0);
    CHECK_THAT(readFile("key.csv"), Catch::StartsWith(key) && Catch::Contains("Aaron"));
    const auto after = rowsByName("out");
    CHECK(after.size() == 4);
    for (const auto& [name, row] : before) CHECK(after.at(name) == row);
    CHECK(run("grade --reference reference.xml class -o out --anonymous out/key.csv").status == 2);
}

TEST_CASE("feedback is a page for each student, under the names that Moodle takes back") {
    makeStudents();
    writeFile("out/groups.csv",
              "submission,full name,identifier\n102,Bento,102\n102,Rui Sá,Participant 107\n");
    const Outcome outcome = run("grade --reference reference.xml class -o out --feedback");
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK_THAT(readFile("out/grades.csv"), Catch::Contains("\"Participant 107\",\"Rui Sá\","));
    if (!hasProgram("python3")) return;
    const std::string script =
        "import zipfile; z = zipfile.ZipFile('out/feedback.zip'); assert z.testzip() is None; "
        "print('\\n'.join(z.namelist())); "
        "p = z.read('Rui Sá_107_assignsubmission_file_/feedback.html').decode(); "
        "assert 'wrong sign' in p and 'Ana Alves' not in p";
    writeFile("list.py", script);
    const int status =
        std::system(("cd '" + folder().string() + "' && python3 list.py > names.txt").c_str());
    CHECK(status == 0);
    CHECK(readFile("names.txt") ==
          "Ana Alves_101_assignsubmission_file_/feedback.html\n"
          "Bento_102_assignsubmission_file_/feedback.html\n"
          "Rui Sá_107_assignsubmission_file_/feedback.html\n"
          "Carla_103_assignsubmission_file_/feedback.html\n");
}
