#include "generator/primitives/cylinder.h"

#include "generator/primitives/frustum.h"

namespace farol::generator::primitives {

ShapeEntry cylinderEntry() {
    return {.name = "cylinder",
            .aliases = {"cilindro"},
            .summary = "a closed cylinder, base in XZ, top at y = HEIGHT",
            .arguments = {lengthArgument("RADIUS", "radius"), lengthArgument("HEIGHT", "height"),
                          levelArgument("SLICES", 3, kDefaultSlices, "divisions about Y"),
                          levelArgument("STACKS", 1, 1, "divisions of the side along its height")},
            .required = 2,
            .generate =
                [](const ShapeCall& call, const std::string&, scene::UvLayout uv) {
                    return frustum(call.length(0), call.length(0), call.length(1), call.count(2),
                                   call.count(3), uv, FrustumAtlas::cylinder);
                },
            .count =
                [](const ShapeCall& call, const std::string&) {
                    return frustumTriangles(1, 1, call.count(2), call.count(3));
                },
            .bound =
                [](const ShapeCall& call, const std::string&, const Fineness& fineness) {
                    // Straight along its side: the height needs no divisions for its shape.
                    return std::vector<double>{
                        circleDivisions(call.length(0), fineness.error, fineness),
                        call.entry->arguments[3].fallback};
                },
            .surface =
                [](const ShapeCall& call, scene::UvLayout uv) {
                    return frustumSurface(call.length(0), call.length(0), call.length(1), uv,
                                          FrustumAtlas::cylinder);
                }};
}

}  // namespace farol::generator::primitives
