// Faces of many corners: what covers them is measured against the shoelace formula.
#include "generator/io/polygon.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <ctime>
#include <numbers>
#include <random>

#include "generator/io/mesh_file.h"
#include "tests/unit/generator/checks.h"

using namespace checks;
using farol::generator::io::decodeMesh;
using farol::generator::io::FaceTriangle;
using farol::generator::io::triangulate;

namespace {

struct Face {
    std::string name;
    std::vector<glm::dvec2> flat;  ///< counter-clockwise
    std::size_t flatTriangles = 0;
};

std::vector<FaceTriangle> trianglesOf(const std::vector<glm::vec3>& corners) {
    std::vector<FaceTriangle> out{{7, 7, 7}};  // replaced
    triangulate(corners, out);
    return out;
}

/// Twice the area of the polygon.
double shoelace(const std::vector<glm::dvec2>& p) {
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const glm::dvec2 a = p[i], b = p[(i + 1) % p.size()];
        sum += a.x * b.y - a.y * b.x;
    }
    return sum;
}

/// A star-shaped polygon whose radius jumps about: many corners turn right.
Face star(std::size_t corners, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> radius(20, 100);
    Face face{"star of " + std::to_string(corners), {}};
    for (std::size_t i = 0; i < corners; ++i) {
        const double turn = 2 * std::numbers::pi * double(i) / double(corners);
        face.flat.push_back(double(radius(random)) * glm::dvec2(std::cos(turn), std::sin(turn)));
    }
    return face;
}

/// A comb: each tooth is long, and no corner sees far.
Face comb(int teeth) {
    Face face{"comb of " + std::to_string(teeth), {{0, 0}, {2.0 * teeth, 0}}};
    for (int i = teeth - 1; i >= 0; --i) {
        face.flat.emplace_back(2 * i + 2, 9);
        face.flat.emplace_back(2 * i + 1, 1);
    }
    face.flat.emplace_back(0, 9);
    return face;
}

std::vector<Face> faces() {
    std::vector<Face> all = {
        {"square", {{0, 0}, {1, 0}, {1, 1}, {0, 1}}},
        {"arrow head, hollow first", {{1, 1}, {0, 3}, {-3, -1}, {3, -1}}},
        {"arrow head", {{0, 3}, {-3, -1}, {0, 0}, {3, -1}}},
        {"L", {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}},
        {"L from its end", {{1, 3}, {0, 3}, {0, 0}, {3, 0}, {3, 1}, {1, 1}}},
        {"U", {{0, 0}, {5, 0}, {5, 4}, {4, 4}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}},
        {"cross",
         {{1, 0},
          {2, 0},
          {2, 1},
          {3, 1},
          {3, 2},
          {2, 2},
          {2, 3},
          {1, 3},
          {1, 2},
          {0, 2},
          {0, 1},
          {1, 1}}},
        {"square with corners on its edges",
         {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}},
        {"triangle with corners on one edge", {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {2, 3}}},
        {"L with corners on its edges",
         {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1}, {2, 1}, {1, 1}, {1, 2}, {1, 3}, {0, 3}, {0, 1}}},
        {"square with a hole, by a slit",
         {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}}},
        {"L with a corner that repeats",
         {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 1}, {1, 3}, {0, 3}},
         1},
        {"square with a needle", {{0, 0}, {2, 0}, {5, 0}, {2, 0}, {2, 2}, {0, 2}}, 2},
        comb(5),
        comb(200),
    };
    for (const unsigned seed : {1U, 2U, 3U, 4U, 5U, 6U})
        all.push_back(star(5 + 40 * std::size_t{seed}, seed));
    return all;
}

}  // namespace

TEST_CASE("a face's triangles cover it once, whatever its form, start and direction") {
    for (const Face& face : faces()) {
        const std::size_t n = face.flat.size();
        for (std::size_t start = 0; start < n; start += 1 + n / 20) {
            for (const bool back : {false, true}) {
                CAPTURE(face.name, start, back);
                std::vector<glm::dvec2> flat;
                for (std::size_t i = 0; i < n; ++i)
                    flat.push_back(face.flat[(start + (back ? n - i : i)) % n]);
                std::vector<glm::vec3> corners;  // in a slanted plane
                for (const glm::dvec2& p : flat)
                    corners.emplace_back(p.x, p.y, 2 * p.x - 3 * p.y + 1);
                const auto triangles = trianglesOf(corners);
                REQUIRE(triangles.size() == n - 2);
                double sum = 0;
                std::size_t none = 0;
                for (const auto& [a, b, c] : triangles) {
                    REQUIRE(std::max({a, b, c}) < n);
                    const double area = (back ? -1 : 1) * shoelace({flat[a], flat[b], flat[c]});
                    CHECK(area >= 0);
                    none += area == 0 ? 1 : 0;
                    sum += area;
                }
                CHECK(none == face.flatTriangles);
                CHECK(sum == Approx(shoelace(face.flat)).epsilon(1e-9));
            }
        }
    }
}

TEST_CASE("a convex face is the fan of its first corner") {
    std::vector<glm::vec3> corners;
    for (int i = 0; i < 9; ++i) corners.emplace_back(std::cos(0.7 * i), 0, std::sin(0.7 * i));
    const auto triangles = trianglesOf(corners);
    REQUIRE(triangles.size() == 7);
    for (std::uint32_t k = 0; k < 7; ++k) CHECK(triangles[k] == FaceTriangle{0, k + 1, k + 2});
}

TEST_CASE("faces without area or that cross themselves have their number of triangles") {
    const std::vector<std::vector<glm::vec3>> all = {
        std::vector<glm::vec3>(5, glm::vec3(2)),
        {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}},
        {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}},
        {{0, 0, 0}, {3, 3, 0}, {3, 0, 0}, {0, 2, 0}, {-1, 1, 0}},
        {{1, 0, 0}, {-0.8F, 0.6F, 0}, {0.3F, -0.95F, 0}, {0.3F, 0.95F, 0}, {-0.8F, -0.6F, 0}},
        {{0, 0, 0}, {1e18F, 0, 0}, {1e-18F, 1e-18F, 0}, {0, 1e18F, 0}},
    };
    for (const auto& corners : all) {
        const auto triangles = trianglesOf(corners);
        CHECK(triangles.size() == corners.size() - 2);
        for (const auto& [a, b, c] : triangles) CHECK(std::max({a, b, c}) < corners.size());
    }
}

TEST_CASE("a face of very many corners is covered") {
    const Face face = comb(8000);
    std::vector<glm::vec3> corners;
    for (const glm::dvec2& p : face.flat) corners.emplace_back(p.x, p.y, 0);
    double sum = 0;
    for (const auto& [a, b, c] : trianglesOf(corners))
        sum += shoelace({face.flat[a], face.flat[b], face.flat[c]});
    CHECK(sum == Approx(shoelace(face.flat)).epsilon(1e-9));
}

TEST_CASE("the readers of OBJ, PLY and OFF cover hollow faces") {
    const std::string rows = "0 0 0\n0 3 0\n-3 -1 0\n3 -1 0\n";
    for (const auto& [name, bytes] : std::vector<std::pair<std::string, std::string>>{
             {"a.obj", "v 0 0 0\nv 0 3 0\nv -3 -1 0\nv 3 -1 0\nf 3 1 4 2\n"},
             {"a.ply",
              "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
              "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
              "end_header\n" +
                  rows + "4 2 0 3 1\n"},
             {"a.off", "OFF\n4 1 0\n" + rows + "4 2 0 3 1\n"}}) {
        CAPTURE(name);
        farol::Diagnostics findings;
        const Mesh mesh = decodeMesh(bytes, name, findings);
        CHECK(mesh.triangles() == 2);
        CHECK(area(mesh) == Approx(9));
        for (const glm::vec3& normal : mesh.normals()) CHECK(normal.z == Approx(1));
    }
}

TEST_CASE("a face of many corners takes no square of their number") {
    // Each takes 0.01 to 0.1 s; testing every corner against every other takes 5 s and more.
    constexpr std::size_t kCorners = 50'000;
    const auto face = [](auto at) {
        std::vector<glm::vec3> corners;
        for (std::size_t i = 0; i < kCorners; ++i)
            corners.push_back(at(double(i) / double(kCorners), i));
        // From within, so that no fan covers it.
        std::rotate(corners.begin(), corners.begin() + kCorners / 3, corners.end());
        return corners;
    };
    const auto line = face(
        [](double t, std::size_t i) { return i == 0 ? glm::vec3(0.5, 1, 0) : glm::vec3(t, 0, 0); });
    const auto slanted = face([](double t, std::size_t i) {
        return i == 0 ? glm::vec3(0.5, 9, 0) : glm::vec3(t, 0.37 * t, 0);
    });
    const auto hollow = face([](double t, std::size_t i) {
        return i == 0 ? glm::vec3(0.5, 2, 0) : glm::vec3(t, t * (1 - t), 0);
    });
    const auto petals = face([](double t, std::size_t i) {
        const double angle = 2 * std::numbers::pi * t;
        return i % 3 == 0 ? glm::vec3(0) : glm::vec3(std::cos(angle), std::sin(angle), 0);
    });
    const auto teeth = face([](double t, std::size_t i) {
        if (i < 2) return glm::vec3(double(i), -1, 0);
        return glm::vec3(1 - t, i % 2, 0);
    });
    for (const auto& corners : {line, slanted, hollow, petals, teeth}) {
        const std::clock_t begin = std::clock();
        CHECK(trianglesOf(corners).size() == kCorners - 2);
        CHECK(double(std::clock() - begin) / CLOCKS_PER_SEC < 1);
    }
}
