#include "generator/primitives/patch.h"

#include <algorithm>

#include "generator/bezier.h"
#include "generator/builder.h"
#include "generator/io/raw_mesh.h"
#include "generator/messages.h"
#include "generator/primitives/patch_fit.h"

namespace farol::generator::primitives {
namespace {

BezierPatch controlOf(const io::PatchFile& file, std::size_t index) {
    BezierPatch control{};
    for (std::size_t k = 0; k < 16; ++k) control[k] = file.points[file.patches[index][k]];
    return control;
}

/// All patches, less an origin.
std::vector<BezierPatch> controlsOf(const io::PatchFile& file, const glm::dvec3& origin) {
    std::vector<BezierPatch> controls;
    for (std::size_t k = 0; k < file.patches.size(); ++k) {
        controls.push_back(controlOf(file, k));
        for (glm::dvec3& point : controls.back()) point -= origin;
    }
    return controls;
}

/// How many of the four edges are a single point: each folds `level` triangles.
std::size_t collapsedEdges(const BezierPatch& p) {
    std::size_t count = 0;
    for (const auto& [a, b, c, d] :
         {std::array<std::size_t, 4>{0, 1, 2, 3}, {12, 13, 14, 15}, {0, 4, 8, 12}, {3, 7, 11, 15}})
        count += p[a] == p[b] && p[b] == p[c] && p[c] == p[d] ? 1 : 0;
    return count;
}

}  // namespace

std::size_t patchTriangles(const io::PatchFile& file, std::size_t level) {
    std::size_t total = 0;
    for (std::size_t i = 0; i < file.patches.size(); ++i) {
        const std::size_t folded = level * collapsedEdges(controlOf(file, i));
        total += 2 * level * level - std::min(2 * level * level, folded);
    }
    return total;
}

Mesh patch(const io::PatchFile& file, std::size_t level) {
    const std::size_t side = level + 1;
    Builder builder(file.patches.size() * side * side, patchTriangles(file, level));
    const glm::dvec3 origin = io::originOf(file.points);
    builder.origin(origin);
    for (const BezierPatch& control : controlsOf(file, origin))
        addGrid(builder, PatchGrid(control, {level, level}));
    return builder.take();
}

Mesh adaptedPatch(const io::PatchFile& file, const Fineness& fineness,
                  std::vector<std::size_t>& divisions) {
    const glm::dvec3 origin = io::originOf(file.points);
    const std::vector<BezierPatch> controls = controlsOf(file, origin);
    Fineness balanced = fineness;
    balanced.balanced = true;
    PatchLevels levels(controls, balanced);
    const std::vector<PatchGrid> grids = fittedGrids(controls, balanced, levels);
    if (grids.empty()) levels = PatchLevels(controls, fineness);
    const std::size_t triangles = levels.triangles();
    if (triangles > kMaxTriangles)
        throw Error(message<"limit.triangles/shape">("shape"_arg = "patch", "count"_arg = triangles,
                                                     "most"_arg = kMaxTriangles));
    divisions = levels.all();
    divisions.push_back(grids.empty() ? 0 : 1);
    Builder builder(triangles, triangles);
    builder.origin(origin);
    for (const PatchGrid& grid : grids) addGrid(builder, grid);
    if (grids.empty())
        for (std::size_t k = 0; k < controls.size(); ++k)
            addGrid(builder, PatchGrid(controls[k], levels.of(k)));
    return builder.take();
}

ShapeEntry patchEntry() {
    return {
        .name = "patch",
        .aliases = {"bezier"},
        .summary = "bicubic Bezier patches from a .patch file (teapot.patch is built in)",
        .arguments = {levelArgument("LEVEL", 1, kDefaultPatchLevel,
                                    "divisions a side of each patch")},
        .takesFile = true,
        .fileEnding = ".patch",
        .builtinFile = "teapot.patch",
        .generate =
            [](const ShapeCall& call, const std::string& bytes, scene::UvLayout) {
                return patch(io::parsePatchFile(bytes, call.file), call.count(0));
            },
        .count =
            [](const ShapeCall& call, const std::string& bytes) {
                return patchTriangles(io::parsePatchFile(bytes, call.file), call.count(0));
            },
        .bound =
            [](const ShapeCall& call, const std::string& bytes, const Fineness& fineness) {
                const io::PatchFile file = io::parsePatchFile(bytes, call.file);
                const PatchLevels levels(controlsOf(file, io::originOf(file.points)), fineness);
                return std::vector<double>{roundUpToStep(static_cast<double>(levels.greatest()))};
            },
        .adapt =
            [](const ShapeCall& call, const std::string& bytes, const Fineness& fineness,
               std::vector<std::size_t>& divisions) {
                return adaptedPatch(io::parsePatchFile(bytes, call.file), fineness, divisions);
            }};
}

}  // namespace farol::generator::primitives
