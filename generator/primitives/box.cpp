#include "generator/primitives/box.h"

#include <array>

#include "generator/builder.h"

namespace farol::generator::primitives {
namespace {

/// A face: the axis it stands on and its sign. `a` and `b` are the axes of its grid, chosen so
/// that a x b = +axis.
struct Face {
    int axis;
    double sign;
    int column, row;  ///< its field of the unfolded cross, from the bottom left
};

constexpr std::array<Face, 6> kFaces{
    {{2, 1, 1, 1}, {2, -1, 3, 1}, {1, 1, 1, 2}, {1, -1, 1, 0}, {0, 1, 2, 1}, {0, -1, 0, 1}}};

/// Texture coordinates of a face's point; p holds the fractions 0..1 along x, y, z.
glm::dvec2 uvOf(const Face& face, const glm::dvec3& p, scene::UvLayout layout) {
    const bool plus = face.sign > 0;
    if (layout == scene::UvLayout::layout2017) {
        if (face.axis == 2) return {p.x, p.y};
        if (face.axis == 1) return {p.z, p.x};
        return {p.z, p.y};
    }
    glm::dvec2 uv;
    if (face.axis == 2) uv = {plus ? p.x : 1 - p.x, p.y};
    if (face.axis == 0) uv = {plus ? 1 - p.z : p.z, p.y};
    if (face.axis == 1) uv = {p.x, p.z};
    if (layout == scene::UvLayout::face) return uv;
    if (face.axis == 1 && plus) uv.y = 1 - p.z;  // in the cross, the top hangs on the front
    return {(face.column + uv.x) / 4, (face.row + uv.y) / 3};
}

}  // namespace

Mesh box(const glm::dvec3& size, std::size_t divisions, scene::UvLayout layout) {
    const std::size_t n = divisions;
    Builder builder(6 * (n + 1) * (n + 1), 12 * n * n);
    for (const Face& face : kFaces) {
        const int a = (face.axis + 1) % 3, b = (face.axis + 2) % 3;
        const std::uint32_t base = builder.next();
        glm::dvec3 normal(0);
        normal[face.axis] = face.sign;
        for (std::size_t j = 0; j <= n; ++j) {
            for (std::size_t i = 0; i <= n; ++i) {
                glm::dvec3 part(face.sign > 0 ? 1 : 0);
                part[a] = fraction(i, n);
                part[b] = fraction(j, n);
                builder.vertex(size * (part - 0.5), normal, uvOf(face, part, layout));
            }
        }
        const auto at = [base, n](std::size_t i, std::size_t j) {
            return base + static_cast<std::uint32_t>(j * (n + 1) + i);
        };
        for (std::size_t j = 0; j < n; ++j) {
            for (std::size_t i = 0; i < n; ++i) {
                const std::uint32_t low = at(i, j), high = at(i + 1, j + 1);
                const std::uint32_t alongA = at(i + 1, j), alongB = at(i, j + 1);
                builder.triangle(low, face.sign > 0 ? alongA : high, face.sign > 0 ? high : alongA);
                builder.triangle(low, face.sign > 0 ? high : alongB, face.sign > 0 ? alongB : high);
            }
        }
    }
    return builder.take();
}

ShapeEntry boxEntry() {
    // The second number means divisions where it is the last, else the second edge.
    Argument second = lengthArgument("Y", "edge along Y");
    Argument third = lengthArgument("Z", "edge along Z");
    second.fallback = third.fallback = 1;
    second.whenLast = 3;
    return {.name = "box",
            .aliases = {"cube", "cubo", "caixa", "caja"},
            .summary =
                "a box centred at the origin: X alone is a cube, X DIV a divided cube, X Y Z "
                "[DIV] a box",
            .arguments = {lengthArgument("X", "edge along X"), second, third,
                          countArgument("DIV", 1, 1, "divisions a side")},
            .required = 1,
            .usage = "box X [DIV], or box X Y Z [DIV]",
            .generate =
                [](const ShapeCall& call, const std::string&, scene::UvLayout uv) {
                    const double x = call.length(0);
                    const glm::dvec3 size = call.isWritten(1)
                                                ? glm::dvec3(x, call.length(1), call.length(2))
                                                : glm::dvec3(x);
                    return box(size, call.count(3), uv);
                },
            .count = [](const ShapeCall& call,
                        const std::string&) { return 12 * call.count(3) * call.count(3); }};
}

}  // namespace farol::generator::primitives
