#include "cli/compare_meshes.h"

#include <filesystem>
#include <iostream>

#include "cli/command.h"
#include "cli/files.h"
#include "cli/messages.h"
#include "core/text.h"
#include "generator/compare/mesh_check.h"
#include "generator/io/mesh_file.h"
#include "generator/registry.h"
#include "scene/files/assets.h"

namespace farol::cli {
namespace {

/// A call whose file, if it takes one, is looked up by its name in `folder`.
struct Call {
    generator::ShapeCall call;
    std::string folder = ".";
};

Call parse(const std::string& shape) {
    try {
        const std::vector<std::string_view> words = split(shape);
        Call out{generator::parseCall({words.begin(), words.end()})};
        if (!out.call.entry->takesFile) return out;
        out.folder = folderOf(out.call.file);
        out.call.file = std::filesystem::path(out.call.file).filename().string();
        return out;
    } catch (const Error& error) {
        throw UsageError(error.primary());
    }
}

int check(const MeshComparison& comparison, const std::string& bytes,
          const generator::Mesh& expected, Report& report) {
    const generator::MeshCheck found = generator::checkMesh(bytes, comparison.file, expected);
    report.setVerbose(true);
    report.add(found.findings);
    report.set("same", found.isRight());
    report.set("triangles", found.triangles);
    report.set("expectedTriangles", found.expectedTriangles);
    report.set("places", found.places);
    report.set("expectedPlaces", found.expectedPlaces);
    if (!report.json())
        std::cout << textIn(
                         report.language(),
                         message<"part.mesh-check/counts">(
                             "file"_arg = uncut(comparison.file), "triangles"_arg = found.triangles,
                             "expected"_arg = found.expectedTriangles, "places"_arg = found.places,
                             "needed"_arg = found.expectedPlaces))
                  << "\n"
                  << textIn(report.language(), found.isRight()
                                                   ? message<"part.mesh-check/same">()
                                                   : message<"part.mesh-check/different">())
                  << std::endl;
    return found.isRight() ? kDone : kInputFault;
}

}  // namespace

bool isMeshComparison(const std::string& file, const std::string& shape) {
    return !shape.empty() || generator::isMeshName(file);
}

int compareMeshes(const MeshComparison& comparison, Report& report) {
    if (comparison.expected.empty() == comparison.shape.empty())
        throw UsageError(message<"usage/compare-mesh">());
    const std::string bytes = readInput(comparison.file);
    report.setInput(comparison.file);
    if (comparison.shape.empty()) {
        const std::string expected = readInput(comparison.expected);
        return confine({comparison.confinement, {}, {}}, report, [&](Outputs&) {
            Diagnostics repairs;
            const generator::Mesh mesh =
                generator::io::decodeMesh(expected, comparison.expected, repairs);
            report.add(repairs);
            return check(comparison, bytes, mesh, report);
        });
    }
    const Call shape = parse(comparison.shape);
    return confine({comparison.confinement, {shape.folder}, {}}, report, [&](Outputs&) {
        return check(comparison, bytes,
                     generator::generate(shape.call, scene::FolderAssets(shape.folder)), report);
    });
}

}  // namespace farol::cli
