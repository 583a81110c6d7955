#include "generator/primitives/ellipsoid.h"

#include <algorithm>

#include "generator/primitives/sphere.h"

namespace farol::generator::primitives {

Entry ellipsoidEntry() {
    return {
        {"ellipsoid",
         "an ellipsoid about the origin, poles on Y",
         {lengthArgument("RX", "half axis along X"), lengthArgument("RY", "half axis along Y"),
          lengthArgument("RZ", "half axis along Z"),
          levelArgument("SLICES", 3, kDefaultSlices, "divisions about Y"),
          levelArgument("STACKS", 2, kDefaultStacks, "divisions from pole to pole")},
         3,
         false},
        [](const Call& call, const std::string&, scene::UvLayout uv) {
            return ellipsoid({call.length(0), call.length(1), call.length(2)}, call.count(3),
                             call.count(4), uv);
        },
        [](const Call& call, const std::string&) {
            return 2 * call.count(3) * (call.count(4) - 1);
        },
        nullptr,
        [](const Call& call, const std::string&, const Fineness& fineness) {
            const double rx = call.length(0), ry = call.length(1), rz = call.length(2);
            // Facets deviate along the longest axis too, whichever way they were cut.
            const double slices = sphereDivisions(std::max({rx, ry, rz}), fineness.error, fineness);
            return std::vector<double>{slices, slices / 2};
        },
        [](const Call& call, scene::UvLayout uv) {
            return ellipsoidSurface({call.length(0), call.length(1), call.length(2)}, uv);
        }};
}

}  // namespace farol::generator::primitives
