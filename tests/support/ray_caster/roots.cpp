#include "tests/support/ray_caster/roots.h"

#include <algorithm>
#include <cmath>

namespace farol::reference {
namespace {

double valueAt(std::span<const double> c, double t) {
    double sum = 0.0;
    for (std::size_t i = c.size(); i-- > 0;) sum = sum * t + c[i];
    return sum;
}

double slopeAt(std::span<const double> c, double t) {
    double sum = 0.0;
    for (std::size_t i = c.size(); i-- > 1;) sum = sum * t + c[i] * static_cast<double>(i);
    return sum;
}

/// The root between `low` and `high`, whose values differ in sign.
double bracketed(std::span<const double> c, double low, double high) {
    const bool rising = valueAt(c, low) < 0.0;
    double t = 0.5 * (low + high);
    for (int i = 0; i < 200; ++i) {
        const double value = valueAt(c, t);
        if (value == 0.0) return t;
        ((value < 0.0) == rising ? low : high) = t;
        const double newton = t - value / slopeAt(c, t);
        const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
        if (next == t || next == low || next == high) return next;
        t = next;
    }
    return t;
}

}  // namespace

Roots solveQuadratic(double a, double b, double c) {
    Roots roots;
    const double discriminant = b * b - 4.0 * a * c;
    if (!(discriminant >= 0.0)) return roots;
    const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
    for (const double root : {q / a, q == 0.0 ? q / a : c / q})
        if (std::isfinite(root)) roots.add(root);
    if (roots.count == 2 && roots.at[0] > roots.at[1]) std::swap(roots.at[0], roots.at[1]);
    return roots;
}

Roots solvePolynomial(std::span<const double> c, double low, double high) {
    Roots roots;
    const std::size_t degree = c.size() - 1;
    if (degree == 1) {
        const double t = -c[0] / c[1];
        if (t >= low && t <= high) roots.add(t);
        return roots;
    }
    std::array<double, 4> derivative{};
    for (std::size_t i = 1; i <= degree; ++i) derivative[i - 1] = c[i] * static_cast<double>(i);
    const Roots turning = solvePolynomial(std::span(derivative.data(), degree), low, high);
    double from = low;
    for (int i = 0; i <= turning.count; ++i) {
        const double to = i < turning.count ? turning.at[static_cast<std::size_t>(i)] : high;
        const double a = valueAt(c, from), b = valueAt(c, to);
        if ((a < 0.0) != (b < 0.0)) roots.add(bracketed(c, from, to));
        from = to;
    }
    return roots;
}

}  // namespace farol::reference
