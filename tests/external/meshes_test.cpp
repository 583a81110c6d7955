#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>

#include "generator/io/mesh_file.h"
#include "generator/io/patch_file.h"
#include "generator/registry.h"
#include "scene/files/assets.h"
#include "tests/support/paths.h"
#include "tests/support/skip.h"

namespace fs = std::filesystem;
using farol::generator::Mesh;

namespace {

const fs::path kData = fs::path(farol::test::kSourceDir) / ".." / "shared" / "data";

void requireData(const std::string& folder) {
    if (!fs::is_directory(kData / folder)) farol::test::skip("no folder ../shared/data/" + folder);
}

std::string bytesOf(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// The points of an ascii PLY profile, read without the project's reader.
struct Profile {
    int points = 0;
    double low = 1e9, high = -1e9, radius = 0;
};

Profile profileOf(const std::string& bytes) {
    std::istringstream in(bytes.substr(bytes.find("end_header") + 10));
    Profile out;
    for (double x, y, z; in >> x >> y >> z; ++out.points) {
        out.low = std::min(out.low, y);
        out.high = std::max(out.high, y);
        out.radius = std::max(out.radius, x);
    }
    return out;
}

double volume(const Mesh& mesh) {
    double sum = 0;
    for (std::size_t i = 0; i < mesh.indices().size(); i += 3) {
        const glm::dvec3 a(mesh.positions()[mesh.indices()[i]]),
            b(mesh.positions()[mesh.indices()[i + 1]]), c(mesh.positions()[mesh.indices()[i + 2]]);
        sum += glm::dot(a, glm::cross(b, c)) / 6;
    }
    return sum;
}

}  // namespace

TEST_CASE("the built-in teapot has the surface of the course's") {
    requireData("course/phase_3");
    const farol::scene::FolderAssets course((kData / "course" / "phase_3").string());
    const auto call = farol::generator::parseCall({"patch", "teapot.patch", "16"});
    const Mesh ours = farol::generator::generate(call, farol::scene::BundleAssets());
    const Mesh theirs = farol::generator::generate(call, course);
    REQUIRE(ours.positions().size() == theirs.positions().size());
    CHECK(ours.indices() == theirs.indices());
    float worst = 0, worstNormal = 0;
    for (std::size_t i = 0; i < ours.positions().size(); ++i) {
        worst = std::max(worst, glm::distance(ours.positions()[i], theirs.positions()[i]));
        worstNormal = std::max(worstNormal, glm::distance(ours.normals()[i], theirs.normals()[i]));
    }
    CHECK(worst < 1e-5F);
    CHECK(worstNormal < 1e-3F);
    std::cout << "teapot: largest distance " << worst << ", of normals " << worstNormal << '\n';
}

TEST_CASE("the meshes of the 2017 engine are read as they are") {
    requireData("engine_2017");
    struct Row {
        const char* name;
        std::size_t vertices, triangles;
        double volume;
    };
    for (const Row& row : std::vector<Row>{{"asteroid.3d", 36, 50, 0.00287},
                                           {"box.3d", 24, 12, 120},
                                           {"boxdiv.3d", 726, 1200, 120},
                                           {"cone.3d", 143, 210, 1959.28},
                                           {"plane.3d", 8, 4, 0},
                                           {"sphere.3d", 441, 800, 32.759}}) {
        CAPTURE(row.name);
        farol::Diagnostics findings;
        const Mesh mesh = farol::generator::io::decodeMesh(
            bytesOf(kData / "engine_2017" / row.name), row.name, findings);
        CHECK(findings.empty());
        CHECK(mesh.positions().size() == row.vertices);
        CHECK(mesh.triangles() == row.triangles);
        CHECK(mesh.uvs().size() == row.vertices);
        CHECK(volume(mesh) == Approx(row.volume).epsilon(0.001).margin(1e-6));
        for (const glm::vec3& n : mesh.normals()) CHECK(std::abs(glm::length(n) - 1) < 1e-5F);
    }
}

TEST_CASE("the can and the pawn are turned about their axis") {
    requireData("granada");
    const farol::scene::FolderAssets assets((kData / "granada").string());
    for (const std::string name : {"peon.ply", "lata-pcue.ply", "lata-pinf.ply", "lata-psup.ply"}) {
        CAPTURE(name);
        const Profile profile = profileOf(bytesOf(kData / "granada" / name));
        REQUIRE(profile.points > 2);
        const Mesh mesh = farol::generator::generate(
            farol::generator::parseCall({"revolution", name, "33"}), assets);
        REQUIRE(!mesh.indices().empty());
        float low = 1e9F, high = -1e9F, radius = 0;
        for (const glm::vec3& p : mesh.positions()) {
            low = std::min(low, p.y);
            high = std::max(high, p.y);
            radius = std::max(radius, std::hypot(p.x, p.z));
        }
        CHECK(radius == Approx(profile.radius));
        CHECK(high == Approx(profile.high));
        CHECK(low == Approx(profile.low).margin(1e-6));
        // Faces and normals agree, so nothing is inside out.
        for (std::size_t i = 0; i < mesh.indices().size(); i += 3) {
            const glm::dvec3 a(mesh.positions()[mesh.indices()[i]]),
                b(mesh.positions()[mesh.indices()[i + 1]]),
                c(mesh.positions()[mesh.indices()[i + 2]]);
            const glm::dvec3 face = glm::cross(b - a, c - a);
            CHECK(glm::length(face) > 0);
            CHECK(glm::dot(face, glm::dvec3(mesh.normals()[mesh.indices()[i]])) > 0);
        }
    }
}
