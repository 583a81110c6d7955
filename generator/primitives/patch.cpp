#include "generator/primitives/patch.h"

#include "generator/bezier.h"
#include "generator/builder.h"

namespace farol::generator::primitives {
namespace {

BezierPatch controlOf(const io::PatchFile& file, std::size_t index) {
    BezierPatch control{};
    for (std::size_t k = 0; k < 16; ++k) control[k] = file.points[file.patches[index][k]];
    return control;
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
    for (std::size_t k = 0; k < file.patches.size(); ++k) {
        const BezierPatch control = controlOf(file, k);
        const std::uint32_t base = builder.next();
        for (std::size_t row = 0; row <= level; ++row) {
            for (std::size_t column = 0; column <= level; ++column) {
                const PatchPoint point = evaluate(control, column, row, level);
                builder.vertex(point.position, point.normal,
                               {fraction(level - column, level), fraction(level - row, level)});
            }
        }
        const auto at = [base, side](std::size_t row, std::size_t column) {
            return base + static_cast<std::uint32_t>(row * side + column);
        };
        for (std::size_t i = 0; i < level; ++i) {
            for (std::size_t j = 0; j < level; ++j) {
                builder.triangleUnlessFlat(at(i, j), at(i, j + 1), at(i + 1, j));
                builder.triangleUnlessFlat(at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
            }
        }
    }
    return builder.take();
}

Entry patchEntry() {
    return {{"patch",
             "bicubic Bezier patches from a .patch file (teapot.patch is built in)",
             {levelArgument("LEVEL", 1, kDefaultPatchLevel, "divisions a side of each patch")},
             0,
             true,
             {"bezier"}},
            [](const Call& call, const std::string& bytes, scene::UvLayout) {
                return patch(io::parsePatchFile(bytes, call.file), call.count(0));
            },
            [](const Call& call, const std::string& bytes) {
                return patchTriangles(io::parsePatchFile(bytes, call.file), call.count(0));
            }};
}

}  // namespace farol::generator::primitives
