#include <catch2/catch.hpp>

#include "tests/unit/generator/checks.h"

using namespace checks;
using farol::scene::UvLayout;

namespace {

struct Corner {
    UvLayout layout;
    glm::vec3 position, normal;
    glm::vec2 uv;
};

bool has(const Mesh& mesh, const Corner& corner) {
    for (std::size_t i = 0; i < mesh.positions().size(); ++i)
        if (mesh.positions()[i] == corner.position &&
            glm::distance(mesh.normals()[i], corner.normal) < 1e-6F &&
            glm::distance(mesh.uvs()[i], corner.uv) < 1e-6F)
            return true;
    return false;
}

}  // namespace

TEST_CASE("a wedge has its exact volume and area, is closed and faces outwards") {
    const Mesh mesh = make("wedge 2 3 4");
    CHECK(closedAndManifold(mesh));
    CHECK(volume(mesh) == Approx(0.5 * 2 * 3 * 4).epsilon(1e-6));
    // Two ends, bottom, back, and the slope over the hypotenuse 5.
    CHECK(area(mesh) == Approx(2 * 0.5 * 3 * 4 + 2 * 4 + 2 * 3 + 2 * 5).epsilon(1e-6));
    for (const char* flat : {"wedge 1 1e-6 1", "wedge 1e-6 1 1", "wedge 1e9 1e9 1e9"})
        CHECK(closedAndManifold(make(flat)));
}

TEST_CASE("a wedge stands with its upright face at the back and its slope to the front") {
    const glm::vec3 slope(0, 0.8F, 0.6F);  // of height 3 over depth 4
    for (const Corner& corner :
         std::vector<Corner>{{UvLayout::face, {-1, 0, 2}, slope, {0, 0}},
                             {UvLayout::face, {1, 3, -2}, slope, {1, 1}},
                             {UvLayout::face, {1, 0, -2}, {0, 0, -1}, {0, 0}},
                             {UvLayout::face, {-1, 3, -2}, {0, 0, -1}, {1, 1}},
                             {UvLayout::face, {-1, 0, -2}, {0, -1, 0}, {0, 0}},
                             {UvLayout::face, {1, 0, 2}, {0, -1, 0}, {1, 1}},
                             {UvLayout::face, {-1, 3, -2}, {-1, 0, 0}, {0, 1}},
                             {UvLayout::face, {1, 3, -2}, {1, 0, 0}, {1, 1}},
                             {UvLayout::layout2017, {1, 0, 2}, slope, {1, 0}},
                             {UvLayout::atlas, {-1, 0, 2}, slope, {1.0F / 3, 0}},
                             {UvLayout::atlas, {-1, 3, -2}, slope, {1.0F / 3, 0.5F}},
                             {UvLayout::atlas, {1, 0, 2}, {1, 0, 0}, {2.0F / 3, 0}},
                             {UvLayout::atlas, {-1, 3, -2}, {0, 0, -1}, {2.0F / 3, 1}}}) {
        CAPTURE(corner.position.x, corner.position.y, corner.position.z, corner.uv.x);
        CHECK(has(make("wedge 2 3 4", corner.layout), corner));
    }
}
