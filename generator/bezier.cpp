#include "generator/bezier.h"

#include <cmath>

namespace farol::generator {
namespace {

using glm::dvec3;

/// The Bernstein weights of a cubic and of its derivatives at t, given with s = 1 - t so that
/// both ends are alike.
struct Basis {
    std::array<double, 4> value, first, second;

    Basis(double t, double s)
        : value{s * s * s, 3 * (t * (s * s)), 3 * (s * (t * t)), t * t * t},
          first{-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t},
          second{6 * s, 6 * t - 12 * s, 6 * s - 12 * t, 6 * t} {}
};

/// Weighted sum, first with last and second with third: the same bits in either direction.
dvec3 sum(const std::array<double, 4>& w, const dvec3& a, const dvec3& b, const dvec3& c,
          const dvec3& d) {
    return (w[0] * a + w[3] * d) + (w[1] * b + w[2] * c);
}

/// The curve's point; a curve whose points coincide is that point exactly.
dvec3 curve(const std::array<double, 4>& w, const dvec3& a, const dvec3& b, const dvec3& c,
            const dvec3& d) {
    return a == b && b == c && c == d ? a : sum(w, a, b, c, d);
}

dvec3 apply(const BezierPatch& p, const std::array<double, 4>& u, const std::array<double, 4>& v) {
    std::array<dvec3, 4> rows{};
    for (std::size_t r = 0; r < 4; ++r)
        rows[r] = sum(u, p[4 * r], p[4 * r + 1], p[4 * r + 2], p[4 * r + 3]);
    return sum(v, rows[0], rows[1], rows[2], rows[3]);
}

dvec3 pointAt(const BezierPatch& p, const Basis& u, const Basis& v) {
    std::array<dvec3, 4> rows{};
    for (std::size_t r = 0; r < 4; ++r)
        rows[r] = curve(u.value, p[4 * r], p[4 * r + 1], p[4 * r + 2], p[4 * r + 3]);
    return curve(v.value, rows[0], rows[1], rows[2], rows[3]);
}

/// The cross product of the tangents, or where it vanishes against their lengths its limit from
/// inside along u or v: the derivative of dPu x dPv, with the sign of the end (accuracy notes).
dvec3 normalDirection(const BezierPatch& p, double s, double t, bool& found) {
    const Basis u(s, 1 - s), v(t, 1 - t);
    const dvec3 du = apply(p, u.first, v.value), dv = apply(p, u.value, v.first);
    // Relative, so that the size of the model does not matter; 1e-5 is far above rounding and
    // far below the angle between the tangents of a patch that is not collapsed.
    constexpr double kFlat = 1e-5;
    const double size = glm::dot(du, du) + glm::dot(dv, dv);
    found = true;
    const dvec3 n = glm::cross(du, dv);
    if (glm::length(n) > kFlat * size) return n;
    const dvec3 duv = apply(p, u.first, v.first);
    const dvec3 duu = apply(p, u.second, v.value), dvv = apply(p, u.value, v.second);
    const double endU = s < 0.5 ? 1 : -1, endV = t < 0.5 ? 1 : -1;
    const dvec3 alongU = endU * (glm::cross(duu, dv) + glm::cross(du, duv));
    const dvec3 alongV = endV * (glm::cross(duv, dv) + glm::cross(du, dvv));
    // A collapsed edge u = const has no length along v, and the other way round.
    const bool edgeU = glm::dot(dv, dv) <= glm::dot(du, du);
    const dvec3 limit = edgeU ? alongU : alongV;
    const double scale = size + glm::length(duu) * glm::length(duu) +
                         glm::length(dvv) * glm::length(dvv) + glm::length(duv) * glm::length(duv);
    if (glm::length(limit) > kFlat * scale) return limit;
    found = glm::length(n) > 0 && glm::length(n) > 1e-12 * scale;
    return n;
}

/// The basis at index/count.
Basis basisAt(std::size_t index, std::size_t count) {
    const double n = static_cast<double>(count);
    return {static_cast<double>(index) / n, static_cast<double>(count - index) / n};
}

}  // namespace

dvec3 positionAt(const BezierPatch& patch, std::size_t column, std::size_t row, std::size_t columns,
                 std::size_t rows) {
    return pointAt(patch, basisAt(column, columns), basisAt(row, rows));
}

PatchBend bendAt(const BezierPatch& patch, std::size_t column, std::size_t row, std::size_t columns,
                 std::size_t rows) {
    const Basis u = basisAt(column, columns), v = basisAt(row, rows);
    return {apply(patch, u.first, v.value), apply(patch, u.value, v.first),
            apply(patch, u.second, v.value), apply(patch, u.first, v.first),
            apply(patch, u.value, v.second)};
}

PatchPoint evaluate(const BezierPatch& patch, std::size_t column, std::size_t row,
                    std::size_t columns, std::size_t rows) {
    const double s = static_cast<double>(column) / static_cast<double>(columns);
    const double t = static_cast<double>(row) / static_cast<double>(rows);
    PatchPoint out{positionAt(patch, column, row, columns, rows), {0, 1, 0}};
    // Corners where two edges collapse: step towards the middle until the surface shows itself.
    bool found = false;
    for (const double step : {0.0, 1e-3, 1e-2, 0.1, 0.3}) {
        const dvec3 direction =
            normalDirection(patch, s + (0.5 - s) * step, t + (0.5 - t) * step, found);
        if (!found) continue;
        out.normal = glm::normalize(direction);
        break;
    }
    return out;
}

}  // namespace farol::generator
