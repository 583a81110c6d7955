#include <catch2/catch.hpp>

#include "generator/bezier.h"
#include "generator/io/patch_file.h"
#include "tests/unit/generator/checks.h"

using namespace checks;
using farol::generator::BezierPatch;
using farol::generator::evaluate;

TEST_CASE("a patch of a plane is that plane, with its texture and split") {
    std::ostringstream file;
    file << "1\n0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15\n16\n";
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) file << column << ", " << row << ", 5\n";
    const Mesh mesh =
        farol::generator::generate(farol::generator::parseCall({"patch", "p.patch", "3"}),
                                   farol::scene::BundleAssets({{"p.patch", file.str()}}));
    REQUIRE(mesh.positions().size() == 16);
    for (std::size_t i = 0; i < 16; ++i) {
        const glm::vec3 p = mesh.positions()[i];
        CHECK(glm::distance(p, glm::vec3(i % 4, i / 4, 5)) < 1e-6F);
        CHECK(glm::distance(mesh.normals()[i], glm::vec3(0, 0, 1)) < 1e-6F);
        CHECK(glm::distance(mesh.uvs()[i], glm::vec2(1 - p.x / 3, 1 - p.y / 3)) < 1e-6F);
    }
    // (row i, column j+1) to (row i+1, column j)
    CHECK(mesh.indices()[0] == 0);
    CHECK(mesh.indices()[1] == 1);
    CHECK(mesh.indices()[2] == 4);
    CHECK(volume(mesh) == Approx(15));  // counter-clockwise seen from +Z: column x row
}

TEST_CASE("the teapot has faces with an area and normals that agree with them") {
    const Mesh mesh = make("patch teapot.patch 8");
    CHECK(area(mesh) > 10);
    for (std::size_t t = 0; t < mesh.triangles(); ++t) {
        const auto [a, b, c] = corners(mesh, t);
        const dvec3 n = glm::cross(b - a, c - a);
        REQUIRE(glm::length(n) > 0);
        for (std::size_t k = 0; k < 3; ++k) {
            const dvec3 vertex(mesh.normals()[mesh.indices()[3 * t + k]]);
            CHECK(std::abs(glm::length(vertex) - 1) < 1e-6);
            // Coarse faces at the spout's tip lean up to 75 degrees; none looks the wrong way.
            CHECK(glm::dot(vertex, glm::normalize(n)) > 0.2);
        }
    }
    // The lid's top and the bottom's middle are single points: straight up and down.
    for (std::size_t i = 0; i < mesh.positions().size(); ++i) {
        if (glm::distance(mesh.positions()[i], glm::vec3(0, 0, 3.15F)) < 1e-6F)
            CHECK(glm::distance(mesh.normals()[i], glm::vec3(0, 0, 1)) < 1e-5F);
        if (glm::distance(mesh.positions()[i], glm::vec3(0)) < 1e-6F)
            CHECK(glm::distance(mesh.normals()[i], glm::vec3(0, 0, -1)) < 1e-5F);
    }
}

TEST_CASE("neighbouring patches meet bit for bit, whichever way their edge runs") {
    BezierPatch a{}, b{};
    for (std::size_t k = 0; k < 16; ++k) {
        a[k] = {0.1 * static_cast<double>(k % 4), 0.3 * static_cast<double>(k / 4),
                0.07 * static_cast<double>(k * k % 11)};
        b[k] = a[k] + dvec3(9);
    }
    for (std::size_t k = 0; k < 4; ++k) b[4 * k] = a[12 + 3 - k];  // a's last row, reversed
    for (std::size_t i = 0; i <= 7; ++i)
        CHECK(evaluate(a, i, 7, 7, 7).position == evaluate(b, 0, 7 - i, 7, 7).position);
}

TEST_CASE("normals at a collapsed edge are the limit from inside") {
    // A quarter of a paraboloid-like cap: the first row is one point.
    BezierPatch cap{};
    const double k = 0.55228474983;
    const dvec3 rim[4] = {{1, 0, 0}, {1, -k, 0}, {k, -1, 0}, {0, -1, 0}};
    for (std::size_t c = 0; c < 4; ++c) {
        cap[c] = {0, 0, 1};
        cap[4 + c] = dvec3(0, 0, 1) + rim[c] * 0.3;
        cap[8 + c] = dvec3(0, 0, 0.6) + rim[c] * 0.8;
        cap[12 + c] = rim[c];
    }
    for (std::size_t c = 0; c <= 8; ++c) {
        const dvec3 atPole = evaluate(cap, c, 0, 8, 8).normal;
        const dvec3 nearby = evaluate(cap, c * 100, 1, 800, 800).normal;
        CHECK(glm::length(atPole - dvec3(0, 0, 1)) < 1e-9);
        CHECK(glm::length(atPole - nearby) < 0.02);
    }
    BezierPatch point{};  // a patch without extent has no normal
    CHECK(evaluate(point, 1, 1, 2, 2).normal == dvec3(0, 1, 0));
}
