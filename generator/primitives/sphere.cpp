#include "generator/primitives/sphere.h"

#include <algorithm>
#include <numbers>

#include "generator/builder.h"

namespace farol::generator::primitives {
namespace {

glm::dvec3 balanceOfBall(const std::vector<double>& levels) {
    // The nearest point of a facet to the middle, on the unit sphere.
    const double across = std::sin(std::numbers::pi / levels.at(0));
    const double up = std::sin(std::numbers::pi / (2.0 * levels.at(1)));
    const double depth = std::sqrt(std::max(0.0, 1.0 - across * across - up * up));
    return glm::dvec3(2.0 / (1.0 + depth));
}

/// The unit sphere.
constexpr SurfaceKind kEllipsoid{
    .distance = [](const Surface&,
                   const glm::dvec3& eye) { return std::abs(glm::length(aboutY(eye)) - 1.0); },
    .isNeeded = [](const Surface&, double fullTurn,
                   bool textured) { return textured || fullTurn < kSmoothTurn; },
    .fullTurn =
        [](const std::vector<double>& levels) {
            return std::min(levels.at(0), 2.0 * levels.at(1));
        },
    .balance = balanceOfBall,
    .isBall = true,
    .raySteps = 1,
    .glsl = R"(
void expand(vec3 q, vec3 d, out float a, out float b, out float c) {
    a = dot(d, d);
    b = dot(q, d);
    c = dot(q, q) - 1.0;
}
vec3 sideGradient(vec3 q) { return q; }
#ifdef TEXTURED
float shareOf(vec3 q) { return 0.5 + atan(q.y, length(q.xz)) / (0.5 * kTurn); }
float shareChange(vec3 q, vec3 step) { return 2.0 * latitudeChange(q, 0.0, step); }
#endif
)"};

}  // namespace

Mesh ellipsoid(const glm::dvec3& radii, std::size_t slices, std::size_t stacks,
               scene::UvLayout uv) {
    Builder builder((stacks - 1) * (slices + 1) + 2 * slices, 2 * slices * (stacks - 1));
    const bool fromX = uv == scene::UvLayout::layout2017;
    const glm::dvec3 inverse = 1.0 / radii;
    for (std::size_t j = 1; j < stacks; ++j) {
        const SinCos polar = turn(j, 2 * stacks);  // from the south pole
        for (std::size_t i = 0; i <= slices; ++i) {
            const SinCos a = turn(i, slices);
            const glm::dvec3 unit(polar.sin * (fromX ? a.cos : a.sin), -polar.cos,
                                  polar.sin * (fromX ? -a.sin : a.cos));
            builder.vertex(radii * unit, unit * inverse,
                           {fraction(i, slices), fraction(j, stacks)});
        }
    }
    const auto at = [slices](std::size_t i, std::size_t j) {
        return static_cast<std::uint32_t>((j - 1) * (slices + 1) + i);
    };
    for (std::size_t j = 1; j + 1 < stacks; ++j) {
        for (std::size_t i = 0; i < slices; ++i) {
            builder.triangle(at(i, j), at(i + 1, j), at(i, j + 1));
            builder.triangle(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
        }
    }
    const double n = static_cast<double>(slices);
    for (std::size_t i = 0; i < slices; ++i) {
        const double middle = (static_cast<double>(i) + 0.5) / n;
        const std::uint32_t south = builder.vertex({0, -radii.y, 0}, {0, -1, 0}, {middle, 0});
        const std::uint32_t north = builder.vertex({0, radii.y, 0}, {0, 1, 0}, {middle, 1});
        builder.triangle(south, at(i + 1, 1), at(i, 1));
        builder.triangle(at(i, stacks - 1), at(i + 1, stacks - 1), north);
    }
    return builder.take();
}

Surface ellipsoidSurface(const glm::dvec3& radii, scene::UvLayout uv) {
    Surface surface{&kEllipsoid, radii};
    surface.turnFromX = uv == scene::UvLayout::layout2017;
    return surface;
}

ShapeEntry sphereEntry() {
    return {
        .name = "sphere",
        .aliases = {"esfera"},
        .summary = "a sphere about the origin, poles on Y",
        .arguments = {lengthArgument("RADIUS", "radius"),
                      levelArgument("SLICES", 3, kDefaultSlices, "divisions about Y"),
                      levelArgument("STACKS", 2, kDefaultStacks, "divisions from pole to pole")},
        .required = 1,
        .generate =
            [](const ShapeCall& call, const std::string&, scene::UvLayout uv) {
                return ellipsoid(glm::dvec3(call.length(0)), call.count(1), call.count(2), uv);
            },
        .count = [](const ShapeCall& call,
                    const std::string&) { return 2 * call.count(1) * (call.count(2) - 1); },
        .bound =
            [](const ShapeCall& call, const std::string&, const Fineness& fineness) {
                const double slices = sphereDivisions(call.length(0), fineness.error, fineness);
                return std::vector<double>{slices, slices / 2};
            },
        .surface =
            [](const ShapeCall& call, scene::UvLayout uv) {
                return ellipsoidSurface(glm::dvec3(call.length(0)), uv);
            }};
}

}  // namespace farol::generator::primitives
