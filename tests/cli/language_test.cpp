#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "run.h"
#include "tests/support/paths.h"

using namespace farol::test;
using nlohmann::json;

namespace {

constexpr const char* kRadians =
    "<world><group><transform><rotate angle=\"1.57\" x=\"0\" y=\"1\" z=\"0\"/></transform>"
    "<models><model file=\"box_1.3d\"/></models></group></world>";

}  // namespace

TEST_CASE("option --lang chooses the language of diagnostics; codes and keys stay English") {
    freshFolder();
    writeFile("scene.xml", kRadians);
    const auto messageIn = [](const std::string& flags) {
        const Outcome found = run("validate --json scene.xml " + flags);
        INFO(found.out << found.err);
        CHECK(found.status == 0);
        for (const json& entry : json::parse(found.out)["diagnostics"])
            if (entry["code"] == "scene.radians") return entry["message"].get<std::string>();
        return std::string();
    };
    CHECK_THAT(messageIn(""), Catch::Contains("looks like radians"));
    CHECK(messageIn("--lang en") == messageIn(""));
    CHECK_THAT(messageIn("--lang pt"), Catch::Contains("parece estar em radianos"));
    CHECK_THAT(messageIn("--lang es"), Catch::Contains("parece estar en radianes"));
    CHECK_THAT(messageIn("--lang cs"), Catch::Contains("což vypadá na radiány"));

    const Outcome lines = run("validate --lang pt scene.xml");
    CHECK_THAT(lines.err, Catch::Contains("warning: ") && Catch::Contains("[scene.radians]"));
    CHECK_THAT(lines.out, Catch::Contains("cena válida; modelos: 1"));
}

TEST_CASE("errors of the command line are in the language of --lang, too") {
    freshFolder();
    const Outcome unknown = run("validate --lang es --wrong x.xml");
    CHECK(unknown.status == 2);
    CHECK_THAT(unknown.err, Catch::Contains("no tiene la opción \"--wrong\""));
    const Outcome other = run("validate --lang xx a.xml");
    CHECK(other.status == 2);
    CHECK_THAT(other.err, Catch::Contains("xx is none of en, pt, es, cs"));
    for (const char* command :
         {"render a.xml -o a.png", "generate shpere 1 a.3d", "compare a.png b.png", "grade"}) {
        const Outcome failed = run(std::string(command) + " --lang cs");
        const Outcome english = run(command);
        INFO(command << "\n" << failed.err);
        CHECK(failed.status == english.status);
        CHECK(failed.status != 0);
        CHECK(failed.err != english.err);
    }
}

TEST_CASE("a report of grades is in the language of --lang, with the same points") {
    freshFolder();
    const std::string scene = std::string(kSourceDir) + "/scenes/robot-arm/scene.xml";
    std::filesystem::create_directory(folder() / "class");
    const std::string text = readFile(scene);  // one angle is negated
    std::size_t at = text.find("angle=\"") + 7;
    while (text[at] < '1' || text[at] > '9') at = text.find("angle=\"", at) + 7;
    writeFile("class/rui.xml", text.substr(0, at) + "-" + text.substr(at));
    const auto graded = [&](const std::string& language) {
        const Outcome found = run("grade --jobs 1 --feedback --lang " + language + " --reference " +
                                  scene + " class -o " + language);
        INFO(found.err);
        CHECK(found.status == 0);
        return json::parse(readFile(language + "/report.json"))["submissions"][0];
    };
    const json english = graded("en"), portuguese = graded("pt");
    CHECK(english["points"] == portuguese["points"]);
    const auto findingOf = [](const json& one) { return one["tasks"][0]["grade"]["findings"][0]; };
    CHECK(findingOf(english)["code"] == findingOf(portuguese)["code"]);
    CHECK(findingOf(english)["message"] != findingOf(portuguese)["message"]);
    CHECK_THAT(readFile("pt/report.html"),
               Catch::Contains("\"language\":\"pt\"") && Catch::Contains("Primeira causa"));
    CHECK_THAT(readFile("en/report.html"), !Catch::Contains("Primeira causa"));
    CHECK_THAT(readFile("pt/class.html"), Catch::Contains("<html lang=\"pt\">") &&
                                              Catch::Contains("Erros mais frequentes da turma"));
    CHECK_THAT(readFile("en/class.html"), Catch::Contains("<html lang=\"en\">"));
}
