#include "scene/animation.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

namespace farol::scene {
namespace {

/// The part of a period that has passed at `timeS`, 0 <= lap < 1, exact in double.
double lapAt(double timeS, double seconds) {
    double lap = std::fmod(timeS, seconds) / seconds;
    if (lap < 0.0) lap += 1.0;
    return lap < 1.0 ? lap : 0.0;
}

/// Cosine and sine of degrees; exact for quarter turns.
glm::dvec2 turnDeg(double angleDeg) {
    const double reduced = std::fmod(angleDeg, 360.0);
    if (std::fmod(reduced, 90.0) == 0.0) {
        static constexpr glm::dvec2 kQuarters[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
        const int quarter = static_cast<int>(reduced / 90.0);
        return kQuarters[(quarter + 4) % 4];
    }
    const double angle = reduced * (std::numbers::pi / 180.0);
    return {std::cos(angle), std::sin(angle)};
}

/// Rodrigues' formula; a zero axis is no turn.
glm::dmat4 turnMatrix(const glm::dvec3& axis, double angleDeg) {
    const double length = glm::length(axis);
    if (!(length > 0.0)) return glm::dmat4(1.0);
    const glm::dvec3 a = axis / length;
    const glm::dvec2 turn = turnDeg(angleDeg);
    const double c = turn.x, s = turn.y, k = 1.0 - c;
    glm::dmat4 m(1.0);
    m[0] = {a.x * a.x * k + c, a.x * a.y * k + a.z * s, a.x * a.z * k - a.y * s, 0.0};
    m[1] = {a.x * a.y * k - a.z * s, a.y * a.y * k + c, a.y * a.z * k + a.x * s, 0.0};
    m[2] = {a.x * a.z * k + a.y * s, a.y * a.z * k - a.x * s, a.z * a.z * k + c, 0.0};
    return m;
}

/// The part of `v` across the unit vector `x`, of unit length; zero where there is hardly any.
glm::dvec3 across(const glm::dvec3& v, const glm::dvec3& x) {
    // Below this share of v's length, rounding decides the direction.
    constexpr double kMinShare = 1e-6;
    const glm::dvec3 rest = v - x * glm::dot(v, x);
    const double length = glm::length(rest);
    return length > kMinShare * glm::length(v) ? rest / length : glm::dvec3(0.0);
}

/// An orthonormal frame that moves along a curve: x the tangent, y the up, z = x cross y.
struct Frame {
    glm::dvec3 x{0.0}, y{0.0, 1.0, 0.0};
    bool placed = false;

    /// Turns to the next tangent; none (coincident points) leaves the frame as it is.
    void advance(const glm::dvec3& tangent) {
        const double length = glm::length(tangent);
        if (!(length > 0.0)) return;
        const glm::dvec3 next = tangent / length;
        glm::dvec3 up = across(y, next);
        // The up is along the tangent: go on with the old side vector, else with an axis.
        if (up == glm::dvec3(0.0) && placed) up = across(glm::cross(glm::cross(x, y), next), next);
        if (up == glm::dvec3(0.0)) {
            const glm::dvec3 size = glm::abs(next);
            const bool zLeast = size.z <= size.x && size.z <= size.y;
            up = across(zLeast             ? glm::dvec3(0, 0, 1)
                        : size.x <= size.y ? glm::dvec3(1, 0, 0)
                                           : glm::dvec3(0, 1, 0),
                        next);
        }
        x = next;
        y = up;
        placed = true;
    }
};

/// Returns the frame at lap fraction `u`, transported from u = 0. Spreads the rotation of the up
/// vector about the tangent over the lap (a curve in space has one): laps join without a jump.
Frame frameAt(const std::vector<glm::dvec3>& points, double u) {
    const int steps =
        std::clamp(32 * static_cast<int>(std::min<std::size_t>(points.size(), 256)), 256, 8192);
    const auto tangentAt = [&points](double at) { return catmullRom(points, at).tangent; };
    Frame moving, wanted;
    moving.advance(tangentAt(0.0));
    const Frame first = moving;
    const int before = static_cast<int>(std::floor(u * steps));
    for (int i = 1; i <= steps; ++i) {
        if (i == before + 1) {
            wanted = moving;
            wanted.advance(tangentAt(u));
        }
        moving.advance(tangentAt(static_cast<double>(i % steps) / steps));
    }
    if (!first.placed || !wanted.placed) return wanted;
    const double residual =
        std::atan2(glm::dot(glm::cross(first.y, moving.y), first.x), glm::dot(first.y, moving.y));
    const double angle = -residual * u;
    wanted.y = std::cos(angle) * wanted.y + std::sin(angle) * glm::cross(wanted.x, wanted.y);
    return wanted;
}

glm::dmat4 curveMatrix(const FollowCurve& curve, double timeS) {
    const double u = lapAt(timeS, curve.seconds);
    glm::dmat4 m(1.0);
    if (curve.align) {
        const Frame frame = frameAt(curve.points, u);
        if (frame.placed) {
            m[0] = glm::dvec4(frame.x, 0.0);
            m[1] = glm::dvec4(frame.y, 0.0);
            m[2] = glm::dvec4(glm::cross(frame.x, frame.y), 0.0);
        }
    }
    m[3] = glm::dvec4(catmullRom(curve.points, u).position, 1.0);
    return m;
}

struct MatrixOf {
    double timeS;
    glm::dmat4 operator()(const Translate& t) const {
        return glm::translate(glm::dmat4(1.0), t.offset);
    }
    glm::dmat4 operator()(const FollowCurve& t) const { return curveMatrix(t, timeS); }
    glm::dmat4 operator()(const Rotate& t) const { return turnMatrix(t.axis, t.angleDeg); }
    glm::dmat4 operator()(const Spin& t) const {
        const double turn = 360.0 * lapAt(timeS, std::abs(t.seconds));
        return turnMatrix(t.axis, t.seconds < 0.0 ? -turn : turn);
    }
    glm::dmat4 operator()(const Scale& t) const { return glm::scale(glm::dmat4(1.0), t.factors); }
};

/// splitmix64: a small generator whose numbers are the same everywhere.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    double unit() {  // 0 <= unit < 1
        state_ += 0x9E3779B97F4A7C15U;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
        return static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1.0p-53;
    }

  private:
    std::uint64_t state_;
};

bool cycles(const Material& m) {
    return m.diffuse.cycles || m.ambient.cycles || m.specular.cycles || m.emissive.cycles;
}

bool cycles(const std::vector<Light>& lights) {
    return std::any_of(lights.begin(), lights.end(), [](const Light& light) {
        return light.diffuse.cycles || light.ambient.cycles || light.specular.cycles;
    });
}

bool isAnimated(const std::vector<Group>& groups) {
    return std::any_of(groups.begin(), groups.end(), [](const Group& group) {
        return cycles(group.lights) || isAnimated(group.groups) ||
               std::any_of(group.transforms.begin(), group.transforms.end(),
                           [](const Transform& t) {
                               return std::holds_alternative<FollowCurve>(t) ||
                                      std::holds_alternative<Spin>(t);
                           }) ||
               std::any_of(group.models.begin(), group.models.end(), [](const Model& model) {
                   return model.material && cycles(*model.material);
               });
    });
}

}  // namespace

CurvePoint catmullRom(const std::vector<glm::dvec3>& points, double u) {
    if (points.empty()) return {glm::dvec3(0.0), glm::dvec3(0.0)};
    const std::size_t n = points.size();
    const double along = lapAt(u, 1.0) * static_cast<double>(n);
    const std::size_t at = std::min(static_cast<std::size_t>(along), n - 1);
    const double t = along - static_cast<double>(at);
    const glm::dvec3& a = points[(at + n - 1) % n];
    const glm::dvec3& b = points[at];
    const glm::dvec3& c = points[(at + 1) % n];
    const glm::dvec3& d = points[(at + 2) % n];
    const glm::dvec3 k1 = 0.5 * (c - a);
    const glm::dvec3 k2 = a - 2.5 * b + 2.0 * c - 0.5 * d;
    const glm::dvec3 k3 = 1.5 * (b - c) + 0.5 * (d - a);
    return {b + t * (k1 + t * (k2 + t * k3)),
            (k1 + t * (2.0 * k2 + t * 3.0 * k3)) * static_cast<double>(n)};
}

glm::dmat4 matrixAt(const Transform& transform, double timeS) {
    return std::visit(MatrixOf{timeS}, transform);
}

glm::dmat4 matrixAt(const std::vector<Transform>& transforms, double timeS) {
    glm::dmat4 product(1.0);
    for (const Transform& one : transforms) product = product * matrixAt(one, timeS);
    return product;
}

glm::vec3 colorAt(const Color& color, double timeS) {
    if (!color.cycles) return color.rgb;
    const double hue = 6.0 * lapAt(timeS, kHueSeconds);
    const auto channel = [hue](double center) {  // 1 within one sixth of its hue, 0 beyond two
        double away = std::abs(hue - center);
        away = std::min(away, 6.0 - away);
        return static_cast<float>(std::clamp(2.0 - away, 0.0, 1.0));
    };
    return {channel(0.0), channel(2.0), channel(4.0)};
}

std::vector<glm::dmat4> scatterMatrices(const Scatter& scatter, std::uint64_t seed) {
    std::vector<glm::dmat4> places;
    Random random(seed);
    const double inner = std::min(scatter.radiusMin, scatter.radiusMax);
    const double outer = std::max(scatter.radiusMin, scatter.radiusMax);
    for (int i = 0; i < scatter.count; ++i) {
        const double share = random.unit();  // of the ring's area: evenly distributed
        const double radius = std::sqrt(inner * inner + share * (outer * outer - inner * inner));
        const double angle = 2.0 * std::numbers::pi * random.unit();
        const double y = scatter.yMin + random.unit() * (scatter.yMax - scatter.yMin);
        places.push_back(glm::translate(
            glm::dmat4(1.0), glm::dvec3(radius * std::sin(angle), y, radius * std::cos(angle))));
    }
    return places;
}

bool isAnimated(const Scene& scene) {
    return cycles(scene.lights) || isAnimated(scene.groups) ||
           (scene.entity && isAnimated(*scene.entity));
}

}  // namespace farol::scene
