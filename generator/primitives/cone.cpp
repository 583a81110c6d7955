#include "generator/primitives/cone.h"

#include "generator/primitives/frustum.h"

namespace farol::generator::primitives {

ShapeEntry coneEntry() {
    return {.name = "cone",
            .aliases = {"cono"},
            .summary = "a cone, base in XZ, apex at y = HEIGHT",
            .arguments = {lengthArgument("RADIUS", "radius of the base"),
                          lengthArgument("HEIGHT", "height"),
                          levelArgument("SLICES", 3, kDefaultSlices, "divisions about Y"),
                          levelArgument("STACKS", 1, 8, "divisions of the side along its height")},
            .required = 2,
            .generate =
                [](const ShapeCall& call, const std::string&, scene::UvLayout uv) {
                    return frustum(call.length(0), 0, call.length(1), call.count(2), call.count(3),
                                   uv, FrustumAtlas::cone);
                },
            .count =
                [](const ShapeCall& call, const std::string&) {
                    return frustumTriangles(call.length(0), 0, call.count(2), call.count(3));
                },
            .bound =
                [](const ShapeCall& call, const std::string&, const Fineness& fineness) {
                    // Straight along its side: the height needs no divisions for its shape, but for
                    // its shading.
                    return std::vector<double>{
                        circleDivisions(call.length(0), fineness.error, fineness),
                        roundUpToStep(fineness.straightSide)};
                },
            .surface =
                [](const ShapeCall& call, scene::UvLayout uv) {
                    return frustumSurface(call.length(0), 0, call.length(1), uv,
                                          FrustumAtlas::cone);
                }};
}

}  // namespace farol::generator::primitives
