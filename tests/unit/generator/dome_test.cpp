#include <catch2/catch.hpp>
#include <numbers>

#include "tests/unit/generator/checks.h"

using namespace checks;
using namespace farol;
using scene::UvLayout;

namespace {

struct Corner {
    glm::vec3 position, normal;
    glm::vec2 uv;
};

bool has(const Mesh& mesh, const Corner& corner) {
    for (std::size_t i = 0; i < mesh.positions().size(); ++i)
        if (glm::distance(mesh.positions()[i], corner.position) < 1e-6F &&
            glm::distance(mesh.normals()[i], corner.normal) < 1e-6F &&
            glm::distance(mesh.uvs()[i], corner.uv) < 1e-6F)
            return true;
    return false;
}

scene::Model modelOf(const std::string& text) {
    scene::Model model;
    model.source.kind = scene::ModelSource::Kind::shape;
    model.source.shape = generator::parseCall(words(text));
    return model;
}

}  // namespace

TEST_CASE("a dome converges to the volume and area of half a ball at second order") {
    const Mesh coarse = make("dome 1.5 32 8"), fine = make("dome 1.5 64 16");
    const double exactVolume = 2.0 / 3 * std::numbers::pi * 1.5 * 1.5 * 1.5;
    const double exactArea = 3 * std::numbers::pi * 1.5 * 1.5;
    CHECK(std::abs(volume(coarse) - exactVolume) < 0.02 * exactVolume);
    CHECK((exactVolume - volume(coarse)) / (exactVolume - volume(fine)) == Approx(4).epsilon(0.05));
    CHECK((exactArea - area(coarse)) / (exactArea - area(fine)) == Approx(4).epsilon(0.05));
    // The least dome is a pyramid on a triangle in the unit circle.
    CHECK(volume(make("dome 1 3 1")) == Approx(std::sqrt(3.0) / 4).epsilon(1e-6));
}

TEST_CASE("a dome is closed, faces outwards and holds no sliver") {
    for (const char* text :
         {"dome 1", "dome 1 3 1", "dome 0.7 7 5", "dome 1e6 33 17", "dome 1e-5 16 8"}) {
        CAPTURE(text);
        const Mesh mesh = make(text);
        CHECK(closedAndManifold(mesh));
        CHECK(volume(mesh) > 0);
        CHECK(thinnest(mesh) > 1e-3);
    }
}

TEST_CASE("a dome stands on its base, in every texture layout alike") {
    const float half = std::sqrt(0.5F);
    const Mesh mesh = make("dome 2 4 2");
    for (const Corner& corner :
         std::vector<Corner>{{{0, 0, 2}, {0, 0, 1}, {0, 0}},
                             {{2, 0, 0}, {1, 0, 0}, {0.25F, 0}},
                             {{0, 0, 2}, {0, 0, 1}, {1, 0}},
                             {{2 * half, 2 * half, 0}, {half, half, 0}, {0.25F, 0.5F}},
                             {{0, 2, 0}, {0, 1, 0}, {0.125F, 1}},
                             {{0, 0, 0}, {0, -1, 0}, {0.5F, 0.5F}},
                             {{0, 0, 2}, {0, -1, 0}, {0.5F, 1}},
                             {{2, 0, 0}, {0, -1, 0}, {1, 0.5F}}}) {
        CAPTURE(corner.position.x, corner.position.y, corner.position.z, corner.uv.x);
        CHECK(has(mesh, corner));
    }
    CHECK(make("dome 2 4 2", UvLayout::atlas) == mesh);
    CHECK(make("dome 2 4 2", UvLayout::layout2017) == mesh);
}

TEST_CASE("a dome's last corners tell its base from its side, as the shader takes them") {
    const Mesh mesh = make("dome 2");
    for (std::size_t t = 0; t < mesh.triangles(); ++t) {
        const auto [a, b, c] = corners(mesh, t);
        const glm::vec3& normal = mesh.normals()[mesh.indices()[3 * t + 2]];
        CHECK((normal.x == 0 && normal.z == 0) == (a.y + b.y + c.y == 0));
    }
}

TEST_CASE("chosen divisions of a dome keep the error, on both sides where it is balanced") {
    const scene::BundleAssets none;
    for (const double error : {0.3, 0.03, 0.003, 0.0003})
        for (const bool balanced : {false, true}) {
            CAPTURE(error, balanced);
            const generator::ShapeCall call = generator::refine(
                modelOf("dome 2"), none, {.error = error, .fullTurn = 8, .balanced = balanced});
            const Mesh mesh = generator::generate(call, none);
            const dvec3 scale = balanced ? generator::balancedScale(call) : dvec3(1.0);
            double inwards = 0, outwards = 0;
            for (std::size_t t = 0; t < mesh.triangles(); ++t) {
                const auto [a, b, c] = corners(mesh, t);
                if (a.y + b.y + c.y == 0) continue;  // of the base
                for (const dvec3& p :
                     {a, b, c, (a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0, (a + b + c) / 3.0}) {
                    const double off = glm::length(scale * p) - 2;
                    inwards = std::max(inwards, -off);
                    outwards = std::max(outwards, off);
                }
            }
            CHECK(inwards <= error + 1e-6);
            CHECK(outwards <= (balanced ? error : 0.0) + 1e-6);
        }
}

TEST_CASE("a dome's surface is the ball's upper half, v from the rim to the pole") {
    const auto surface = generator::surfaceOf(modelOf("dome 2"));
    REQUIRE(surface);
    const generator::SurfaceKind& kind = *surface->kind;
    const auto distance = [&](const dvec3& eye) { return kind.distance(*surface, eye); };
    CHECK(distance({0, 3, 0}) == Approx(2));
    CHECK(distance({0, 0.25, 0}) == Approx(0.75));
    CHECK(distance({4, -4, 0}) == Approx(5));  // to the rim
    CHECK(surface->uv.z + surface->uv.w * 0.5 == 0.0);
    CHECK(surface->uv.z + surface->uv.w * 1.0 == 1.0);
    CHECK_FALSE(generator::surfaceOf(modelOf("dome 2 8 4")));
}
