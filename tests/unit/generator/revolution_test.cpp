#include <catch2/catch.hpp>

#include "tests/unit/generator/checks.h"

using namespace checks;

namespace {

constexpr double kPi = 3.14159265358979323846;

std::string ply(const std::vector<std::pair<double, double>>& points) {
    std::ostringstream out;
    out.precision(17);
    out << "ply\nformat ascii 1.0\nelement vertex " << points.size()
        << "\nproperty float32 x\nproperty float32 y\nproperty float32 z\nend_header\n";
    for (const auto& [x, y] : points) out << x << ' ' << y << " 0\n";
    return out.str();
}

Mesh turned(const std::string& profile, int copies) {
    const auto call = farol::generator::parseCall({"revolution", "p.ply", std::to_string(copies)});
    return farol::generator::generate(call, farol::scene::BundleAssets({{"p.ply", profile}}));
}

std::string circle(int points) {
    std::vector<std::pair<double, double>> out;
    for (int i = 0; i <= points; ++i) {
        const double a = kPi * i / points - kPi / 2;
        const bool pole = i == 0 || i == points;
        out.emplace_back(pole ? 0 : std::cos(a), std::sin(a));
    }
    return ply(out);
}

}  // namespace

TEST_CASE("a half circle turned is a closed sphere that converges at second order") {
    const Mesh coarse = turned(circle(16), 33), fine = turned(circle(32), 65);
    CHECK(closedAndManifold(coarse));
    CHECK(coarse.triangles() == 2 * 32 * 15);
    const double exact = 4.0 / 3 * kPi;
    CHECK((exact - volume(coarse)) / (exact - volume(fine)) == Approx(4).epsilon(0.05));
    double worst = 0;
    for (std::size_t i = 0; i < fine.positions().size(); ++i)
        if (std::abs(fine.positions()[i].y) < 1)  // the poles have their fans' normals
            worst = std::max(worst, glm::length(dvec3(fine.normals()[i]) -
                                                glm::normalize(dvec3(fine.positions()[i]))));
    CHECK(worst < 1e-6);
}

TEST_CASE("copies, texture coordinates and directions of a revolved profile") {
    const Mesh mesh = turned(ply({{1, 0}, {1, 1}, {1, 4}}), 5);
    REQUIRE(mesh.positions().size() == 15);
    CHECK(mesh.triangles() == 16);
    CHECK(mesh.positions()[0] == glm::vec3(1, 0, 0));
    CHECK(mesh.positions()[1] == glm::vec3(0, 0, -1));  // from +X towards -Z
    CHECK(mesh.positions()[4] == mesh.positions()[0]);  // the last copy upon the first
    CHECK(mesh.uvs()[1] == glm::vec2(0.25F, 0));
    CHECK(mesh.uvs()[4] == glm::vec2(1, 0));
    CHECK(mesh.uvs()[5] == glm::vec2(0, 0.25F));  // by arc length
    CHECK(mesh.uvs()[10] == glm::vec2(0, 1));
    CHECK(mesh.normals()[1] == glm::vec3(0, 0, -1));
}

TEST_CASE("a profile is turned outwards whichever way it runs") {
    const Mesh up = turned(ply({{0, 0}, {1, 0}, {1, 2}, {0, 2}}), 33);
    const Mesh down = turned(ply({{0, 2}, {1, 2}, {1, 0}, {0, 0}}), 33);
    const Mesh mirrored = turned(ply({{0, 0}, {-1, 0}, {-1, 2}, {0, 2}}), 33);
    for (const Mesh& mesh : {up, down, mirrored}) {
        CHECK(closedAndManifold(mesh));
        CHECK(volume(mesh) == Approx(2 * 32 * 0.5 * std::sin(2 * kPi / 32)));
    }
    CHECK(down.uvs()[0].y == 1);  // t keeps the file's direction
}

TEST_CASE("a point given twice is a crease") {
    const Mesh smooth = turned(ply({{1, 0}, {1, 1}, {0.5, 1}}), 9);
    const Mesh creased = turned(ply({{1, 0}, {1, 1}, {1, 1}, {0.5, 1}}), 9);
    CHECK(smooth.triangles() == creased.triangles());
    CHECK(glm::distance(smooth.normals()[9], glm::normalize(glm::vec3(1, 1, 0))) < 1e-6F);
    CHECK(glm::distance(creased.normals()[9], glm::vec3(1, 0, 0)) < 1e-6F);
    CHECK(glm::distance(creased.normals()[18], glm::vec3(0, 1, 0)) < 1e-6F);
}

TEST_CASE("profiles that cannot be turned are refused") {
    for (const std::string& bytes :
         {ply({}), ply({{1, 0}}), ply({{1, 0}, {1, 0}}), ply({{1, 0}, {-1, 1}})}) {
        CAPTURE(bytes);
        try {
            turned(bytes, 8);
            FAIL("it was accepted");
        } catch (const farol::Error& error) {
            CHECK((error.code() == "mesh.profile" || error.code() == "mesh.empty"));
        }
    }
}
