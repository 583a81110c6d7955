#pragma once

#include <array>
#include <span>

namespace farol::reference {

/// Real roots in ascending order; a touching double root may be left out.
struct Roots {
    std::array<double, 4> at{};
    int count = 0;
    void add(double root) { at[static_cast<std::size_t>(count++)] = root; }
    const double* begin() const { return at.data(); }
    const double* end() const { return at.data() + count; }
};

/// a t^2 + b t + c = 0 without cancellation; a may be 0.
Roots solveQuadratic(double a, double b, double c);

/// c[0] + c[1] t + ... = 0 in [low, high], degree 1 to 4. The roots of the derivative part the
/// interval into monotone stretches; in each a bracketed Newton iteration ends at rounding.
Roots solvePolynomial(std::span<const double> c, double low, double high);

}  // namespace farol::reference
