// Files where real groups lay them, from folders and archives of others (../shared/data/real).
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "core/text.h"
#include "generator/registry.h"
#include "scene/files/archive.h"
#include "scene/read/reader.h"
#include "tests/support/paths.h"
#include "tests/support/skip.h"

using namespace farol;
namespace fs = std::filesystem;

namespace {

const fs::path kReal = fs::path(farol::test::kSourceDir) / ".." / "shared" / "data" / "real";

std::shared_ptr<const scene::Assets> open(const fs::path& path) {
    if (fs::is_directory(path)) return std::make_shared<scene::FolderAssets>(path.string());
    std::ifstream in(path, std::ios::binary);
    return std::make_shared<scene::ArchiveAssets>(
        std::make_shared<const std::string>(std::string{std::istreambuf_iterator<char>(in), {}}));
}

/// The files that the scene takes, then the codes of what is not an info.
std::string foundIn(const scene::Assets& assets, const std::string& document) {
    scene::ReadOptions options;
    options.name = "shown.xml";  // as a command line shows another path than the archive's
    options.path = document;
    scene::ReadResult result = scene::read(assets.read(document).value_or(""), options, assets);
    generator::resolve(result.scene, assets, result.diagnostics);
    std::string found;
    for (const scene::Group& group : result.scene.groups)
        for (const scene::Model& model : group.models)
            found += model.source.path + (model.texture ? model.texture->path : "") + " ";
    for (const Diagnostic& one : result.diagnostics)
        if (one.severity != Severity::info) found += one.code + " ";
    return std::string(trimmed(found));
}

}  // namespace

TEST_CASE("real groups' files are found where they are, in folders and archives alike") {
    if (!fs::is_directory(kReal)) test::skip("no folder ../shared/data/real");
    struct Row {
        const char *project, *document, *found;
    };
    for (const Row& row : {Row{"02-beside", "part2/scene.xml", "part2/leaf.3d"},
                           Row{"03-suffix", "work/files/scene.xml", "work/files/skin.png"},
                           Row{"14-sibling", "scenes/scene.xml", "meshes/cone.3d"}}) {
        INFO(row.project);
        const auto folder = open(kReal / row.project);
        const auto zip = open(kReal / (std::string(row.project) + ".zip"));
        CHECK(foundIn(*folder, row.document) == row.found);
        CHECK(foundIn(*zip, row.document) == row.found);
        CHECK(scene::mainOf(*zip) == row.document);
    }
}

TEST_CASE("a mesh outside the scene's folder names --assets") {
    if (!fs::is_directory(kReal)) test::skip("no folder ../shared/data/real");
    CHECK(foundIn(*open(kReal / "14-sibling" / "scenes"), "scene.xml") ==
          "asset.outside shape.guessed");
}
