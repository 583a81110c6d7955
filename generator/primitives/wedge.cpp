#include "generator/primitives/wedge.h"

#include <vector>

#include "generator/builder.h"

namespace farol::generator::primitives {
namespace {

/// A corner: the fractions of the size at which it stands, and its texture coordinates.
struct WedgeCorner {
    glm::dvec3 at;
    glm::dvec2 uv;
};

/// A face: its corners counter-clockwise seen from outside, and its field of the atlas, from the
/// bottom left.
struct WedgeFace {
    std::vector<WedgeCorner> corners;
    int column, row;
};

// Fractions: x and z from -0.5 to 0.5, y from 0 to 1.
const std::vector<WedgeFace>& wedgeFaces() {
    static const std::vector<WedgeFace> faces{
        // left, -X: the upright edge at the picture's left
        {{{{-0.5, 0, -0.5}, {0, 0}}, {{-0.5, 0, 0.5}, {1, 0}}, {{-0.5, 1, -0.5}, {0, 1}}}, 0, 0},
        // slope
        {{{{-0.5, 0, 0.5}, {0, 0}},
          {{0.5, 0, 0.5}, {1, 0}},
          {{0.5, 1, -0.5}, {1, 1}},
          {{-0.5, 1, -0.5}, {0, 1}}},
         1,
         0},
        // right, +X: the upright edge at the picture's right
        {{{{0.5, 0, 0.5}, {0, 0}}, {{0.5, 0, -0.5}, {1, 0}}, {{0.5, 1, -0.5}, {1, 1}}}, 2, 0},
        // bottom
        {{{{-0.5, 0, -0.5}, {0, 0}},
          {{0.5, 0, -0.5}, {1, 0}},
          {{0.5, 0, 0.5}, {1, 1}},
          {{-0.5, 0, 0.5}, {0, 1}}},
         0,
         1},
        // back, -Z
        {{{{0.5, 0, -0.5}, {0, 0}},
          {{-0.5, 0, -0.5}, {1, 0}},
          {{-0.5, 1, -0.5}, {1, 1}},
          {{0.5, 1, -0.5}, {0, 1}}},
         1,
         1},
    };
    return faces;
}

constexpr std::size_t kWedgeVertices = 18, kWedgeTriangles = 8;

}  // namespace

Mesh wedge(const glm::dvec3& size, scene::UvLayout uv) {
    Builder builder(kWedgeVertices, kWedgeTriangles);
    for (const WedgeFace& face : wedgeFaces()) {
        const std::vector<WedgeCorner>& corners = face.corners;
        const glm::dvec3 normal = glm::cross(size * (corners[1].at - corners[0].at),
                                             size * (corners[2].at - corners[0].at));
        const std::uint32_t first = builder.next();
        for (const WedgeCorner& corner : corners) {
            const glm::dvec2 field(face.column + corner.uv.x, face.row + corner.uv.y);
            const bool atlas = uv == scene::UvLayout::atlas;
            builder.vertex(size * corner.at, normal, atlas ? field / glm::dvec2(3, 2) : corner.uv);
        }
        for (std::uint32_t i = 2; i < corners.size(); ++i)
            builder.triangle(first, first + i - 1, first + i);
    }
    return builder.take();
}

ShapeEntry wedgeEntry() {
    return {.name = "wedge",
            .aliases = {"cunha", "rampa"},
            .summary =
                "a right triangular prism, base in XZ, upright face at the back (-Z), slope "
                "falling towards +Z",
            .arguments = {lengthArgument("WIDTH", "edge along X"),
                          lengthArgument("HEIGHT", "height of the upright face"),
                          lengthArgument("DEPTH", "edge along Z")},
            .required = 3,
            .generate =
                [](const ShapeCall& call, const std::string&, scene::UvLayout uv) {
                    return wedge({call.length(0), call.length(1), call.length(2)}, uv);
                },
            .count = [](const ShapeCall&, const std::string&) { return kWedgeTriangles; }};
}

}  // namespace farol::generator::primitives
