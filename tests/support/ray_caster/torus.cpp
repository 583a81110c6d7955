#include <cmath>
#include <numbers>

#include "tests/support/ray_caster/angles.h"
#include "tests/support/ray_caster/roots.h"
#include "tests/support/ray_caster/shape.h"

namespace farol::reference {
namespace {

class Torus final : public Shape {
  public:
    Torus(double ring, double tube) : ring_(ring), tube_(tube) {}
    Bounds bounds() const override {
        const double r = ring_ + tube_;
        return {{-r, -tube_, -r}, {r, tube_, r}};
    }

    void intersect(const Ray& ray, Nearest& nearest) const override {
        // In units of the ring, from the closest approach, with a unit direction.
        const double length = glm::length(ray.direction), r = tube_ / ring_;
        const double shift = closestApproach(ray, glm::dvec3(0.0));
        const glm::dvec3 o = ray.at(shift) / ring_, d = ray.direction / length;
        const double reach = (1.0 + r) * (1.0 + r) - glm::dot(o, o);
        if (!(reach > 0.0)) return;
        const double half = std::sqrt(reach) * (1.0 + 1e-9);
        // (|p|^2 + 1 - r^2)^2 = 4 (x^2 + z^2)
        const double k = glm::dot(o, o) + 1.0 - r * r, b = glm::dot(o, d);
        const double square = d.x * d.x + d.z * d.z, mixed = o.x * d.x + o.z * d.z;
        const double flat = o.x * o.x + o.z * o.z;
        const double c[5] = {k * k - 4.0 * flat, 4.0 * b * k - 8.0 * mixed,
                             4.0 * b * b + 2.0 * k - 4.0 * square, 4.0 * b, 1.0};
        for (double s : solvePolynomial(c, -half, half)) {
            // Polished on the distance to the ring's circle, which does not square anything.
            for (int i = 0; i < 4; ++i) {
                const glm::dvec3 p = o + s * d;
                const glm::dvec3 out = fromCircle(p);
                const double slope = glm::dot(out, d) / glm::length(out);
                const double step = (glm::length(out) - r) / slope;
                if (std::isfinite(step) && std::abs(step) < 0.1 * r) s -= step;
            }
            const glm::dvec3 out = fromCircle(o + s * d);
            // A root that is not on the surface after that was a touching one lost in rounding.
            if (std::abs(glm::length(out) - r) > 1e-10) continue;
            nearest.offer(ray, shift + s * ring_ / length, out);
        }
    }

    Surface surface(const Ray& ray, const Hit& hit) const override {
        Surface s;
        s.point = ray.at(hit.t);
        const glm::dvec3 out = fromCircle(s.point / ring_) * ring_;
        s.normal = glm::normalize(out);
        const double r = std::hypot(s.point.x, s.point.z), across = r - ring_;
        const double turn = std::atan2(s.point.y, across) / (2.0 * std::numbers::pi);
        s.uv = {turnOf(s.point), turn < 0.0 ? turn + 1.0 : turn};
        s.gradU = turnGradient(s.point);
        const double scale = 2.0 * std::numbers::pi * glm::dot(out, out);
        s.gradV =
            glm::dvec3(-s.point.y * s.point.x / r, across, -s.point.y * s.point.z / r) / scale;
        return s;
    }

  private:
    /// From the nearest point of the unit circle in XZ.
    static glm::dvec3 fromCircle(const glm::dvec3& p) {
        const double r = std::hypot(p.x, p.z);
        if (!(r > 0.0)) return {p.x - 1.0, p.y, p.z};
        return {p.x - p.x / r, p.y, p.z - p.z / r};
    }

    double ring_, tube_;
};

}  // namespace

std::unique_ptr<Shape> makeTorus(double ring, double tube) {
    return std::make_unique<Torus>(ring, tube);
}

}  // namespace farol::reference
