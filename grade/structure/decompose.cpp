#include <algorithm>
#include <cmath>

#include "grade/structure/slips.h"

namespace farol::grade {
namespace {

using scene::Rotate;
using scene::Scale;
using scene::Transform;
using scene::Translate;

glm::dvec3 directionOf(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : glm::dvec3(0, 1, 0);
}

}  // namespace

std::optional<Transform> asTransform(const glm::dmat4& m, std::size_t kind) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(m[column][row])) return std::nullopt;
    const glm::dvec3 offset(m[3]);
    const glm::dmat3 linear(m);
    constexpr double kLoose = 0.03;  // after rounding in the rest of the chain
    const auto isIdentity = [&] {
        for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 3; ++row)
                if (std::abs(linear[column][row] - (column == row ? 1.0 : 0.0)) > kLoose)
                    return false;
        return true;
    };
    if (kind == 0) {
        if (!isIdentity()) return std::nullopt;
        glm::dvec3 tidied = offset;
        for (int i = 0; i < 3; ++i) tidied[i] = tidy(offset[i]);
        return Translate{tidied};
    }
    if (kind == 4) {
        const glm::dvec3 factors(linear[0][0], linear[1][1], linear[2][2]);
        const double most =
            std::max({std::abs(factors.x), std::abs(factors.y), std::abs(factors.z), 1e-9});
        for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 3; ++row)
                if (column != row && std::abs(linear[column][row]) > kLoose * most)
                    return std::nullopt;
        glm::dvec3 tidied = factors;
        for (int i = 0; i < 3; ++i) tidied[i] = tidy(factors[i]);
        return Scale{tidied};
    }
    if (kind != 2) return std::nullopt;
    const glm::dmat3 gram = linear * glm::transpose(linear);
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            if (std::abs(gram[column][row] - (column == row ? 1.0 : 0.0)) > kLoose)
                return std::nullopt;
    if (glm::determinant(linear) < 0.0) return std::nullopt;
    const double cosine =
        std::clamp((linear[0][0] + linear[1][1] + linear[2][2] - 1.0) / 2.0, -1.0, 1.0);
    double angle = glm::degrees(std::acos(cosine));
    glm::dvec3 axis(linear[1][2] - linear[2][1], linear[2][0] - linear[0][2],
                    linear[0][1] - linear[1][0]);
    if (glm::length(axis) < 1e-6) {
        if (cosine > 0.0) return Rotate{0.0, glm::dvec3(0, 1, 0)};
        // Half a turn: the axis is the eigenvector of 1.
        for (int i = 0; i < 3; ++i) {
            glm::dvec3 column = linear[i];
            column[i] += 1.0;
            if (glm::length(column) > glm::length(axis)) axis = column;
        }
        angle = 180.0;
    }
    axis = directionOf(axis);
    for (int i = 0; i < 3; ++i) axis[i] = tidy(axis[i]);
    return Rotate{tidy(angle), axis};
}

std::optional<std::vector<Transform>> decomposed(const glm::dmat4& matrix) {
    glm::dmat3 linear(matrix);
    glm::dvec3 factors(glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2]));
    if (!(factors.x * factors.y * factors.z > 1e-18)) return std::nullopt;
    glm::dmat3 turn(linear[0] / factors.x, linear[1] / factors.y, linear[2] / factors.z);
    for (int i = 0; i < 3; ++i)
        if (std::abs(glm::dot(turn[i], turn[(i + 1) % 3])) > 0.01) return std::nullopt;
    if (glm::determinant(turn) < 0.0) {
        // A mirror: of the axis that leaves the least turn.
        int best = 2;
        double most = -4.0;
        for (int i = 0; i < 3; ++i) {
            glm::dmat3 tried = turn;
            tried[i] = -tried[i];
            const double trace = tried[0][0] + tried[1][1] + tried[2][2];
            if (trace > most) {
                most = trace;
                best = i;
            }
        }
        turn[best] = -turn[best];
        factors[best] = -factors[best];
    }
    std::vector<Transform> out;
    if (glm::length(glm::dvec3(matrix[3])) > 1e-6) {
        glm::dvec3 offset(matrix[3]);
        for (int i = 0; i < 3; ++i) offset[i] = tidy(offset[i]);
        out.push_back(Translate{offset});
    }
    const auto rotate = asTransform(glm::dmat4(turn), 2);
    if (!rotate) return std::nullopt;
    if (std::abs(std::get<Rotate>(*rotate).angleDeg) > 1e-3) out.push_back(*rotate);
    for (int i = 0; i < 3; ++i) factors[i] = tidy(factors[i]);
    if (glm::length(factors - glm::dvec3(1.0)) > 1e-6) out.push_back(Scale{factors});
    return out;
}

}  // namespace farol::grade
