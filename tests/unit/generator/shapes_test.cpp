#include <catch2/catch.hpp>
#include <functional>

#include "tests/unit/generator/checks.h"

using namespace checks;
using farol::scene::UvLayout;

namespace {

constexpr double kPi = 3.14159265358979323846;

struct Solid {
    std::string coarse, fine;  ///< the same shape with n and 2n divisions
    double volume, area;
};

double ellipsoidArea(double a, double b, double c) {
    double sum = 0;  // midpoint rule over the sphere's parameters
    constexpr int kN = 2000;
    for (int j = 0; j < kN; ++j) {
        const double t = kPi * (j + 0.5) / kN, s = std::sin(t);
        for (int i = 0; i < 200; ++i) {
            const double p = 2 * kPi * (i + 0.5) / 200;
            const dvec3 n(s * std::cos(p) / a, std::cos(t) / b, s * std::sin(p) / c);
            sum += a * b * c * glm::length(n) * s * (kPi / kN) * (2 * kPi / 200);
        }
    }
    return sum;
}

const std::vector<Solid>& solids() {
    static const std::vector<Solid> all{
        {"sphere 1.5 32 16", "sphere 1.5 64 32", 4.0 / 3 * kPi * 3.375, 4 * kPi * 2.25},
        {"cone 1 2 32 5", "cone 1 2 64 10", kPi * 2 / 3, kPi + kPi * std::sqrt(5.0)},
        {"cylinder 1 2 32 3", "cylinder 1 2 64 6", 2 * kPi, 2 * kPi + 4 * kPi},
        {"torus 2 0.5 32 16", "torus 2 0.5 64 32", 2 * kPi * kPi * 2 * 0.25, 4 * kPi * kPi},
        {"ellipsoid 1 2 3 32 16", "ellipsoid 1 2 3 64 32", 8 * kPi, ellipsoidArea(1, 2, 3)},
        {"frustum 2 1 3 32 4", "frustum 2 1 3 64 8", kPi * 7, 5 * kPi + 3 * kPi * std::sqrt(10.0)},
        {"frustum 0 1 2 32 4", "frustum 0 1 2 64 8", kPi * 2 / 3, kPi + kPi * std::sqrt(5.0)},
    };
    return all;
}

}  // namespace

TEST_CASE("curved solids converge to their volume and area at second order") {
    for (const Solid& solid : solids()) {
        CAPTURE(solid.coarse);
        const Mesh coarse = make(solid.coarse), fine = make(solid.fine);
        const double volumeError = solid.volume - volume(coarse);
        const double areaError = solid.area - area(coarse);
        CHECK(std::abs(volumeError) < 0.06 * solid.volume);
        // Halved steps quarter the error.
        CHECK(volumeError / (solid.volume - volume(fine)) == Approx(4).epsilon(0.05));
        CHECK(areaError / (solid.area - area(fine)) == Approx(4).epsilon(0.05));
    }
}

TEST_CASE("solids are closed, face outwards and hold no sliver") {
    for (const char* text : {"box 2",
                             "box 2 3",
                             "box 1 2 3",
                             "box 0.1 0.7 0.3 7",
                             "sphere 1 10 10",
                             "sphere 1 8 8",
                             "sphere 1 3 2",
                             "sphere 0.7 7 5",
                             "sphere 1e6 33 17",
                             "sphere 1e-5 16 8",
                             "cone 1 2 4 3",
                             "cone 1 2 3 1",
                             "cone 0.3 7 11 13",
                             "cylinder 1 2 16 1",
                             "cylinder 0.1 0.7 7 3",
                             "torus 2 0.5 32 16",
                             "torus 0.7 0.3 3 3",
                             "frustum 2 1 3 16 2",
                             "frustum 0 1 2 16 2",
                             "frustum 1 0 2 16 2",
                             "ellipsoid 1 2 3 9 7",
                             "sphere 1",
                             "cone 1 2",
                             "cylinder 1 2",
                             "torus 2 0.5"}) {
        CAPTURE(text);
        const Mesh mesh = make(text);
        CHECK(closedAndManifold(mesh));
        CHECK(volume(mesh) > 0);
        CHECK(thinnest(mesh) > 1e-3);
    }
}

TEST_CASE("boxes have their exact volume and area") {
    CHECK(volume(make("box 2 3")) == Approx(8).epsilon(1e-6));
    CHECK(area(make("box 2 3")) == Approx(24).epsilon(1e-6));
    CHECK(volume(make("box 1 2 3 4")) == Approx(6).epsilon(1e-6));
    CHECK(area(make("plane 4 5")) == Approx(16).epsilon(1e-6));
    CHECK(area(make("ring 1 2 64")) == Approx(2 * 3 * 64 * 0.5 * std::sin(2 * kPi / 64)));
    CHECK(area(make("ring 0 2 64")) == Approx(2 * 4 * 64 * 0.5 * std::sin(2 * kPi / 64)));
}

TEST_CASE("shapes have the counts that their arguments say") {
    struct Row {
        const char* text;
        std::size_t triangles, vertices;
    };
    for (const Row& row : std::vector<Row>{{"plane 2 3", 18, 16},
                                           {"plane 2", 2, 4},
                                           {"box 2 3", 108, 96},
                                           {"box 2", 12, 24},
                                           {"sphere 1 10 10", 180, 119},
                                           {"sphere 1 8 8", 112, 79},
                                           {"cone 1 2 4 3", 24, 31},
                                           {"cylinder 1 2 16 1", 64, 130},
                                           {"torus 2 0.5 32 16", 1024, 561},
                                           {"ring 1 2 8", 32, 36},
                                           {"ring 0 2 8", 16, 36},
                                           {"patch teapot.patch 10", 6320, 3872},
                                           {"bezier teapot.patch 1", 56, 128}}) {
        CAPTURE(row.text);
        const Mesh mesh = make(row.text);
        CHECK(mesh.triangles() == row.triangles);
        CHECK(mesh.positions().size() == row.vertices);
        CHECK(mesh.normals().size() == row.vertices);
        CHECK(mesh.uvs().size() == row.vertices);
        CHECK(farol::generator::countTriangles(farol::generator::parseCall(words(row.text)),
                                               farol::scene::BundleAssets()) == row.triangles);
    }
}

TEST_CASE("normals are the analytic ones within 1e-6") {
    struct Row {
        const char* text;
        std::function<dvec3(const dvec3&)> gradient;  ///< of the implicit form; 0: not checked
    };
    const double slope = 0.5;  // of cone 1 2: radius over height
    for (const Row& row : std::vector<Row>{
             {"sphere 1.5 24 12", [](const dvec3& p) { return p; }},
             {"ellipsoid 1 2 3 24 12", [](const dvec3& p) { return dvec3(p.x, p.y / 4, p.z / 9); }},
             {"torus 2 0.5 24 12",
              [](const dvec3& p) {
                  const double r = std::hypot(p.x, p.z);
                  return dvec3(p.x - 2 * p.x / r, p.y, p.z - 2 * p.z / r);
              }},
             {"cone 1 2 24 6", [slope](const dvec3& p) {
                  const double r = std::hypot(p.x, p.z);
                  if (r < 1e-9) return dvec3(0);  // the apex: tested below
                  return dvec3(p.x / r, slope, p.z / r);
              }}}) {
        CAPTURE(row.text);
        const Mesh mesh = make(row.text);
        const bool cone = std::string(row.text).rfind("cone", 0) == 0;
        double worst = 0;
        for (std::size_t i = 0; i < mesh.positions().size(); ++i) {
            const dvec3 n(mesh.normals()[i]), gradient = row.gradient(dvec3(mesh.positions()[i]));
            CHECK(std::abs(glm::length(n) - 1) < 1e-6);
            if (glm::length(gradient) == 0 || (cone && n.y < 0)) continue;
            worst = std::max(worst, glm::length(n - glm::normalize(gradient)));
        }
        CHECK(worst < 1e-6);
    }
}

TEST_CASE("the cone's apex has one vertex a slice with the slice's middle normal") {
    const Mesh mesh = make("cone 1 2 4 3");
    std::vector<dvec3> normals;
    for (std::size_t i = 0; i < mesh.positions().size(); ++i) {
        if (mesh.positions()[i] != glm::vec3(0, 2, 0)) continue;
        normals.emplace_back(mesh.normals()[i]);
        CHECK(mesh.uvs()[i] == glm::vec2(0.5F, 1));
    }
    REQUIRE(normals.size() == 4);
    for (std::size_t i = 0; i < 4; ++i) {
        const double a = 2 * kPi * (static_cast<double>(i) + 0.5) / 4;
        CHECK(glm::length(normals[i] - glm::normalize(dvec3(std::sin(a), 0.5, std::cos(a)))) <
              1e-6);
    }
}

TEST_CASE("vertices stand where the course's conventions put them") {
    const Mesh sphere = make("sphere 1 8 8");
    // The first ring above the south pole starts at +Z and turns towards +X.
    CHECK(sphere.positions()[0].x == 0);
    CHECK(sphere.positions()[0].z > 0);
    CHECK(sphere.positions()[1].x > 0);
    CHECK(sphere.positions()[8] == sphere.positions()[0]);
    CHECK(sphere.uvs()[0].x == 0);
    CHECK(sphere.uvs()[8].x == 1);
    // Quads are split from bottom right to top left: no triangle holds bottom left and top right.
    const auto isSplit = [](const Mesh& mesh, glm::vec3 a, glm::vec3 b) {
        for (std::size_t t = 0; t < mesh.triangles(); ++t) {
            int hits = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::vec3 p = mesh.positions()[mesh.indices()[3 * t + k]];
                hits += p == a || p == b ? 1 : 0;
            }
            if (hits == 2) return true;
        }
        return false;
    };
    const auto& p = sphere.positions();
    CHECK(isSplit(sphere, p[9 * 2 + 1], p[9 * 3]));
    CHECK_FALSE(isSplit(sphere, p[9 * 2], p[9 * 3 + 1]));
    const Mesh plane = make("plane 2");
    CHECK(isSplit(plane, {-1, 0, -1}, {1, 0, 1}));
    CHECK_FALSE(isSplit(plane, {1, 0, -1}, {-1, 0, 1}));
    const Mesh box = make("box 2");
    for (const auto& [low, high] :
         std::vector<std::pair<glm::vec3, glm::vec3>>{{{-1, -1, 1}, {1, 1, 1}},
                                                      {{-1, -1, -1}, {1, 1, -1}},
                                                      {{-1, 1, -1}, {1, 1, 1}},
                                                      {{-1, -1, -1}, {1, -1, 1}},
                                                      {{1, -1, -1}, {1, 1, 1}},
                                                      {{-1, -1, -1}, {-1, 1, 1}}})
        CHECK(isSplit(box, low, high));
    const Mesh cone = make("cone 1 2 4 3");
    CHECK(cone.positions()[0] == glm::vec3(0, 0, 1));
    CHECK(cone.positions()[1] == glm::vec3(1, 0, 0));
}

TEST_CASE("texture coordinates stay in the picture in every layout") {
    for (const char* text :
         {"plane 2 3", "box 2 3", "sphere 1 8 8", "cone 1 2 8 3", "cylinder 1 2 8 3",
          "torus 2 0.5 8 8", "patch teapot.patch 3", "ring 1 2 8", "ring 0 2 8",
          "ellipsoid 1 2 3 8 8", "frustum 2 1 3 8 2"}) {
        for (const UvLayout uv : {UvLayout::face, UvLayout::atlas, UvLayout::layout2017}) {
            CAPTURE(text, static_cast<int>(uv));
            const Mesh mesh = make(text, uv);
            glm::vec2 low(1), high(0);
            for (const glm::vec2& one : mesh.uvs()) {
                low = glm::min(low, one);
                high = glm::max(high, one);
            }
            CHECK(low.x >= 0);
            CHECK(low.y >= 0);
            CHECK(high.x <= 1);
            CHECK(high.y <= 1);
            CHECK(high.x - low.x > 0.7F);
            CHECK(high.y - low.y > 0.4F);
        }
    }
}

TEST_CASE("texture layouts put known points at known places") {
    struct Row {
        const char* text;
        UvLayout layout;
        glm::vec3 position, normal;
        glm::vec2 uv;
    };
    for (const Row& row : std::vector<Row>{
             {"plane 2", UvLayout::face, {-1, 0, 1}, {0, 1, 0}, {0, 0}},
             {"plane 2", UvLayout::face, {1, 0, -1}, {0, 1, 0}, {1, 1}},
             {"box 2", UvLayout::face, {-1, -1, 1}, {0, 0, 1}, {0, 0}},
             {"box 2", UvLayout::face, {1, -1, 1}, {1, 0, 0}, {0, 0}},
             {"box 2", UvLayout::face, {1, 1, -1}, {0, 0, -1}, {0, 1}},
             {"box 2", UvLayout::face, {-1, 1, 1}, {-1, 0, 0}, {1, 1}},
             {"box 2", UvLayout::face, {-1, 1, 1}, {0, 1, 0}, {0, 1}},
             {"box 2", UvLayout::face, {1, 1, -1}, {0, 1, 0}, {1, 0}},
             {"box 2", UvLayout::atlas, {-1, -1, 1}, {0, 0, 1}, {0.25F, 1.0F / 3}},
             {"box 2", UvLayout::atlas, {-1, 1, 1}, {0, 1, 0}, {0.25F, 2.0F / 3}},
             {"box 2", UvLayout::atlas, {-1, 1, -1}, {0, 1, 0}, {0.25F, 1}},
             {"box 2", UvLayout::atlas, {1, -1, -1}, {0, -1, 0}, {0.5F, 0}},
             {"box 2", UvLayout::atlas, {-1, 1, -1}, {0, 0, -1}, {1, 2.0F / 3}},
             {"box 2", UvLayout::layout2017, {-1, 1, 1}, {0, 1, 0}, {1, 0}},
             {"cylinder 1 2 4 1", UvLayout::atlas, {0, 2, 1}, {0, 1, 0}, {0.4375F, 1}},
             {"cylinder 1 2 4 1", UvLayout::atlas, {1, 0, 0}, {0, -1, 0}, {1, 0.8125F}},
             {"cylinder 1 2 4 1", UvLayout::atlas, {1, 2, 0}, {1, 0, 0}, {0.25F, 0.625F}},
             {"cone 1 2 4 1", UvLayout::atlas, {1, 0, 0}, {0, -1, 0}, {0.5F, 0.5F}},
             {"cone 1 2 4 1", UvLayout::layout2017, {0, 0, 0}, {0, -1, 0}, {0.25F, 1}},
             {"cone 1 2 4 1", UvLayout::layout2017, {1, 0, 0}, {0, -1, 0}, {0.25F, 0}},
             {"sphere 1 4 2", UvLayout::face, {1, 0, 0}, {1, 0, 0}, {0.25F, 0.5F}},
             {"sphere 1 4 2", UvLayout::face, {0, 1, 0}, {0, 1, 0}, {0.125F, 1}},
             {"sphere 1 4 2", UvLayout::layout2017, {0, 0, 1}, {0, 0, 1}, {0.75F, 0.5F}}}) {
        CAPTURE(row.text, static_cast<int>(row.layout), row.uv.x, row.uv.y);
        const Mesh mesh = make(row.text, row.layout);
        bool found = false;
        for (std::size_t i = 0; i < mesh.positions().size(); ++i)
            found = found || (glm::distance(mesh.positions()[i], row.position) < 1e-6F &&
                              glm::distance(mesh.normals()[i], row.normal) < 1e-6F &&
                              glm::distance(mesh.uvs()[i], row.uv) < 1e-6F);
        CHECK(found);
    }
}

TEST_CASE("arguments out of range are refused by name") {
    struct Row {
        const char *text, *code, *said;
    };
    for (const Row& row :
         std::vector<Row>{{"sphere -1 10 10", "shape.argument", "RADIUS"},
                          {"sphere 0 10 10", "shape.argument", "RADIUS"},
                          {"sphere 1 2 10", "shape.argument", "SLICES"},
                          {"sphere 1 10 1", "shape.argument", "STACKS"},
                          {"sphere 1 10.5 10", "shape.argument", "a whole number in 3 to 100000"},
                          {"sphere 1 1e99 10", "shape.argument", "SLICES"},
                          {"sphere nan 10 10", "shape.argument", "RADIUS"},
                          {"sphere inf 10 10", "shape.argument", "RADIUS"},
                          {"sphere 1,5 10 10", "shape.argument", "RADIUS"},
                          {"sphere", "shape.argument", "RADIUS"},
                          {"sphere 1 10 10 10", "shape.argument", "expected at most 3"},
                          {"sphere 1 100000 100000", "limit.triangles", "5000000"},
                          {"plane 1 0", "shape.argument", "DIV"},
                          {"plane", "shape.argument", "SIZE"},
                          {"box 2 0", "shape.argument", "DIV"},
                          {"box 2 1.5", "shape.argument", "DIV"},
                          {"box 1 2 0", "shape.argument", "Z"},
                          {"box 1 2 3 -4", "shape.argument", "DIV"},
                          {"cone 1 0 4 3", "shape.argument", "HEIGHT"},
                          {"cone 1 2 2 3", "shape.argument", "SLICES"},
                          {"cone 1 2 4 0", "shape.argument", "STACKS"},
                          {"cylinder 1 x 4 1", "shape.argument", "HEIGHT"},
                          {"torus 1 1 8 8", "shape.argument", "TUBE"},
                          {"torus 1 1e-5 8 8", "shape.argument", "TUBE"},
                          {"ring 2 1", "shape.argument", "INNER"},
                          {"frustum 0 0 1", "shape.argument", "BOTTOM"},
                          {"patch", "shape.argument", "file"},
                          {"patch teapot.patch 0", "shape.argument", "LEVEL"},
                          {"patch teapot.patch 1000", "limit.triangles", "5000000"},
                          {"patch teapto.patch 10", "asset.missing", "teapot.patch"},
                          {"revolution none.ply 32", "asset.missing", "none.ply"},
                          {"revolution teapot.patch 3", "shape.argument", "N"},
                          {"shpere 1 10 10", "shape.unknown", "did you mean \"sphere\""},
                          {"", "shape.unknown", "no shape"}}) {
        CAPTURE(row.text);
        try {
            make(row.text);
            FAIL("it was accepted");
        } catch (const farol::Error& error) {
            CHECK(error.code() == row.code);
            CHECK_THAT(error.what(), Catch::Contains(row.said));
        }
    }
}

TEST_CASE("shapes and their aliases are found in any case; numbers as scenes write them") {
    CHECK(farol::generator::findShape("BEZIER") == farol::generator::findShape("patch"));
    CHECK(farol::generator::findShape("nothing") == nullptr);
    CHECK(make("Sphere 1.0f 010 +10") == make("sphere 1 10 10"));
    CHECK(make("sphere .5 8.0 8e0") == make("sphere 0.5 8 8"));
    CHECK(make("sphere 1 auto auto") == make("sphere 1"));
}
