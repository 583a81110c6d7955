#include <algorithm>
#include <cmath>

#include "tests/support/ray_caster/angles.h"
#include "tests/support/ray_caster/roots.h"
#include "tests/support/ray_caster/segment.h"
#include "tests/support/ray_caster/shape.h"

namespace farol::reference {
namespace {

class Ellipsoid final : public Shape {
  public:
    explicit Ellipsoid(const glm::dvec3& radii) : radii_(radii) {}
    Bounds bounds() const override { return {-radii_, radii_}; }
    void intersect(const Ray& ray, Nearest& nearest) const override {
        // In the space where it is the unit sphere.
        const Ray unit{ray.origin / radii_, ray.direction / radii_};
        const double shift = closestApproach(unit, glm::dvec3(0.0));
        const glm::dvec3 near = unit.at(shift);
        for (const double s :
             solveQuadratic(glm::dot(unit.direction, unit.direction),
                            2.0 * glm::dot(near, unit.direction), glm::dot(near, near) - 1.0))
            nearest.offer(ray, shift + s, (near + s * unit.direction) / radii_);
    }
    Surface surface(const Ray& ray, const Hit& hit) const override {
        Surface s;
        s.point = ray.at(hit.t);
        const glm::dvec3 unit = s.point / radii_;
        s.normal = glm::normalize(unit / radii_);
        s.uv = {turnOf(unit), latitudeOf(unit)};
        s.gradU = turnGradient(unit) / radii_;
        s.gradV = latitudeGradient(unit) / radii_;
        return s;
    }

  private:
    glm::dvec3 radii_;
};

/// A disc about Y on the height edge.y, of radius edge.x.
void offerDisc(const Ray& ray, const glm::dvec2& edge, double up, int face, Nearest& nearest) {
    const double t = (edge.y - ray.origin.y) / ray.direction.y;
    if (!(edge.x > 0.0) || !std::isfinite(t)) return;
    const glm::dvec3 p = ray.at(t);
    if (std::hypot(p.x, p.z) <= edge.x) nearest.offer(ray, t, {0, up, 0}, face);
}

void setDiscUv(Surface& s, const glm::dvec2& center, double scale) {
    s.uv = center + scale * glm::dvec2(s.point.x, s.point.z);
    s.gradU = {scale, 0, 0};
    s.gradV = {0, 0, scale};
}

/// The upper half of a ball. face 0: the ball's, 1: the base.
class Dome final : public Shape {
  public:
    explicit Dome(double radius) : radius_(radius) {}
    Bounds bounds() const override {
        return {{-radius_, 0, -radius_}, {radius_, radius_, radius_}};
    }
    void intersect(const Ray& ray, Nearest& nearest) const override {
        const double shift = closestApproach(ray, glm::dvec3(0.0));
        const glm::dvec3 near = ray.at(shift);
        for (const double s : solveQuadratic(glm::dot(ray.direction, ray.direction),
                                             2.0 * glm::dot(near, ray.direction),
                                             glm::dot(near, near) - radius_ * radius_)) {
            const glm::dvec3 p = near + s * ray.direction;
            if (p.y >= 0.0) nearest.offer(ray, shift + s, p);
        }
        offerDisc(ray, {radius_, 0.0}, -1.0, 1, nearest);
    }
    Surface surface(const Ray& ray, const Hit& hit) const override {
        Surface s;
        s.point = ray.at(hit.t);
        if (hit.face == 1) {
            s.normal = {0, -1, 0};
            setDiscUv(s, {0.5, 0.5}, 0.5 / radius_);
            return s;
        }
        s.normal = glm::normalize(s.point);
        s.uv = {turnOf(s.point), 2.0 * latitudeOf(s.point) - 1.0};
        s.gradU = turnGradient(s.point);
        s.gradV = 2.0 * latitudeGradient(s.point);
        return s;
    }

  private:
    double radius_;
};

/// face 0: the side, 1: the base, 2: the top.
class Frustum final : public Shape {
  public:
    Frustum(double bottom, double top, double height, DiscLayout layout)
        : side_{{bottom, 0.0}, {top, height}}, layout_(layout) {}
    Bounds bounds() const override {
        const double r = widest();
        return {{-r, 0, -r}, {r, side_.to.y, r}};
    }
    void intersect(const Ray& ray, Nearest& nearest) const override {
        side_.intersect(ray, 0, nearest);
        offerDisc(ray, side_.from, -1.0, 1, nearest);
        offerDisc(ray, side_.to, 1.0, 2, nearest);
    }
    Surface surface(const Ray& ray, const Hit& hit) const override {
        Surface s;
        s.point = ray.at(hit.t);
        if (hit.face == 0) {
            s.normal = side_.normalAt(s.point);
            sideUv(s);
        } else {
            s.normal = {0, hit.face == 1 ? -1 : 1, 0};
            const double r = hit.face == 1 ? side_.from.x : side_.to.x;
            if (layout_ == DiscLayout::face)
                setDiscUv(s, {0.5, 0.5}, 0.5 / r);
            else if (layout_ == DiscLayout::coneAtlas)
                setDiscUv(s, {0.25, 0.5}, 0.25 / r);
            else
                setDiscUv(s, {hit.face == 2 ? 0.4375 : 0.8125, 0.8125}, 0.1875 / r);
        }
        return s;
    }

  private:
    double widest() const { return std::max(side_.from.x, side_.to.x); }

    void sideUv(Surface& s) const {
        if (layout_ == DiscLayout::coneAtlas) return setDiscUv(s, {0.75, 0.5}, 0.25 / widest());
        const double share = layout_ == DiscLayout::cylinderAtlas ? 0.625 : 1.0;
        s.uv = {turnOf(s.point), share * s.point.y / side_.to.y};
        s.gradU = turnGradient(s.point);
        s.gradV = {0, share / side_.to.y, 0};
    }

    Segment side_;
    DiscLayout layout_;
};

}  // namespace

std::unique_ptr<Shape> makeEllipsoid(const glm::dvec3& radii) {
    return std::make_unique<Ellipsoid>(radii);
}

std::unique_ptr<Shape> makeDome(double radius) { return std::make_unique<Dome>(radius); }

std::unique_ptr<Shape> makeFrustum(double bottom, double top, double height, DiscLayout layout) {
    return std::make_unique<Frustum>(bottom, top, height, layout);
}

}  // namespace farol::reference
