#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>

#include "generator/bezier.h"
#include "generator/registry.h"

using namespace farol;
using generator::BezierPatch;
using generator::Fineness;
using glm::dvec3;

namespace {

scene::Model patchModel(const std::string& file) {
    scene::Model model;
    model.source.kind = scene::ModelSource::Kind::shape;
    model.source.shape = generator::parseCall({"patch", file});
    return model;
}

std::string textOf(const std::vector<BezierPatch>& patches) {
    std::string text = std::to_string(patches.size()) + "\n", points;
    for (std::size_t k = 0; k < patches.size(); ++k)
        for (std::size_t i = 0; i < 16; ++i) {
            text += std::to_string(16 * k + i) + (i < 15 ? ", " : "\n");
            char line[96];
            const dvec3& p = patches[k][i];
            std::snprintf(line, sizeof line, "%.17g, %.17g, %.17g\n", p.x, p.y, p.z);
            points += line;
        }
    return text + std::to_string(16 * patches.size()) + "\n" + points;
}

/// De Casteljau: the halves of a cubic.
std::array<std::array<dvec3, 4>, 2> halves(const std::array<dvec3, 4>& p) {
    const dvec3 a = (p[0] + p[1]) / 2.0, b = (p[1] + p[2]) / 2.0, c = (p[2] + p[3]) / 2.0;
    const dvec3 d = (a + b) / 2.0, e = (b + c) / 2.0, m = (d + e) / 2.0;
    return {{{p[0], a, d, m}, {m, e, c, p[3]}}};
}

/// The patch's halves along its rows' direction, or its columns'.
std::array<BezierPatch, 2> split(const BezierPatch& patch, bool rows) {
    std::array<BezierPatch, 2> out{};
    for (std::size_t line = 0; line < 4; ++line) {
        const auto at = [&](std::size_t i) { return rows ? 4 * i + line : 4 * line + i; };
        const auto two = halves({patch[at(0)], patch[at(1)], patch[at(2)], patch[at(3)]});
        for (std::size_t i = 0; i < 4; ++i) {
            out[0][at(i)] = two[0][i];
            out[1][at(i)] = two[1][i];
        }
    }
    return out;
}

BezierPatch randomPatch(std::mt19937& random, double size) {
    std::uniform_real_distribution<double> sideways(-0.4, 0.4), upwards(-1.5, 1.5);
    BezierPatch patch{};
    for (std::size_t i = 0; i < 16; ++i)
        patch[i] = size * dvec3(static_cast<double>(i % 4) + sideways(random), upwards(random),
                                static_cast<double>(i / 4) + sideways(random));
    return patch;
}

/// Distance from `target` to the surface near (s, t) of a grid of 1000: steps to the nearest point
/// of the tangent plane.
double distanceTo(const BezierPatch& patch, const dvec3& target, double s, double t) {
    constexpr double kGrid = 1 << 20;
    const auto step = [](double x) { return static_cast<std::size_t>(std::lround(x * kGrid)); };
    constexpr auto kCount = static_cast<std::size_t>(kGrid);
    double least = 1e300;
    for (int i = 0; i < 8; ++i) {
        const std::size_t column = step(s), row = step(t);
        const dvec3 d = target - generator::positionAt(patch, column, row, kCount, kCount);
        least = std::min(least, glm::length(d));
        const generator::PatchBend bend = generator::bendAt(patch, column, row, kCount, kCount);
        const double uu = glm::dot(bend.u, bend.u), uv = glm::dot(bend.u, bend.v),
                     vv = glm::dot(bend.v, bend.v), det = uu * vv - uv * uv;
        if (!(det > 1e-12 * uu * vv)) break;
        const double before = s;
        s = std::clamp(s + (glm::dot(d, bend.u) * vv - glm::dot(d, bend.v) * uv) / det, 0.0, 1.0);
        // Beside the patch, the nearest point of its outline.
        t = std::clamp(t + glm::dot(d - (s - before) * bend.u, bend.v) / vv, 0.0, 1.0);
        if (t == 0.0 || t == 1.0) s = std::clamp(before + glm::dot(d, bend.u) / uu, 0.0, 1.0);
    }
    return least;
}

/// Largest distance of points of the mesh from the patches, in their order.
double worstDistance(const generator::Mesh& mesh, const std::vector<BezierPatch>& patches) {
    double worst = 0.0;
    // Vertices come patch by patch, each from the corner (1, 1) to the corner (0, 0).
    std::vector<std::size_t> patchOf;
    std::size_t ended = 0;
    for (std::size_t i = 0; i < mesh.uvs().size(); ++i) {
        patchOf.push_back(ended);
        ended += mesh.uvs()[i] == glm::vec2(0.0F) ? 1 : 0;
    }
    for (std::size_t i = 0; i < mesh.indices().size(); i += 3)
        for (const dvec3& w :
             {dvec3(1.0 / 3), dvec3(0.5, 0.5, 0), dvec3(0, 0.5, 0.5), dvec3(0.5, 0, 0.5),
              dvec3(1, 0, 0), dvec3(0.6, 0.2, 0.2), dvec3(0.3, 0.7, 0), dvec3(0.1, 0.3, 0.6)}) {
            dvec3 p(0.0);
            glm::dvec2 uv(0.0);
            for (int c = 0; c < 3; ++c) {
                const std::uint32_t index = mesh.indices()[i + static_cast<std::size_t>(c)];
                p += w[c] * dvec3(mesh.positions()[index]);
                uv += w[c] * glm::dvec2(mesh.uvs()[index]);
            }
            worst = std::max(worst, distanceTo(patches[patchOf[mesh.indices()[i]]],
                                               p + mesh.origin(), 1.0 - uv.x, 1.0 - uv.y));
        }
    return worst;
}

/// Edges of the mesh that belong to one triangle alone, vertices being the same where their
/// positions have the same bits; their middles.
std::vector<dvec3> openEdges(const generator::Mesh& mesh) {
    const auto less = [](const glm::vec3& a, const glm::vec3& b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    using Edge = std::array<glm::vec3, 2>;
    const auto lessEdge = [&](const Edge& a, const Edge& b) {
        return less(a[0], b[0]) || (!less(b[0], a[0]) && less(a[1], b[1]));
    };
    std::map<Edge, int, decltype(lessEdge)> counts(lessEdge);
    for (std::size_t i = 0; i < mesh.indices().size(); i += 3)
        for (std::size_t c = 0; c < 3; ++c) {
            Edge edge{mesh.positions()[mesh.indices()[i + c]],
                      mesh.positions()[mesh.indices()[i + (c + 1) % 3]]};
            if (less(edge[1], edge[0])) std::swap(edge[0], edge[1]);
            ++counts[edge];
        }
    std::vector<dvec3> open;
    for (const auto& [edge, count] : counts)
        if (count == 1) open.push_back((dvec3(edge[0]) + dvec3(edge[1])) / 2.0);
    return open;
}

}  // namespace

TEST_CASE("meshes of open patches err by at most the bound, and by half of it at the median") {
    std::mt19937 random(41);
    std::uniform_real_distribution<double> exponent(-3.0, 3.0), fraction(-3.3, -0.7);
    std::vector<double> shares;
    for (int i = 0; i < 400; ++i) {
        const double size = std::pow(10.0, exponent(random));
        std::vector<BezierPatch> patches{randomPatch(random, size)};
        if (i % 4 == 1) {  // halves: neighbours that join smoothly
            const auto two = split(patches[0], i % 8 == 1);
            patches.assign(two.begin(), two.end());
        }
        if (i % 4 == 2) {  // neighbours with a crease
            patches.push_back(randomPatch(random, size));
            for (std::size_t k = 0; k < 4; ++k) patches[1][k] = patches[0][12 + k];
        }
        const scene::BundleAssets assets({{"p.patch", textOf(patches)}});
        const Fineness fine{size * std::pow(10.0, fraction(random)), 8};
        const auto adapted = generator::adapt(patchModel("p.patch"), assets, fine);
        REQUIRE(adapted);
        const double worst = worstDistance(adapted->mesh, patches);
        CAPTURE(i, size, fine.error, worst, adapted->mesh.triangles());
        // A float of the position holds 6e-8 of the size.
        REQUIRE(worst <= fine.error + 1e-6 * size);
        shares.push_back(worst / fine.error);
    }
    std::sort(shares.begin(), shares.end());
    std::printf("patch, object space: true error / bound: median %.2f, 90 %% %.2f, most %.2f\n",
                shares[200], shares[360], shares[399]);
    CHECK(shares[200] >= 0.5);
}

TEST_CASE("neighbours of open patches meet bit for bit at any error") {
    std::mt19937 random(43);
    const scene::BundleAssets none;
    for (const double error : {0.3, 0.1, 0.03, 0.01, 0.003}) {
        CAPTURE(error);
        // Quarters of a patch: open along its outline alone.
        const BezierPatch whole = randomPatch(random, 1.0);
        std::vector<BezierPatch> quarters;
        for (const BezierPatch& half : split(whole, true))
            for (const BezierPatch& quarter : split(half, false)) quarters.push_back(quarter);
        const scene::BundleAssets assets({{"q.patch", textOf(quarters)}});
        const auto mesh = generator::adapt(patchModel("q.patch"), assets, {error, 8})->mesh;
        const auto divisions =
            generator::adapt(patchModel("q.patch"), assets, {error, 8})->divisions;
        // Two classes along either direction, two opposite outlines each.
        REQUIRE(divisions.size() == 5);
        std::size_t outline = 0;
        for (std::size_t i = 0; i < 4; ++i) outline += 2 * divisions[i];
        CHECK(openEdges(mesh).size() == outline);

        // The teapot is open at the rim of its body, the rim of its lid, and the tip of its spout.
        const auto teapot = generator::adapt(patchModel("teapot.patch"), none, {error, 8});
        const generator::Mesh fixed =
            generator::generate(generator::parseCall({"patch", "teapot.patch", "4"}), none);
        std::vector<dvec3> outlines = openEdges(fixed);
        REQUIRE_FALSE(outlines.empty());
        for (const dvec3& middle : openEdges(teapot->mesh)) {
            double nearest = 1e300;
            for (const dvec3& one : outlines)
                nearest = std::min(nearest, glm::length(one - middle));
            CHECK(nearest < 0.7);
        }
        CHECK(teapot->divisions.size() > 3);
        CHECK(teapot->mesh.triangles() <
              generator::countTriangles(
                  generator::refine(patchModel("teapot.patch"), none, {error, 8}), none));
    }
}

TEST_CASE("a flat patch with bent sides follows them") {
    // In its plane, so that nothing bends along the normal.
    BezierPatch patch{};
    for (std::size_t i = 0; i < 16; ++i) {
        const double x = static_cast<double>(i % 4), z = static_cast<double>(i / 4);
        patch[i] = {x, 0.0, z + (i % 4 == 1 || i % 4 == 2 ? 1.0 : 0.0)};
    }
    const scene::BundleAssets assets({{"f.patch", textOf({patch})}});
    for (const double error : {0.1, 0.01, 0.001}) {
        const auto adapted = generator::adapt(patchModel("f.patch"), assets, {error, 8});
        CAPTURE(error, adapted->mesh.triangles());
        CHECK(worstDistance(adapted->mesh, {patch}) <= error);
        CHECK(adapted->mesh.triangles() <= static_cast<std::size_t>(4.0 / std::sqrt(error)) + 4);
    }
}
