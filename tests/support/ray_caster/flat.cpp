#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/ray_caster/angles.h"
#include "tests/support/ray_caster/shape.h"

namespace farol::reference {
namespace {

class Plane final : public Shape {
  public:
    explicit Plane(double size) : size_(size) {}
    Bounds bounds() const override {
        return {{-size_ / 2, 0, -size_ / 2}, {size_ / 2, 0, size_ / 2}};
    }
    void intersect(const Ray& ray, Nearest& nearest) const override {
        const double t = -ray.origin.y / ray.direction.y;
        if (!std::isfinite(t)) return;
        const glm::dvec3 p = ray.at(t);
        if (std::abs(p.x) <= size_ / 2 && std::abs(p.z) <= size_ / 2)
            nearest.offer(ray, t, {0, 1, 0});
    }
    Surface surface(const Ray& ray, const Hit& hit) const override {
        Surface s;
        s.point = ray.at(hit.t);
        s.uv = {s.point.x / size_ + 0.5, 0.5 - s.point.z / size_};
        s.gradU = {1 / size_, 0, 0};
        s.gradV = {0, 0, -1 / size_};
        return s;
    }

  private:
    double size_;
};

/// face = 2 * axis + (1 on the positive side).
class BoxShape final : public Shape {
  public:
    BoxShape(const glm::dvec3& size, bool atlas) : size_(size), atlas_(atlas) {}
    Bounds bounds() const override { return {-0.5 * size_, 0.5 * size_}; }
    void intersect(const Ray& ray, Nearest& nearest) const override {
        for (int face = 0; face < 6; ++face) {
            const int axis = face / 2, b = (axis + 1) % 3, c = (axis + 2) % 3;
            glm::dvec3 outward(0.0);
            outward[axis] = face % 2 ? 1.0 : -1.0;
            const double t =
                (0.5 * outward[axis] * size_[axis] - ray.origin[axis]) / ray.direction[axis];
            if (!std::isfinite(t)) continue;
            const glm::dvec3 p = ray.at(t);
            if (std::abs(p[b]) <= 0.5 * size_[b] && std::abs(p[c]) <= 0.5 * size_[c])
                nearest.offer(ray, t, outward, face);
        }
    }
    Surface surface(const Ray& ray, const Hit& hit) const override {
        const bool plus = hit.face % 2 == 1;
        const int axis = hit.face / 2;
        Surface s;
        s.point = ray.at(hit.t);
        s.normal = glm::dvec3(0.0);
        s.normal[axis] = plus ? 1.0 : -1.0;
        // The whole picture a face, upright from outside: to the right of who looks at it.
        glm::dvec3 right(0.0), up(0.0, 1.0, 0.0);
        if (axis == 2) right.x = plus ? 1 : -1;
        if (axis == 0) right.z = plus ? -1 : 1;
        if (axis == 1) {
            right.x = 1;
            up = {0, 0, plus && atlas_ ? -1 : 1};
        }
        s.gradU = right / size_;
        s.gradV = up / size_;
        s.uv = glm::dvec2(glm::dot(s.gradU, s.point), glm::dot(s.gradV, s.point)) + 0.5;
        if (atlas_) {
            // The unfolded cross, from the bottom left: left front right back in the middle row.
            constexpr int kColumn[6] = {0, 2, 1, 1, 3, 1}, kRow[6] = {1, 1, 0, 2, 1, 1};
            s.uv.x = (s.uv.x + kColumn[hit.face]) / 4.0;
            s.uv.y = (s.uv.y + kRow[hit.face]) / 3.0;
            s.gradU /= 4.0;
            s.gradV /= 3.0;
        }
        return s;
    }

  private:
    glm::dvec3 size_;
    bool atlas_;
};

/// face 1 looks up, face 0 down.
class Ring final : public Shape {
  public:
    Ring(double inner, double outer) : inner_(inner), outer_(outer) {}
    Bounds bounds() const override { return {{-outer_, 0, -outer_}, {outer_, 0, outer_}}; }
    void intersect(const Ray& ray, Nearest& nearest) const override {
        const double t = -ray.origin.y / ray.direction.y;
        if (!std::isfinite(t)) return;
        const glm::dvec3 p = ray.at(t);
        const double r = std::hypot(p.x, p.z);
        if (r < inner_ || r > outer_) return;
        nearest.offer(ray, t, {0, 1, 0}, 1);
        nearest.offer(ray, t, {0, -1, 0}, 0);
    }
    Surface surface(const Ray& ray, const Hit& hit) const override {
        Surface s;
        s.point = ray.at(hit.t);
        s.normal.y = hit.face == 1 ? 1.0 : -1.0;
        const double r = std::hypot(s.point.x, s.point.z), width = outer_ - inner_;
        s.uv = {turnOf(s.point), (r - inner_) / width};
        s.gradU = turnGradient(s.point);
        s.gradV = glm::dvec3(s.point.x, 0, s.point.z) / std::max(r, 1e-300) / width;
        return s;
    }

  private:
    double inner_, outer_;
};

}  // namespace

std::unique_ptr<Shape> makePlane(double size) { return std::make_unique<Plane>(size); }

std::unique_ptr<Shape> makeBox(const glm::dvec3& size, scene::UvLayout uv) {
    return std::make_unique<BoxShape>(size, uv == scene::UvLayout::atlas);
}

std::unique_ptr<Shape> makeRing(double inner, double outer) {
    return std::make_unique<Ring>(inner, outer);
}

}  // namespace farol::reference
