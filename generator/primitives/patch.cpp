#include "generator/primitives/patch.h"

#include <algorithm>
#include <cmath>

#include "generator/bezier.h"
#include "generator/builder.h"
#include "generator/io/raw_mesh.h"

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

/// Divisions a side that keep every patch of the file within the error: one number for all, so
/// that neighbours do not crack. Filip, Magedson and Markot, "Surface algorithms using bounds on
/// derivatives", 1986: err <= (Muu/nu^2 + 2 Muv/(nu nv) + Mvv/nv^2) / 8.
double patchDivisions(const io::PatchFile& file, const Fineness& fineness) {
    double worst = 0.0;
    for (std::size_t k = 0; k < file.patches.size(); ++k) {
        const BezierPatch p = controlOf(file, k);
        double uu = 0.0, vv = 0.0, uv = 0.0;
        const auto at = [&](std::size_t row, std::size_t column) { return p[4 * row + column]; };
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < 2; ++j) {
                uu = std::max(uu, glm::length(at(i, j) - 2.0 * at(i, j + 1) + at(i, j + 2)));
                vv = std::max(vv, glm::length(at(j, i) - 2.0 * at(j + 1, i) + at(j + 2, i)));
            }
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                uv = std::max(
                    uv, glm::length(at(i + 1, j + 1) - at(i + 1, j) - at(i, j + 1) + at(i, j)));
        worst = std::max(worst, 6.0 * uu + 6.0 * vv + 2.0 * 9.0 * uv);
    }
    if (!(worst > 0.0)) return 1.0;  // all flat
    // A patch of such models spans a quarter of a turn.
    const double divisions = std::ceil(std::sqrt(worst / (8.0 * fineness.error)));
    return roundUpToStep(std::clamp(divisions, fineness.fullTurn / 4.0, kMaxDivisions / 4.0));
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
    for (std::size_t k = 0; k < file.patches.size(); ++k) {
        BezierPatch control = controlOf(file, k);
        for (glm::dvec3& point : control) point -= origin;
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

ShapeEntry patchEntry() {
    return {.name = "patch",
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
                    return std::vector<double>{
                        patchDivisions(io::parsePatchFile(bytes, call.file), fineness)};
                }};
}

}  // namespace farol::generator::primitives
