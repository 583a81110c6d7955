// farol schema, and the committed files that scripts/generate makes with it.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "run.h"
#include "tests/support/paths.h"

using namespace farol::test;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

const fs::path kSource = farol::test::kSourceDir;

std::string bytesOf(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

json tables() {
    const Outcome found = run("schema --json");
    REQUIRE(found.status == 0);
    return json::parse(found.out);
}

/// The row of that name.
json rowOf(const json& rows, const std::string& name) {
    for (const json& row : rows)
        if (row.at("name") == name) return row;
    FAIL("no row " << name);
    return {};
}

}  // namespace

TEST_CASE("generated files are current") {
    const fs::path out = fs::path(farol::test::kTestOutput) / "generated";
    fs::remove_all(out);
    const std::string command = std::string("FAROL='") + farol::test::kProgram + "' '" +
                                (kSource / "scripts" / "generate").string() + "' '" + out.string() +
                                "' > /dev/null 2>&1";
    REQUIRE(std::system(command.c_str()) == 0);
    std::set<std::string> written;
    for (const auto& entry : fs::recursive_directory_iterator(out)) {
        if (!entry.is_regular_file()) continue;
        const fs::path name = fs::relative(entry.path(), out);
        written.insert(name.string());
        INFO(name << " is not current: run scripts/generate");
        CHECK((bytesOf(entry.path()) == bytesOf(kSource / name)));
    }
    for (const char* name :
         {"api/scene.xsd", "api/rubric.schema.json", "api/schema.json", "api/openapi.yaml",
          "api/errors.md", "docs/grading.md", "docs/scene-language.md", "docs/reference/http.md",
          "docs/reference/settings.md"})
        CHECK(written.count(name) == 1);
}

TEST_CASE("schema lists the messages with their samples") {
    const json all = json::parse(run("schema --messages").out);
    REQUIRE(all.size() > 150);
    const json row = *std::find_if(all.begin(), all.end(), [](const json& entry) {
        return entry.at("id") == "option.range/number";
    });
    CHECK(row.at("code") == "option.range");
    CHECK(row.at("samples").at("max") == "65535");
    CHECK(row.at("example") == "port is \"70000\"; expected a whole number in 0 to 65535");
}

TEST_CASE("schema prints one form at a time") {
    CHECK(run("schema").status == 2);
    CHECK(run("schema --xsd --json").status == 2);
    CHECK(run("schema --xsd").out.rfind("<?xml", 0) == 0);
    const Outcome table = run("schema --markdown settings");
    CHECK(table.status == 0);
    CHECK(table.out.find("| `--max-body` | `FAROL_MAX_BODY` |") != std::string::npos);
    const Outcome unknown = run("schema --markdown element-lihgt");
    CHECK(unknown.status == 2);
    CHECK(unknown.err.find("did you mean \"element-light\"?") != std::string::npos);
    CHECK(run("schema --openapi nothing").err.find("expected one of") != std::string::npos);
}

TEST_CASE("the JSON form has every table") {
    const json all = tables();
    const json light = rowOf(all.at("elements"), "light");
    const json cutoff = rowOf(light.at("attributes"), "cutoff");
    CHECK(cutoff.at("aliases") == json({"cut", "cutoffAngle", "spotCutoff"}));
    CHECK(cutoff.at("max") == 180);
    CHECK(rowOf(light.at("attributes"), "type").at("words").at(1) ==
          json({"directional", "direction", "dir", "sun"}));
    CHECK(rowOf(all.at("shapes"), "cone").at("arguments").at(0).at("name") == "RADIUS");
    CHECK(rowOf(all.at("formats"), "jpeg").at("endings") == json({"jpg", "jpeg"}));
    CHECK(rowOf(all.at("options"), "fov").at("max") == 179);
    CHECK(rowOf(all.at("options"), "format").at("words").size() == all.at("formats").size());
    CHECK(all.at("rubric").at("properties").contains("criteria"));
    CHECK(rowOf(all.at("settings"), "deadline").at("default") == "10");
}

TEST_CASE("the help has each option and setting of the tables") {
    const json all = tables();
    const std::string render = run("render --help").out, serve = run("serve --help").out;
    for (const json& option : all.at("options"))
        CHECK(render.find("--" + option.at("name").get<std::string>() + " ") != std::string::npos);
    for (const json& setting : all.at("settings")) {
        CHECK(serve.find(setting.at("flag").get<std::string>()) != std::string::npos);
        CHECK(serve.find("(Env:" + setting.at("environment").get<std::string>() + ")") !=
              std::string::npos);
    }
}
