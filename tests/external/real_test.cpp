// The kinds of inputs that real groups wrote (../shared/data/real/README.md): what is done with
// each.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "image/image.h"
#include "render/renderer.h"
#include "scene/files/assets.h"
#include "tests/support/paths.h"
#include "tests/support/skip.h"

using namespace farol;
namespace fs = std::filesystem;

namespace {

const fs::path kReal = fs::path(farol::test::kSourceDir) / ".." / "shared" / "data" / "real";

render::Job jobOf(const std::string& file) {
    if (!fs::is_directory(kReal)) farol::test::skip("no folder ../shared/data/real");
    const fs::path path = kReal / file;
    std::ifstream in(path, std::ios::binary);
    REQUIRE(in);
    render::Job job;
    job.name = path.filename().string();
    job.xml = {std::istreambuf_iterator<char>(in), {}};
    job.assets = std::make_shared<scene::FolderAssets>(path.parent_path().string());
    job.options.width = 96;
    job.options.height = 72;
    return job;
}

/// Pixels that are not the background's.
std::size_t drawnPixels(const image::Image& image) {
    std::size_t count = 0;
    for (std::size_t at = 0; at < image.pixels.size(); at += 4)
        count += image.pixels[at] + image.pixels[at + 1] + image.pixels[at + 2] > 0 ? 1 : 0;
    return count;
}

bool has(const Diagnostics& diagnostics, const std::string& code, Severity severity) {
    return std::any_of(diagnostics.begin(), diagnostics.end(), [&](const Diagnostic& one) {
        return one.code == code && one.severity == severity;
    });
}

}  // namespace

TEST_CASE("inputs that students' own engines draw are drawn, with the finding of their slip") {
    struct Row {
        const char* file;
        const char* code;  ///< of a warning, or of an info after "i:"; empty: none is needed
    };
    const Row row = GENERATE(values<Row>({
        {"01-no-camera/scene.xml", "i:scene.camera-start"},
        {"01-no-camera/scene-group.xml", "i:scene.camera-start"},
        {"06-number/accent.xml", "scene.number"},
        {"06-number/comma.xml", "scene.number"},
        {"06-number/decimal.xml", "scene.number"},
        {"06-number/minus.xml", "scene.number"},
        {"07-unknown-attribute/scene.xml", "scene.unknown-attribute"},
        {"07-unknown-attribute/world.xml", "scene.unknown-attribute"},
        {"08-shapes/extra-numbers.xml", "shape.argument"},
        {"08-shapes/portuguese.xml", ""},
        {"08-shapes/torus.xml", "shape.argument"},
        {"08-shapes/two-commands-a-line.xml", "shape.argument"},
        {"09-rotate/empty-axis.xml", "scene.zero-direction"},
        {"09-rotate/zero-axis.xml", ""},
        {"09-rotate/zero-time.xml", "scene.range"},
        {"10-include/scene.xml", ""},
        {"15-two-roots/scene.xml", "xml.extra-root"},
        {"bugs/a17_doctype.xml", "xml.doctype"},
        {"bugs/a17_model.xml", ""},
        {"bugs/a17_xsi.xml", ""},
        {"bugs/a18_decl.xml", ""},
        {"bugs/a18_le.xml", ""},
    }));
    CAPTURE(row.file);
    image::Image image;
    const render::Picture picture = render::Renderer().draw(jobOf(row.file), image);
    CHECK(drawnPixels(image) > 50);
    const std::string code = row.code;
    if (code.starts_with("i:"))
        CHECK(has(picture.diagnostics, code.substr(2), Severity::info));
    else if (!code.empty())
        CHECK(has(picture.diagnostics, code, Severity::warning));
}

TEST_CASE("inputs that are no scene are refused by name") {
    struct Row {
        const char* file;
        const char* code;
    };
    const Row row = GENERATE(values<Row>({{"11-other-language/scene.xml", "scene.foreign"},
                                          {"13-missing-texture/scene.xml", "asset.missing"},
                                          {"16-empty-submission/class/empty.xml", "xml.empty"},
                                          {"bugs/a15_cr.xml", "xml.mismatch"}}));
    CAPTURE(row.file);
    try {
        render::Renderer().render(jobOf(row.file));
        FAIL_CHECK("was rendered");
    } catch (const Error& error) {
        CHECK(error.code() == row.code);
    }
}

TEST_CASE("a missing texture and an unclosed element are drawn round on demand") {
    for (const char* file : {"13-missing-texture/scene.xml", "bugs/a15_cr.xml"}) {
        CAPTURE(file);
        render::Job job = jobOf(file);
        job.options.missing = render::Missing::placeholder;
        image::Image image;
        const render::Picture picture = render::Renderer().draw(job, image);
        CHECK(drawnPixels(image) > 50);
        CHECK(std::any_of(picture.diagnostics.begin(), picture.diagnostics.end(),
                          [](const Diagnostic& one) { return one.severity == Severity::error; }));
    }
}
