// api/scene.xsd and docs/scene-language.md against the reader's tables, and the schema against
// the example scenes by xmllint.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/text.h"
#include "scene/read/tables.h"
#include "tests/support/paths.h"
#include "tests/support/skip.h"
#include "tests/unit/scene/reading.h"

using namespace farol::scene;
using namespace farol::scene::test;
namespace fs = std::filesystem;

namespace {

const fs::path kSource = farol::test::kSourceDir;

std::string readFile(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void requireXmllint() {
    if (!farol::test::hasProgram("xmllint"))
        farol::test::skipMissing("no xmllint (package libxml2-utils)");
}

bool validates(const fs::path& file) {
    const std::string command = "xmllint --noout --schema '" +
                                (kSource / "api" / "scene.xsd").string() + "' '" + file.string() +
                                "' > /dev/null 2>&1";
    return std::system(command.c_str()) == 0;
}

bool validatesText(const std::string& xml) {
    fs::create_directories(farol::test::kTestOutput);
    const fs::path file =
        fs::path(farol::test::kTestOutput) / ("schema-" + std::to_string(getpid()) + ".xml");
    std::ofstream(file, std::ios::binary) << xml;
    const bool good = validates(file);
    fs::remove(file);
    return good;
}

/// The text of one complexType of the schema.
std::string typeOf(const std::string& schema, std::string_view element) {
    std::string name(element);
    name[0] = static_cast<char>(name[0] - 'a' + 'A');
    const std::size_t begin = schema.find("complexType name=\"" + name + "\"");
    if (begin == std::string::npos) return {};
    return schema.substr(begin, schema.find("</xs:complexType>", begin) - begin);
}

/// The section of one element in the reference.
std::string sectionOf(const std::string& docs, std::string_view element) {
    const std::string heading = element == "namedColor" ? std::string("### `<color> in <colors>`")
                                                        : "### `<" + std::string(element) + ">`";
    const std::size_t begin = docs.find("\n" + heading);
    if (begin == std::string::npos) return {};
    return docs.substr(begin, docs.find("\n##", begin + 1) - begin);
}

}  // namespace

TEST_CASE("schema and reference have every element and attribute of the tables") {
    const std::string schema = readFile(kSource / "api" / "scene.xsd");
    const std::string docs = readFile(kSource / "docs" / "scene-language.md");
    for (const ElementSpec& element : elementSpecs()) {
        INFO("element " << element.name);
        const bool plain = element.name == "title" || element.name == "description";
        const std::string type = typeOf(schema, element.name);
        CHECK((plain || !type.empty()));
        const std::string section = sectionOf(docs, element.name);
        CHECK_FALSE(section.empty());
        for (const std::string_view child : farol::split(element.children)) {
            const std::string name = child == "namedColor" ? "color" : std::string(child);
            INFO("child " << name);
            CHECK(type.find("element name=\"" + name + "\"") != std::string::npos);
        }
        // These are reported together with their like.
        const bool asOthers = isAmong("lookAt up ambient specular emissive", element.name);
        for (const AttributeSpec& attribute : element.attributes) {
            INFO("attribute " << attribute.name);
            const std::string name(attribute.name);
            CHECK(type.find("attribute name=\"" + name + "\"") != std::string::npos);
            CHECK((asOthers || section.find("| `" + name + "` |") != std::string::npos));
        }
    }
}

TEST_CASE("the schema accepts what the reader takes without a word, and no more") {
    requireXmllint();
    const std::string good[] = {
        "<world/>",
        "<scene/>",
        world("<window width=\"1\" height=\"4096\"/><title>t</title>"),
        camera("<position x=\"1\" y=\".5\" z=\"-1e3\"/><lookAt x=\"0\"/><up y=\"1\"/>"
               "<projection fov=\"60\" near=\"1\" far=\"1000\"/>"),
        light("type=\"spot\" posx=\"1\" dirx=\"1\" cutoff=\"45\""),
        light("type=\"POINT\" posX=\"1\""),
        transform("<rotate angle=\"90\" x=\"1\"/><translate time=\"3\" align=\"True\">"
                  "<point x=\"1\"/><point x=\"2\"/><point x=\"3\"/><point x=\"4\"/></translate>"),
        model("<texture file=\"a.jpg\"/><color><diffuse R=\"000\" G=\"255\" B=\"1\"/></color>"),
        group("<scatter count=\"3\" xzMin=\"1\" xzMax=\"2\"/><group/>"),
        "<scene><colors><color name=\"c\" r=\"1\"/></colors></scene>",
    };
    const std::string bad[] = {
        "<html/>",
        "<world>",
        world("text"),
        world("<grop/>"),
        world("<window width=\"0\"/>"),
        world("<window width=\"5000\"/>"),
        world("<window widht=\"50\"/>"),
        camera("<projection fov=\"0\"/>"),
        camera("<projection near=\"-1\"/>"),
        light("type=\"laser\""),
        transform("<translate x=\"a\"/>"),
        transform("<translate x=\"1,5\"/>"),
        transform("<translate x=\"NaN\"/>"),
        transform("<translate w=\"4\"/>"),
        model("<color><diffuse R=\"256\"/></color>"),
        world("<point x=\"1\"/>"),
    };
    for (const std::string& xml : good) {
        INFO(xml);
        CHECK(validatesText(xml));
        CHECK(tryRead(xml).scene);
    }
    for (const std::string& xml : bad) {
        INFO(xml);
        CHECK_FALSE(validatesText(xml));
        CHECK_FALSE(tryRead(xml).diagnostics.empty());
    }
}

TEST_CASE("every example scene is valid by the schema") {
    requireXmllint();
    int scenes = 0;
    for (const auto& folder : fs::directory_iterator(kSource / "scenes")) {
        if (!folder.is_directory() || folder.path().filename() == "refused") continue;
        for (const auto& entry : fs::directory_iterator(folder)) {
            if (entry.path().extension() != ".xml") continue;
            ++scenes;
            INFO(entry.path().filename());
            CHECK(validates(entry.path()));
        }
    }
    CHECK(scenes >= 10);
}
