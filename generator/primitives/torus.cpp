#include "generator/primitives/torus.h"

#include <algorithm>

#include "generator/builder.h"
#include "generator/messages.h"

namespace farol::generator::primitives {
namespace {

/// The ring 1 about Y, the tube form.x.
constexpr SurfaceKind kTorus{
    .distance =
        [](const Surface& surface, const glm::dvec3& eye) {
            return std::abs(glm::length(aboutY(eye) - glm::dvec2(1.0, 0.0)) - surface.form.x);
        },
    .isNeeded = [](const Surface&, double fullTurn, bool) { return fullTurn < kSmoothTurn; },
    .fullTurn =
        [](const std::vector<double>& levels) { return std::min(levels.at(0), levels.at(1)); },
    .balance = [](const std::vector<double>& levels) { return balanceOfSlices(levels.at(0)); },
    .wrapsV = true,
    .raySteps = 2,  // not a quadric: once more from where the first step leads
    .glsl = R"(
void expand(vec3 q, vec3 d, out float a, out float b, out float c) {
    float radius = length(q.xz);
    float rate = dot(q.xz, d.xz) / radius;
    a = dot(d, d) - (dot(d.xz, d.xz) - rate * rate) / radius;
    b = rate * (radius - 1.0) + q.y * d.y;
    c = (radius - 1.0) * (radius - 1.0) + q.y * q.y - surfaceForm.x * surfaceForm.x;
}
vec3 sideGradient(vec3 q) {
    float radius = length(q.xz);
    return vec3(q.x - q.x / radius, q.y, q.z - q.z / radius);
}
#ifdef TEXTURED
float shareOf(vec3 q) { return atan(q.y, length(q.xz) - 1.0) / kTurn; }
float shareChange(vec3 q, vec3 step) { return latitudeChange(q, 1.0, step); }
#endif
)"};

}  // namespace

Mesh torus(double ringRadius, double tubeRadius, std::size_t rings, std::size_t sides) {
    Builder builder((rings + 1) * (sides + 1), 2 * rings * sides);
    for (std::size_t j = 0; j <= sides; ++j) {
        const SinCos tube = turn(j, sides);
        const double radius = ringRadius + tubeRadius * tube.cos;
        for (std::size_t i = 0; i <= rings; ++i) {
            const SinCos a = turn(i, rings);
            builder.vertex({radius * a.sin, tubeRadius * tube.sin, radius * a.cos},
                           {tube.cos * a.sin, tube.sin, tube.cos * a.cos},
                           {fraction(i, rings), fraction(j, sides)});
        }
    }
    const auto at = [rings](std::size_t i, std::size_t j) {
        return static_cast<std::uint32_t>(j * (rings + 1) + i);
    };
    for (std::size_t j = 0; j < sides; ++j) {
        for (std::size_t i = 0; i < rings; ++i) {
            builder.triangle(at(i, j), at(i + 1, j), at(i, j + 1));
            builder.triangle(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
        }
    }
    return builder.take();
}

ShapeEntry torusEntry() {
    return {
        .name = "torus",
        .aliases = {"toro", "toroide"},
        .summary = "a torus about the origin, lying in XZ",
        .arguments = {lengthArgument("RING", "radius from the centre to the middle of the tube"),
                      lengthArgument("TUBE", "radius of the tube, less than RING", 0.5),
                      levelArgument("SLICES", 3, 1.5 * kDefaultSlices, "divisions round the ring"),
                      levelArgument("SIDES", 3, 24, "divisions round the tube")},
        .required = 2,
        .generate =
            [](const ShapeCall& call, const std::string&, scene::UvLayout) {
                return torus(call.length(0), call.length(1), call.count(2), call.count(3));
            },
        .count = [](const ShapeCall& call,
                    const std::string&) { return 2 * call.count(2) * call.count(3); },
        // GLUT's order: the tube first.
        .isExchanged = [](const ShapeCall& call) { return call.length(1) > call.length(0); },
        .check = [](const ShapeCall& call) -> Message {
            // Thinner tubes fold in floats: a float holds 1e-7 of the ring's radius.
            constexpr double kMinTube = 1e-4;
            const double ring = call.length(0), tube = call.length(1);
            if (tube >= ring)
                return message<"part.torus-tube">("tube"_arg = tube, "ring"_arg = ring);
            if (tube < kMinTube * ring)
                return message<"part.torus-thin">("tube"_arg = tube, "ring"_arg = ring);
            return {};
        },
        .bound =
            [](const ShapeCall& call, const std::string&, const Fineness& fineness) {
                const double ring = call.length(0), tube = call.length(1);
                return std::vector<double>{
                    circleDivisions(ring + tube, fineness.error / 2, fineness),
                    // The tube is never balanced: no scale does that.
                    circleDivisions(tube, fineness.error / (fineness.balanced ? 4 : 2), fineness)};
            },
        .surface =
            [](const ShapeCall& call, scene::UvLayout) {
                Surface surface{&kTorus, glm::dvec3(call.length(0))};
                surface.form.x = call.length(1) / call.length(0);
                return surface;
            }};
}

}  // namespace farol::generator::primitives
