#include "grade/rubric/choice.h"

#include <catch2/catch.hpp>
#include <map>
#include <memory>

#include "core/error.h"
#include "grade/rubric/subject.h"

using namespace farol::grade;

namespace {

using Files = std::map<std::string, std::string>;

/// The chosen file's path, or the code of the error.
std::string chosen(const Files& files, const Wanted& wanted) {
    try {
        const Subject subject =
            subjectOf(std::make_shared<farol::scene::BundleAssets>(files), "folder", wanted);
        return subject.job.path.empty() ? subject.job.name : subject.job.path;
    } catch (const farol::Error& error) {
        return error.code();
    }
}

std::string scene(const std::string& files) { return "<world>" + files + "</world>"; }

}  // namespace

TEST_CASE("the scene that is meant among files") {
    struct Case {
        Files files;
        const char* task;
        const char* expected;
    };
    const Case given = GENERATE(values<Case>({
        {{{"a.xml", "x"}, {"t.png", "x"}}, "", "a.xml"},
        {{{"work/a.xml", "x"}, {"work/t.png", "x"}}, "", "work/a.xml"},
        {{{"a.xml", "x"}, {"scene.xml", "y"}}, "", "scene.xml"},
        {{{"a.xml", "x"}, {"old/a.xml", "y"}}, "", "a.xml"},
        {{{"a.xml", "x"}, {"b.xml", "y"}}, "", "grade.which-scene"},
        {{{"a.xml", "x"}, {"b.xml", "x"}}, "", "a.xml"},
        {{{"a.xml", "x"}, {"b.xml", "x"}}, "B", "b.xml"},
        {{{"one/s.xml", "x"}, {"two/s.xml", "x"}}, "two", "two/s.xml"},
        {{{"a.xml", "x"}}, "b", "grade.no-scene"},
        {{{"read.me", "x"}}, "", "grade.no-scene"},
        {{{"shot.png", "x"}}, "", "shot.png"},
        {{{"hand-in.zip", "x"}, {"notes.txt", "x"}}, "", "hand-in.zip"},
        {{{"caf\xE9.xml", "x"}, {"b.xml", "x"}}, "caf\xC3\xA9", "caf\xE9.xml"},
        {{{"a.xml", ""}}, "", "grade.empty-file"},
        {{{"shot.png", ""}}, "", "grade.empty-file"},
        {{{"hand-in.tar", ""}}, "", "grade.empty-file"},
        {{{"a.xml", "x"}, {"t.png", ""}}, "", "a.xml"},
        // Attempts beside what is handed in.
        {{{"house.xml", scene("1")}, {"house_final.xml", scene("2")}}, "", "house_final.xml"},
        {{{"house.xml", scene("1")}, {"house old.xml", scene("2")}}, "", "house.xml"},
        {{{"scene.xml", scene("1")}, {"scene (2).xml", scene("2")}}, "", "scene.xml"},
        {{{"solar1.xml", scene("1")}, {"solar3.xml", scene("2")}}, "", "solar3.xml"},
        {{{"fase3/scene.xml", scene("1")}, {"fase4/scene.xml", scene("2")}}, "", "fase4/scene.xml"},
        {{{"cg/solar/solar.xml", scene("1")}, {"cg/solar/moon.xml", scene("2")}},
         "",
         "cg/solar/solar.xml"},
        {{{"build.xml", "<project/>"}, {"robot.xml", scene("")}}, "", "robot.xml"},
        // The task's name in any spelling.
        {{{"Test 4.1 (final).xml", "x"}, {"Test 4.2.xml", "y"}},
         "test_4_1",
         "Test 4.1 (final).xml"},
        {{{"testeFase4.xml", "x"}, {"testeFase3.xml", "y"}}, "phase 4", "testeFase4.xml"},
        {{{"test_4_10.xml", "x"}}, "test_4_1", "grade.no-scene"},
        {{{"teste1.xml", "x"}, {"teste2.xml", "y"}}, "test 2", "teste2.xml"},
        {{{"BRA\xC3\x87O-robot.xml", "x"}, {"b.xml", "y"}}, "robot", "BRA\xC3\x87O-robot.xml"},
    }));
    CHECK(chosen(given.files, {given.task, {}, {}}) == given.expected);
}

TEST_CASE(
    "the document that names the reference's files is meant, unless another task has its name") {
    const std::string right = scene(R"(<texture file="tex/Wood.png"/><texture file='brick.png'/>)");
    const std::vector<std::string> named = filesNamedIn(right);
    CHECK(named == std::vector<std::string>{"brick.png", "wood.png"});
    CHECK(filesNamedIn(R"(<a x="1.50" y=".xml" z="a.1" w="mesh.3d">)") ==
          std::vector<std::string>{"mesh.3d"});
    CHECK(chosen({{"p.xml", right}, {"q.xml", scene("")}}, {"", {}, named}) == "p.xml");
    CHECK(chosen({{"p.xml", right}, {"q.xml", scene("")}}, {"house", {}, named}) == "p.xml");
    CHECK(chosen({{"barn.xml", right}}, {"house", {"barn"}, named}) == "grade.no-scene");
    CHECK(chosen({{"q.xml", scene("")}}, {"house", {"barn"}, named}) == "grade.no-scene");
    // Half as many and more: then names decide.
    CHECK(chosen({{"p.xml", right}, {"p_final.xml", scene("'wood.png'")}}, {"", {}, named}) ==
          "p_final.xml");
}

TEST_CASE("a choice is reported with its reason, and a refusal with the names") {
    const auto files = std::make_shared<farol::scene::BundleAssets>(
        Files{{"house.xml", scene("1")}, {"house_final.xml", scene("2")}});
    const Subject subject = subjectOf(files, "folder", {});
    REQUIRE(subject.notes.size() == 1);
    CHECK(subject.notes.front().code == "grade.chosen");
    CHECK(
        subject.notes.front().message ==
        "graded \"house_final.xml\", one of 2 .xml files; its name is that of the newest version");
    const auto others =
        std::make_shared<farol::scene::BundleAssets>(Files{{"a.xml", "x"}, {"b.xml", "y"}});
    CHECK_THROWS_WITH(subjectOf(others, "folder", {}), Catch::Contains("a.xml, b.xml"));
    const auto document = std::make_shared<farol::scene::BundleAssets>(Files{{"a.docx", "x"}});
    CHECK_THROWS_WITH(subjectOf(document, "folder", {}),
                      Catch::Contains(".docx file is not a scene"));
}
