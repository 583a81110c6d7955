#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <regex>
#include <set>
#include <sstream>

#include "image/image_file.h"
#include "render/options.h"
#include "render/renderer.h"
#include "tests/support/paths.h"
#include "tests/support/skip.h"

// Compares docs/scene-language.md with its examples, and these with the schema, the renderer and
// the images that scripts/docs-pictures made of them.
using namespace farol;
namespace fs = std::filesystem;

namespace {

const fs::path kSource(farol::test::kSourceDir);
const fs::path kDocs = kSource / "docs";

std::string readFile(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// One blank for any run of white space, none at the ends.
std::string squeezed(const std::string& text) {
    std::istringstream in(text);
    std::string all;
    for (std::string word; in >> word;) all += (all.empty() ? "" : " ") + word;
    return all;
}

std::vector<std::smatch> matches(const std::string& text, const std::regex& what) {
    return {std::sregex_iterator(text.begin(), text.end(), what), std::sregex_iterator()};
}

std::vector<fs::path> examples() {
    std::vector<fs::path> all;
    for (const auto& entry : fs::directory_iterator(kDocs / "examples"))
        if (entry.path().extension() == ".xml") all.push_back(entry.path());
    std::sort(all.begin(), all.end());
    return all;
}

bool isPart(const std::string& xml) { return xml.rfind("<!-- part of ", 0) == 0; }

struct Drawing {
    std::string name, options;
};

/// The settings in the comments at an example's head, as scripts/docs-pictures reads them.
std::vector<Drawing> drawings(const std::string& name, const std::string& xml) {
    static const std::regex kPicture(R"(<!-- picture ([a-z0-9-]+):(.*) -->)");
    static const std::regex kOptions(R"(<!-- options:(.*) -->)");
    std::vector<Drawing> all;
    for (const std::smatch& one : matches(xml, kPicture)) all.push_back({one[1], one[2]});
    std::smatch options;
    if (all.empty())
        all.push_back({name, std::regex_search(xml, options, kOptions) ? options[1].str() : ""});
    return all;
}

render::Job jobOf(const fs::path& example, const std::string& xml, const std::string& options) {
    render::Job job;
    job.name = example.filename().string();
    job.xml = xml;
    job.assets = std::make_shared<scene::FolderAssets>(example.parent_path().string());
    job.strict = true;
    if (xml.find("<window") == std::string::npos) {
        job.options.width = 240;
        job.options.height = 180;
    }
    std::istringstream words(options);
    for (std::string word; words >> word;) {
        const std::size_t equals = word.find('=');
        REQUIRE(equals != std::string::npos);
        render::applyOption(job.options, word.substr(0, equals), word.substr(equals + 1));
    }
    return job;
}

/// Returns the share of pixels that differ by more than 2 levels in some channel.
double shareOff(const image::Image& a, const image::Image& b) {
    REQUIRE(a.width == b.width);
    REQUIRE(a.height == b.height);
    std::size_t off = 0;
    for (std::size_t i = 0; i < a.pixels.size(); i += 4) {
        int most = 0;
        for (std::size_t c = 0; c < 3; ++c)
            most = std::max(most, std::abs(int{a.pixels[i + c]} - int{b.pixels[i + c]}));
        off += most > 2 ? 1 : 0;
    }
    return static_cast<double>(off) * 4.0 / static_cast<double>(a.pixels.size());
}

std::string reference() { return readFile(kDocs / "scene-language.md"); }

}  // namespace

TEST_CASE("every example of the documentation renders strictly and looks as its picture shows") {
    render::Renderer renderer;
    std::set<std::string> drawn;
    for (const fs::path& example : examples()) {
        const std::string xml = readFile(example);
        CAPTURE(example.filename().string());
        if (isPart(xml)) continue;  // drawn by the example that its comment names
        for (const Drawing& drawing : drawings(example.stem().string(), xml)) {
            CAPTURE(drawing.name);
            CHECK(drawn.insert(drawing.name).second);
            const fs::path path = kDocs / "pictures" / (drawing.name + ".png");
            REQUIRE(fs::exists(path));
            const render::Picture made = renderer.render(jobOf(example, xml, drawing.options));
            for (const Diagnostic& finding : made.diagnostics)
                CHECK(finding.severity == Severity::info);
            const image::Image want = image::decodeImage(readFile(path), drawing.name);
            const image::Image have = image::decodeImage(made.bytes, drawing.name);
            // Other processors' software GL rounds differently: up to 2 levels, and in one pixel of
            // a thousand more.
            const double off = shareOff(want, have);
            if (off > 0.001) {
                fs::create_directories(farol::test::kTestOutput);
                std::ofstream(
                    fs::path(farol::test::kTestOutput) / ("docs-" + drawing.name + ".png"),
                    std::ios::binary)
                    << made.bytes;
            }
            CHECK(off <= 0.001);  // else look at it, and run scripts/docs-pictures
        }
    }
    CHECK(drawn.size() > 90);
    for (const auto& entry : fs::directory_iterator(kDocs / "pictures")) {
        INFO(entry.path().filename().string() << " is of no example");
        CHECK(drawn.count(entry.path().stem().string()) == 1);
    }
}

TEST_CASE("scripts/docs-pictures renders the examples that its arguments name") {
    const fs::path out = fs::path(farol::test::kTestOutput) / "docs-pictures";
    fs::remove_all(out);
    const auto runs = [&](const std::string& names) {
        return std::system((std::string("FAROL='") + farol::test::kProgram + "' '" +
                            (kSource / "scripts" / "docs-pictures").string() + "' '" +
                            out.string() + "' " + names + " > /dev/null 2>&1")
                               .c_str()) == 0;
    };
    CHECK(runs("aa window"));
    std::set<std::string> made;
    for (const auto& entry : fs::directory_iterator(out)) {
        const std::string name = entry.path().filename().string();
        made.insert(name);
        CHECK(shareOff(image::decodeImage(readFile(entry.path()), name),
                       image::decodeImage(readFile(kDocs / "pictures" / name), name)) <= 0.001);
    }
    CHECK(made == std::set<std::string>{"aa-1.png", "aa-8.png", "window.png"});
    CHECK_FALSE(runs("no-such-example"));
}

TEST_CASE("every example of the documentation is valid by the schema") {
    if (!test::hasProgram("xmllint")) test::skipMissing("no xmllint (package libxml2-utils)");
    std::string files;
    for (const fs::path& example : examples()) files += " '" + example.string() + "'";
    const fs::path log = fs::path(farol::test::kTestOutput) / "docs-schema.txt";
    fs::create_directories(farol::test::kTestOutput);
    const int status =
        std::system(("xmllint --noout --schema '" + (kSource / "api" / "scene.xsd").string() + "'" +
                     files + " > '" + log.string() + "' 2>&1")
                        .c_str());
    INFO(readFile(log));
    CHECK(status == 0);
}

TEST_CASE("the reference shows each example and image, and describes them") {
    const std::string text = reference();
    std::set<std::string> named;
    static const std::regex kFile(R"(\]\(((?:examples|pictures)/[^)]+)\))");
    for (const std::smatch& link : matches(text, kFile)) {
        INFO(link[1]);
        CHECK(fs::exists(kDocs / link[1].str()));
        named.insert(link[1]);
    }
    for (const fs::path& example : examples()) {
        INFO(example.filename().string() << " is not in the reference");
        const bool shown = named.count("examples/" + example.filename().string()) == 1 ||
                           named.count("pictures/" + example.stem().string() + ".png") == 1;
        CHECK(shown);
    }
    for (const auto& entry : fs::directory_iterator(kDocs / "pictures")) {
        INFO(entry.path().filename().string() << " is not in the reference");
        CHECK(named.count("pictures/" + entry.path().filename().string()) == 1);
    }
    // The code in a cell is part of the example that the cell's last link names.
    static const std::regex kCell(R"(\|([^|\n]*)\[xml\]\(examples/([a-z0-9-]+\.xml)\))");
    static const std::regex kCode(R"(`([^`]+)`)");
    int fragments = 0;
    for (const std::smatch& cell : matches(text, kCell)) {
        const std::string xml = squeezed(readFile(kDocs / "examples" / cell[2].str()));
        const std::string caption = cell[1];
        for (const std::smatch& code : matches(caption, kCode)) {
            INFO(code[1] << " is not in " << cell[2]);
            CHECK(xml.find(squeezed(code[1])) != std::string::npos);
            ++fragments;
        }
    }
    CHECK(fragments > 100);
    // Whole blocks are parts of some example.
    static const std::regex kBlock("```xml\n([^`]*)```");
    for (const std::smatch& block : matches(text, kBlock)) {
        const std::string snippet = squeezed(block[1]);
        INFO(snippet);
        bool found = false;
        for (const fs::path& example : examples())
            found = found || squeezed(readFile(example)).find(snippet) != std::string::npos;
        CHECK(found);
    }
}

TEST_CASE("every element in the reference has a picture") {
    const std::set<std::string> kNothingToSee{"### `<title>`", "### `<description>`"};
    std::istringstream in(reference());
    std::string heading;
    bool shown = true;
    int elements = 0;
    const auto close = [&] {
        INFO(heading);
        CHECK((shown || kNothingToSee.count(heading) == 1));
    };
    for (std::string line; std::getline(in, line);) {
        if (line.rfind("##", 0) == 0) {
            close();
            const bool element = line.rfind("### `<", 0) == 0;
            elements += element ? 1 : 0;
            heading = line;
            shown = !element;
        }
        shown = shown || line.find("](pictures/") != std::string::npos;
    }
    close();
    CHECK(elements > 35);
}
