#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "run.h"
#include "tests/support/archives.h"

// What a class looks like when it comes from Moodle: one zip, files without folders, files that are
// no scenes, several documents.
using namespace farol::test;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

constexpr const char* kReference = R"(<world><window width="96" height="96"/>
<camera><position x="4" y="3" z="5"/><lookAt x="0" y="0" z="0"/><projection fov="50" near="1" far="50"/></camera>
<lights><light type="directional" dirx="1" diry="2" dirz="1"/></lights>
<group><transform><translate x="1" y="0" z="0"/><rotate angle="40" x="0" y="0" z="1"/></transform>
 <models><model file="box_1_2.3d"/></models></group></world>)";

std::string turned() {
    std::string text = kReference;
    return text.replace(text.find("\"40\""), 4, "\"-40\"");
}

std::map<std::string, json> rowsOf(const std::string& output) {
    std::map<std::string, json> rows;
    const json report = json::parse(readFile(output + "/report.json"));
    for (const json& one : report.at("submissions")) rows[one.at("id")] = one;
    return rows;
}

/// The reason of a row without a mark.
std::string reasonOf(const json& row) {
    const json& task = row.at("tasks").at(0);
    return task.contains("failure")
               ? task.at("failure").at("message").get<std::string>()
               : task.at("grade").at("reason").at("message").get<std::string>();
}

}  // namespace

TEST_CASE("Moodle's zip of a class is graded as its folder is") {
    freshFolder();
    writeFile("reference.xml", kReference);
    const std::string inner = pack(Packing::zip, {{"work/scene.xml", turned()}});
    const std::map<std::string, std::string> files = {
        {"Ana Alves_101_assignsubmission_file_/scene.xml", kReference},
        {"Bento_102_assignsubmission_file_/hand-in.zip", inner},
        {"Carla_103_assignsubmission_file_/scene.pdf", "%PDF-1.4"},
        {"Duarte_104_assignsubmission_file_/house.xml", turned()},
        {"Duarte_104_assignsubmission_file_/house_final.xml", kReference},
        {"Eva_105_assignsubmission_file_robot.xml", kReference},
        {"Eva_105_assignsubmission_file_notes.txt", "see robot.xml"},
        {"Filipe_106_assignsubmission_file_/scene.xml", ""},
        {"__MACOSX/._scene.xml", "x"},
    };
    for (const auto& [name, content] : files) writeFile("class/" + name, content);
    std::vector<Packed> list;
    for (const auto& [name, content] : files) list.push_back({name, content});
    writeFile("class.zip", pack(Packing::zip, list));
    std::vector<Packed> below;
    for (const Packed& one : list) below.push_back({"class/" + one.path, one.content});
    writeFile("below.zip", pack(Packing::zipStored, below));
    for (const char* from : {"class", "class.zip", "below.zip"}) {
        const std::string output = std::string(from) + ".out";
        const Outcome outcome =
            run(std::string("grade --reference reference.xml ") + from + " -o " + output);
        INFO(from << ": " << outcome.err << outcome.out);
        REQUIRE(outcome.status == 0);
        const auto rows = rowsOf(output);
        REQUIRE(rows.size() == 6);
        const auto row = [&](const std::string& student) {
            return rows.at(student + "_assignsubmission_file_");
        };
        CHECK(row("Ana Alves_101").at("points") == 100.0);
        CHECK(row("Ana Alves_101").at("name") == "Ana Alves");
        CHECK(row("Bento_102").at("graded") == true);
        CHECK(row("Bento_102").at("points") < 95.0);
        CHECK(row("Carla_103").at("graded") == false);
        CHECK_THAT(reasonOf(row("Carla_103")), Catch::Contains(".pdf"));
        CHECK(row("Duarte_104").at("points") == 100.0);
        CHECK_THAT(row("Duarte_104").dump(), Catch::Contains("grade.chosen"));
        CHECK(row("Eva_105").at("points") == 100.0);
        CHECK(row("Filipe_106").at("graded") == false);
    }
}

TEST_CASE("a class in a file that is no zip is refused with its reason") {
    freshFolder();
    writeFile("reference.xml", kReference);
    const std::string whole = pack(Packing::zip, {{"ana/scene.xml", kReference}});
    writeFile("class.zip", whole);
    writeFile("torn.zip", whole.substr(0, whole.size() - 30));
    writeFile("empty.zip", "");
    std::string moved = whole;  // its directory says that it begins behind the end
    moved[moved.size() - 3] = '\x7F';
    writeFile("moved.zip", moved);
    for (const char* name : {"torn.zip", "empty.zip", "moved.zip"}) {
        INFO(name);
        const Outcome outcome =
            run(std::string("grade --reference reference.xml ") + name + " -o out");
        CHECK(outcome.status == 1);
        CHECK_THAT(outcome.err, Catch::Contains("[bundle.damaged]"));
    }
    REQUIRE(run("grade --reference reference.xml class.zip -o out").status == 0);
}

TEST_CASE(
    "every entry of a class is a row, and an empty file of any type leaves the others alone") {
    freshFolder();
    writeFile("reference.xml", kReference);
    writeFile("class/ana.xml", kReference);
    writeFile("class/zoe/scene.xml", kReference);
    const char* endings[] = {"xml", "zip", "tar", "tgz", "gz",  "7z",   "rar",
                             "png", "jpg", "pdf", "txt", "cpp", "docx", "3d"};
    for (const char* ending : endings) {
        writeFile(std::string("class/empty.") + ending, "");
        writeFile(std::string("class/in ") + ending + "/scene." + ending, "");
    }
    writeFile("class/essay.docx", "PK\x03\x04");
    writeFile("class/hand-in.rar", "Rar!\x1A\x07 and no more");
    writeFile("class/no ending", "x");
    const Outcome outcome = run("grade --reference reference.xml class -o out --jobs 2");
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    const auto rows = rowsOf("out");
    CHECK(rows.size() == 2 * std::size(endings) + 5);
    for (const auto& [id, row] : rows) {
        INFO(id << " " << row.dump().substr(0, 400));
        const bool isWhole = id == "ana.xml" || id == "zoe";
        CHECK(row.at("graded") == isWhole);
        if (isWhole)
            CHECK(row.at("points") == 100.0);
        else
            CHECK_FALSE(reasonOf(row).empty());
    }
    CHECK_THAT(reasonOf(rows.at("essay.docx")),
               Catch::Contains(".docx") && Catch::Contains("hand in"));
}

TEST_CASE("a late hand-in is graded alone, and what did not change is not graded again") {
    freshFolder();
    writeFile("reference.xml", kReference);
    writeFile("class/ana.xml", kReference);
    writeFile("class/bento.xml", turned());
    const std::string command = "grade --reference reference.xml class -o out --json";
    const json run1 = json::parse(run(command).out);
    CHECK(run1.at("graded") == 2);
    writeFile("class/carla.xml", kReference);
    const json run2 = json::parse(run(command).out);
    CHECK(run2.at("graded") == 1);
    CHECK(run2.at("kept") == 2);
    CHECK(rowsOf("out").size() == 3);
    writeFile("class/bento.xml", kReference);  // handed in anew
    const json run3 = json::parse(run(command).out);
    CHECK(run3.at("graded") == 1);
    CHECK(run3.at("kept") == 2);
    CHECK(rowsOf("out").at("bento.xml").at("points") == 100.0);
}
