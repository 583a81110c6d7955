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

Entry planeEntry() {
    Argument divisions{"DIV", true, 1, kMaxCount, "divisions a side", 1};
    return {{"plane",
             "a square in XZ, centred at the origin, facing +Y",
             {lengthArgument("SIZE", "length of an edge"), divisions},
             1,
             false},
            [](const Call& call, const std::string&, scene::UvLayout) {
                return plane(call.length(0), call.count(1));
            },
            [](const Call& call, const std::string&) { return 2 * call.count(1) * call.count(1); }};
}

}  // namespace farol::generator::primitives
