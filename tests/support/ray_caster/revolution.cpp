#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tests/support/ray_caster/segment.h"
#include "tests/support/ray_caster/shape.h"

namespace farol::reference {
namespace {

glm::dvec2 outwardOf(const Segment& s) {
    return glm::normalize(glm::dvec2(s.to.y - s.from.y, s.from.x - s.to.x));
}

/// A stretch with the normals (radius, height) and the arc shares at its ends.
struct Band {
    Segment segment;
    glm::dvec2 normalFrom, normalTo;
    double shareFrom, shareTo;
};

class Revolution final : public Shape {
  public:
    explicit Revolution(std::vector<glm::dvec2> profile) {
        for (glm::dvec2& p : profile) p.x = std::abs(p.x);
        double volume = 0.0, total = 0.0;  // by Pappus: negative where it runs downwards
        for (std::size_t i = 1; i < profile.size(); ++i) {
            const glm::dvec2 a = profile[i - 1], b = profile[i];
            volume += (a.x * a.x + a.x * b.x + b.x * b.x) * (b.y - a.y);
            total += glm::distance(a, b);
        }
        if (!(total > 0.0)) throw std::invalid_argument("a profile needs two different points");
        const bool reversed = volume < 0.0;
        if (reversed) std::reverse(profile.begin(), profile.end());
        double length = 0.0;
        bool crease = true;
        for (std::size_t i = 1; i < profile.size(); ++i) {
            const Segment segment{profile[i - 1], profile[i]};
            const double step = glm::distance(segment.from, segment.to);
            if (step <= 1e-9 * total) {  // a point given twice is a crease
                crease = true;
                continue;
            }
            const glm::dvec2 out = outwardOf(segment);
            Band band{segment, out, out, length / total, (length + step) / total};
            length += step;
            if (reversed) {
                band.shareFrom = 1.0 - band.shareFrom;
                band.shareTo = 1.0 - band.shareTo;
            }
            if (!crease) {
                const glm::dvec2 both = outwardOf(bands_.back().segment) + out;
                if (glm::length(both) > 1e-9)
                    bands_.back().normalTo = band.normalFrom = glm::normalize(both);
            }
            bands_.push_back(band);
            creases_ += crease ? 1 : 0;
            faces_.push_back(creases_);
            crease = false;
        }
    }

    Bounds bounds() const override {
        double r = 0.0, low = bands_[0].segment.from.y, high = low;
        for (const Band& band : bands_)
            for (const glm::dvec2& p : {band.segment.from, band.segment.to}) {
                r = std::max(r, p.x);
                low = std::min(low, p.y);
                high = std::max(high, p.y);
            }
        return {{-r, low, -r}, {r, high, r}};
    }

    void intersect(const Ray& ray, Nearest& nearest) const override {
        for (std::size_t i = 0; i < bands_.size(); ++i) {
            Nearest one = nearest;
            bands_[i].segment.intersect(ray, faces_[i], one);
            if (!one.found() || !(one.best().t < nearest.best().t)) continue;
            const glm::dvec3 outward = bands_[i].segment.normalAt(ray.at(one.best().t));
            nearest.offer(ray, one.best().t, outward, faces_[i], static_cast<int>(i));
        }
    }

    Surface surface(const Ray& ray, const Hit& hit) const override {
        const Band& band = bands_[static_cast<std::size_t>(hit.piece)];
        Surface s;
        s.point = ray.at(hit.t);
        s.normal = band.segment.normalAt(s.point);
        const double share = std::clamp(band.segment.shareAt(s.point), 0.0, 1.0);
        const glm::dvec2 n = glm::mix(band.normalFrom, band.normalTo, share);
        const double r = std::hypot(s.point.x, s.point.z);
        const double c = r > 0.0 ? s.point.x / r : 1.0, minusS = r > 0.0 ? s.point.z / r : 0.0;
        s.shadingNormal = glm::normalize(glm::dvec3(n.x * c, n.y, n.x * minusS));
        const double turn = std::atan2(-minusS, c) / (2.0 * std::numbers::pi);
        s.uv = {turn < 0.0 ? turn + 1.0 : turn, glm::mix(band.shareFrom, band.shareTo, share)};
        if (r > 0.0) s.gradU = glm::dvec3(minusS, 0.0, -c) / (r * 2.0 * std::numbers::pi);
        const glm::dvec2 along = band.segment.to - band.segment.from;
        s.gradV = glm::dvec3(along.x * c, along.y, along.x * minusS) *
                  ((band.shareTo - band.shareFrom) / glm::dot(along, along));
        return s;
    }

  private:
    std::vector<Band> bands_;
    std::vector<int> faces_;
    int creases_ = 0;
};

}  // namespace

std::unique_ptr<Shape> makeRevolution(const std::vector<glm::dvec2>& profile) {
    return std::make_unique<Revolution>(profile);
}

}  // namespace farol::reference
