#include "generator/primitives/torus.h"

#include "generator/builder.h"

namespace farol::generator::primitives {

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

Entry torusEntry() {
    return {{"torus",
             "a torus about the origin, lying in XZ",
             {lengthArgument("RING", "radius from the centre to the middle of the tube"),
              lengthArgument("TUBE", "radius of the tube, less than RING"),
              levelArgument("SLICES", 3, 1.5 * kDefaultSlices, "divisions round the ring"),
              levelArgument("SIDES", 3, 24, "divisions round the tube")},
             2,
             false},
            [](const Call& call, const std::string&, scene::UvLayout) {
                return torus(call.length(0), call.length(1), call.count(2), call.count(3));
            },
            [](const Call& call, const std::string&) { return 2 * call.count(2) * call.count(3); },
            [](const Call& call) -> std::string {
                // Thinner tubes fold in floats: a float holds 1e-7 of the ring's radius.
                constexpr double kThinnest = 1e-4;
                const double ring = call.length(0), tube = call.length(1);
                if (tube >= ring) return "the argument TUBE of torus must be less than RING";
                if (tube < kThinnest * ring)
                    return "the argument TUBE of torus must be at least 0.0001 of RING";
                return "";
            },
            [](const Call& call, const std::string&, const Fineness& fineness) {
                const double ring = call.length(0), tube = call.length(1);
                return std::vector<double>{
                    circleDivisions(ring + tube, fineness.error / 2, fineness),
                    // The tube is never balanced: no scale does that.
                    circleDivisions(tube, fineness.error / (fineness.balanced ? 4 : 2), fineness)};
            },
            [](const Call& call, scene::UvLayout) {
                Surface surface{Surface::Kind::torus, glm::dvec3(call.length(0))};
                surface.form.x = call.length(1) / call.length(0);
                return surface;
            }};
}

}  // namespace farol::generator::primitives
