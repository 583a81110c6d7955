#include "generator/primitives/ring.h"

#include "generator/builder.h"
#include "generator/messages.h"

namespace farol::generator::primitives {
namespace {

/// In q.y = 0 between the radii form.x and 1.
constexpr SurfaceKind kRing{
    .distance =
        [](const Surface& surface, const glm::dvec3& eye) {
            return distanceToSegment(aboutY(eye), {surface.form.x, 0.0}, {1.0, 0.0});
        },
    // Flat: light alone needs nothing.
    .isNeeded = [](const Surface&, double, bool textured) { return textured; },
    .fullTurn = fullTurnOfSlices,
    .balance = [](const std::vector<double>& levels) { return balanceOfSlices(levels.at(0)); },
    .hasCaps = true,
    .glsl = R"(
vec3 sideGradient(vec3 q) { return vec3(0.0, cap, 0.0); }
#ifdef TEXTURED
float shareOf(vec3 q) { return (length(q.xz) - surfaceForm.x) / (1.0 - surfaceForm.x); }
float shareChange(vec3 q, vec3 step) {
    return dot(q.xz, step.xz) / (length(q.xz) * (1.0 - surfaceForm.x));
}
#endif
)"};

}  // namespace

Mesh ring(double inner, double outer, std::size_t slices) {
    Builder builder(4 * (slices + 1), 4 * slices);
    for (const bool up : {true, false}) {
        const glm::dvec3 normal(0, up ? 1 : -1, 0);
        const std::uint32_t start = builder.next();
        for (std::size_t i = 0; i <= slices; ++i) {
            const SinCos a = turn(i, slices);
            // At the middle of a disc, each slice has its own texture coordinate.
            const double shift = inner == 0 ? 0.5 / static_cast<double>(slices) : 0;
            const double u = fraction(i, slices);
            builder.vertex({inner * a.sin, 0, inner * a.cos}, normal,
                           {std::min(u + shift, 1.0), 0});
            builder.vertex({outer * a.sin, 0, outer * a.cos}, normal, {u, 1});
        }
        for (std::uint32_t i = 0; i < slices; ++i) {
            const std::uint32_t in = start + 2 * i, out = in + 1, inNext = in + 2, outNext = in + 3;
            builder.triangle(in, up ? out : outNext, up ? outNext : out);
            builder.triangleUnlessFlat(in, up ? outNext : inNext, up ? inNext : outNext);
        }
    }
    return builder.take();
}

ShapeEntry ringEntry() {
    Argument inner = lengthArgument("INNER", "radius of the hole; 0 is a disc", 0.5);
    inner.min = 0;
    return {
        .name = "ring",
        .aliases = {"anel", "anillo", "aro"},
        .summary = "a flat ring in XZ about the origin, with faces up and down",
        .arguments = {inner, lengthArgument("OUTER", "outer radius, over INNER"),
                      levelArgument("SLICES", 3, 2 * kDefaultSlices, "divisions about Y")},
        .required = 2,
        .generate =
            [](const ShapeCall& call, const std::string&, scene::UvLayout) {
                return ring(call.length(0), call.length(1), call.count(2));
            },
        .count = [](const ShapeCall& call,
                    const std::string&) { return call.count(2) * (call.length(0) > 0 ? 4U : 2U); },
        .isExchanged = [](const ShapeCall& call) { return call.length(0) > call.length(1); },
        .check = [](const ShapeCall& call) -> Message {
            // A narrower ring folds in floats.
            constexpr double kMinWidth = 1e-4;
            const double hole = call.length(0), outer = call.length(1);
            if (hole >= outer)
                return message<"part.ring-order">("inner"_arg = hole, "outer"_arg = outer);
            if (outer - hole < kMinWidth * outer) return message<"part.ring-narrow">();
            if (hole > 0 && hole < kMinLength)
                return message<"part.ring-small">("inner"_arg = hole);
            return {};
        },
        .bound =
            [](const ShapeCall& call, const std::string&, const Fineness& fineness) {
                return std::vector<double>{
                    circleDivisions(call.length(1), fineness.error, fineness)};
            },
        .surface =
            [](const ShapeCall& call, scene::UvLayout) {
                Surface surface{&kRing, glm::dvec3(call.length(1))};
                surface.form.x = call.length(0) / call.length(1);
                return surface;
            }};
}

}  // namespace farol::generator::primitives
