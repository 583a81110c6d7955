#include "generator/primitives/dome.h"

#include <cmath>

#include "generator/builder.h"
#include "generator/primitives/sphere.h"

namespace farol::generator::primitives {
namespace {

const SurfaceKind& sphereKind() {
    return *ellipsoidSurface(glm::dvec3(1.0), scene::UvLayout::face).kind;
}

/// The levels of the sphere whose upper half is a dome of these.
std::vector<double> sphereLevels(const std::vector<double>& levels) {
    return {levels.at(0), 2.0 * levels.at(1)};
}

/// The upper half of the unit sphere, closed by a disc. The equation is the sphere's.
const SurfaceKind& domeKind() {
    static const SurfaceKind made = [] {
        SurfaceKind kind = sphereKind();
        kind.distance = [](const Surface&, const glm::dvec3& eye) {
            // From below, the rim is nearest.
            const glm::dvec2 at = aboutY(eye);
            return eye.y < 0.0 ? glm::distance(at, {1.0, 0.0}) : std::abs(glm::length(at) - 1.0);
        };
        kind.fullTurn = [](const std::vector<double>& levels) {
            return sphereKind().fullTurn(sphereLevels(levels));
        };
        kind.balance = [](const std::vector<double>& levels) {
            return sphereKind().balance(sphereLevels(levels));
        };
        kind.isBall = false;  // the middle of its bounds is not the ball's
        kind.hasCaps = true;
        return kind;
    }();
    return made;
}

}  // namespace

Mesh dome(double radius, std::size_t slices, std::size_t stacks) {
    Builder builder(stacks * (slices + 1) + 2 * slices + 1, 2 * slices * stacks);
    for (std::size_t j = 0; j < stacks; ++j) {
        const SinCos up = turn(j, 4 * stacks);  // from the rim
        for (std::size_t i = 0; i <= slices; ++i) {
            const SinCos a = turn(i, slices);
            const glm::dvec3 unit(up.cos * a.sin, up.sin, up.cos * a.cos);
            builder.vertex(radius * unit, unit, {fraction(i, slices), fraction(j, stacks)});
        }
    }
    const auto at = [slices](std::size_t i, std::size_t j) {
        return static_cast<std::uint32_t>(j * (slices + 1) + i);
    };
    for (std::size_t j = 0; j + 1 < stacks; ++j) {
        for (std::size_t i = 0; i < slices; ++i) {
            builder.triangle(at(i, j), at(i + 1, j), at(i, j + 1));
            builder.triangle(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
        }
    }
    for (std::size_t i = 0; i < slices; ++i) {
        const double middle = fraction(2 * i + 1, 2 * slices);
        const std::uint32_t pole = builder.vertex({0, radius, 0}, {0, 1, 0}, {middle, 1});
        // Not the pole as the last corner: by its normal the shader detects flat parts (hasCaps).
        builder.triangle(pole, at(i, stacks - 1), at(i + 1, stacks - 1));
    }
    const glm::dvec3 down(0, -1, 0);
    const std::uint32_t centre = builder.vertex({0, 0, 0}, down, {0.5, 0.5});
    for (std::size_t i = 0; i < slices; ++i) {
        const SinCos a = turn(i, slices);
        builder.vertex({radius * a.sin, 0, radius * a.cos}, down,
                       {0.5 + 0.5 * a.sin, 0.5 + 0.5 * a.cos});
    }
    for (std::uint32_t i = 0; i < slices; ++i)
        builder.triangle(centre, centre + 1 + static_cast<std::uint32_t>((i + 1) % slices),
                         centre + 1 + i);
    return builder.take();
}

ShapeEntry domeEntry() {
    return {
        .name = "dome",
        .aliases = {"cupula"},
        .summary = "half a ball, flat base in XZ, pole at y = RADIUS",
        .arguments = {lengthArgument("RADIUS", "radius, and height"),
                      levelArgument("SLICES", 3, kDefaultSlices, "divisions about Y"),
                      levelArgument("STACKS", 1, kDefaultStacks / 2, "divisions from rim to pole")},
        .required = 1,
        .generate =
            [](const ShapeCall& call, const std::string&, scene::UvLayout) {
                return dome(call.length(0), call.count(1), call.count(2));
            },
        // The row at the pole has half the triangles; the base has the other half.
        .count = [](const ShapeCall& call,
                    const std::string&) { return 2 * call.count(1) * call.count(2); },
        .bound =
            [](const ShapeCall& call, const std::string&, const Fineness& fineness) {
                const double slices = sphereDivisions(call.length(0), fineness.error, fineness);
                return std::vector<double>{slices, std::ceil(slices / 4)};
            },
        .surface =
            [](const ShapeCall& call, scene::UvLayout) {
                Surface surface{&domeKind(), glm::dvec3(call.length(0))};
                // The sphere's share is a half at the rim.
                surface.uv = {0.0, 1.0, -1.0, 2.0};
                return surface;
            }};
}

}  // namespace farol::generator::primitives
