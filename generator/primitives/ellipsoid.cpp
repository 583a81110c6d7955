#include "generator/primitives/ellipsoid.h"

#include <algorithm>

#include "generator/primitives/sphere.h"

namespace farol::generator::primitives {

ShapeEntry ellipsoidEntry() {
    static constexpr auto radiiOf = [](const ShapeCall& call) {
        return glm::dvec3(call.length(0), call.length(1), call.length(2));
    };
    return {
        .name = "ellipsoid",
        .aliases = {"elipsoide"},
        .summary = "an ellipsoid about the origin, poles on Y",
        .arguments = {lengthArgument("RX", "half axis along X"),
                      lengthArgument("RY", "half axis along Y"),
                      lengthArgument("RZ", "half axis along Z"),
                      levelArgument("SLICES", 3, kDefaultSlices, "divisions about Y"),
                      levelArgument("STACKS", 2, kDefaultStacks, "divisions from pole to pole")},
        .required = 3,
        .generate =
            [](const ShapeCall& call, const std::string&, scene::UvLayout uv) {
                return ellipsoid(radiiOf(call), call.count(3), call.count(4), uv);
            },
        .count = [](const ShapeCall& call,
                    const std::string&) { return 2 * call.count(3) * (call.count(4) - 1); },
        .bound =
            [](const ShapeCall& call, const std::string&, const Fineness& fineness) {
                const glm::dvec3 radii = radiiOf(call);
                // Facets deviate along the longest axis too, whichever way they were cut.
                const double slices = sphereDivisions(std::max({radii.x, radii.y, radii.z}),
                                                      fineness.error, fineness);
                return std::vector<double>{slices, slices / 2};
            },
        .surface = [](const ShapeCall& call,
                      scene::UvLayout uv) { return ellipsoidSurface(radiiOf(call), uv); }};
}

}  // namespace farol::generator::primitives
