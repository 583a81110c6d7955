#include "generator/primitives/plane.h"

#include "generator/builder.h"

namespace farol::generator::primitives {

Mesh plane(double size, std::size_t divisions) {
    const std::size_t n = divisions;
    Builder builder((n + 1) * (n + 1), 2 * n * n);
    for (std::size_t k = 0; k <= n; ++k) {
        for (std::size_t i = 0; i <= n; ++i) {
            const double u = fraction(i, n), w = fraction(k, n);
            builder.vertex({size * (u - 0.5), 0, size * (w - 0.5)}, {0, 1, 0}, {u, 1 - w});
        }
    }
    const auto at = [n](std::size_t i, std::size_t k) {
        return static_cast<std::uint32_t>(k * (n + 1) + i);
    };
    for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t i = 0; i < n; ++i) {
            builder.triangle(at(i, k), at(i, k + 1), at(i + 1, k + 1));
            builder.triangle(at(i, k), at(i + 1, k + 1), at(i + 1, k));
        }
    }
    return builder.take();
}

ShapeEntry planeEntry() {
    return {.name = "plane",
            .aliases = {"plano"},
            .summary = "a square in XZ, centred at the origin, facing +Y",
            .arguments = {lengthArgument("SIZE", "length of an edge"),
                          countArgument("DIV", 1, 1, "divisions a side")},
            .required = 1,
            .isSheet = true,
            .generate = [](const ShapeCall& call, const std::string&,
                           scene::UvLayout) { return plane(call.length(0), call.count(1)); },
            .count = [](const ShapeCall& call,
                        const std::string&) { return 2 * call.count(1) * call.count(1); }};
}

}  // namespace farol::generator::primitives
