#include "generator/fineness.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace farol::generator {

double circleDivisions(double radius, double error, const Fineness& fineness) {
    const double share = error / radius;
    // Balanced, (1 - c) / (1 + c) <= share, c the cosine of half a division.
    const double depth = fineness.balanced ? 2.0 * share / (1.0 + share) : share;
    const double half = std::sqrt(std::min(1.0, depth / 2.0));
    const double divisions = std::ceil(std::numbers::pi / (2.0 * std::asin(half)));
    return roundUpToStep(std::clamp(divisions, fineness.fullTurn, kMaxDivisions));
}

double sphereDivisions(double radius, double error, const Fineness& fineness) {
    const double share = std::min(1.0, error / radius);
    // The middle of a facet's longest side is nearest, at sqrt(cos a) for divisions of a.
    const double loss =
        fineness.balanced ? 4.0 * share / ((1.0 + share) * (1.0 + share)) : share * (2.0 - share);
    const double divisions = std::ceil(std::numbers::pi / std::asin(std::sqrt(loss / 2.0)));
    return roundUpToStep(std::clamp(divisions, fineness.fullTurn, kMaxDivisions));
}

double roundUpToStep(double divisions) {
    double power = 1.0;
    while (power < divisions && power < kMaxDivisions) {
        // Between 2^k and 2^(k+1) stands 1.5 * 2^k, from 16 on quarters.
        if (power >= 16.0 && divisions <= 1.25 * power) return 1.25 * power;
        if (power >= 2.0 && divisions <= 1.5 * power) return 1.5 * power;
        if (power >= 16.0 && divisions <= 1.75 * power) return 1.75 * power;
        power *= 2.0;
    }
    return power;
}

}  // namespace farol::generator
