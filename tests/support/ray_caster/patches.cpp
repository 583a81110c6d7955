#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "tests/support/ray_caster/angles.h"
#include "tests/support/ray_caster/shape.h"

namespace farol::reference {
namespace {

template <class V>
using Net = std::array<V, 16>;

/// The halves of four points at parameter 1/2, by de Casteljau.
template <class V>
void halve(const V& a, const V& b, const V& c, const V& d, std::array<V, 7>& out) {
    const V ab = 0.5 * (a + b), bc = 0.5 * (b + c), cd = 0.5 * (c + d);
    const V abc = 0.5 * (ab + bc), bcd = 0.5 * (bc + cd);
    out = {a, ab, abc, 0.5 * (abc + bcd), bcd, cd, d};
}

/// Parts of the net: [2 * (second half of v) + (second half of u)].
template <class V>
std::array<Net<V>, 4> quarter(const Net<V>& net) {
    std::array<std::array<V, 7>, 4> rows;
    for (std::size_t r = 0; r < 4; ++r)
        halve(net[4 * r], net[4 * r + 1], net[4 * r + 2], net[4 * r + 3], rows[r]);
    std::array<Net<V>, 4> parts;
    for (std::size_t c = 0; c < 7; ++c) {
        std::array<V, 7> column;
        halve(rows[0][c], rows[1][c], rows[2][c], rows[3][c], column);
        for (std::size_t r = 0; r < 7; ++r)
            for (std::size_t part = 0; part < 4; ++part) {
                const std::size_t c0 = 3 * (part % 2), r0 = 3 * (part / 2);
                if (c >= c0 && c <= c0 + 3 && r >= r0 && r <= r0 + 3)
                    parts[part][4 * (r - r0) + c - c0] = column[r];
            }
    }
    return parts;
}

template <class V>
struct Local {
    V value, du, dv;
};

std::array<double, 4> weights(double t) {
    const double s = 1.0 - t;
    return {s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t};
}

std::array<double, 4> slopes(double t) {
    const double s = 1.0 - t;
    return {-3.0 * s * s, 3.0 * s * s - 6.0 * s * t, 6.0 * s * t - 3.0 * t * t, 3.0 * t * t};
}

template <class V>
Local<V> evaluate(const Net<V>& net, const glm::dvec2& at) {
    const auto wu = weights(at.x), wv = weights(at.y), su = slopes(at.x), sv = slopes(at.y);
    Local<V> local{V(0.0), V(0.0), V(0.0)};
    for (std::size_t r = 0; r < 4; ++r)
        for (std::size_t c = 0; c < 4; ++c) {
            local.value += wu[c] * wv[r] * net[4 * r + c];
            local.du += su[c] * wv[r] * net[4 * r + c];
            local.dv += wu[c] * sv[r] * net[4 * r + c];
        }
    return local;
}

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// True if no direction of u is ever parallel to one of v: then a root is the only one.
bool regular(const Net<glm::dvec2>& net) {
    double low = 0.0, high = 0.0;
    bool first = true;
    for (std::size_t i = 0; i < 12; ++i) {
        const std::size_t k = 4 * (i / 3) + i % 3;
        const glm::dvec2 du = net[k + 1] - net[k];
        for (std::size_t j = 0; j < 12; ++j) {
            const double turn = cross(du, net[j + 4] - net[j]);
            low = first ? turn : std::min(low, turn);
            high = first ? turn : std::max(high, turn);
            first = false;
            if (low <= 0.0 && high >= 0.0) return false;
        }
    }
    return true;
}

bool holdsOrigin(const Net<glm::dvec2>& net, double slack) {
    glm::dvec2 low = net[0], high = net[0];
    for (const glm::dvec2& p : net) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return low.x <= slack && low.y <= slack && high.x >= -slack && high.y >= -slack;
}

struct Cell {
    Net<glm::dvec3> net;
    glm::dvec2 corner;  ///< of the whole patch's (u, v)
    Bounds box;
};

Bounds boundsOf(const Net<glm::dvec3>& net) {
    Bounds box{net[0], net[0]};
    for (const glm::dvec3& p : net) {
        box.min = glm::min(box.min, p);
        box.max = glm::max(box.max, p);
    }
    return box;
}

bool meets(const Ray& ray, const Bounds& box) {
    double from = -std::numeric_limits<double>::infinity(), to = -from;
    for (int i = 0; i < 3; ++i) {
        const double a = box.min[i] - ray.origin[i], b = box.max[i] - ray.origin[i];
        // Room for rounding: a flat cell has no thickness.
        const double slack = 1e-9 * (1.0 + std::abs(box.min[i]) + std::abs(box.max[i]));
        if (ray.direction[i] == 0.0) {
            if (a > slack || b < -slack) return false;
            continue;
        }
        const double s = (a - slack) / ray.direction[i], t = (b + slack) / ray.direction[i];
        from = std::max(from, std::min(s, t));
        to = std::min(to, std::max(s, t));
    }
    return from <= to;
}

/// One ray against one cell: in the plane across the ray the cell's net has two coordinates, and
/// the ray is the origin.
class Search {
  public:
    Search(const Ray& ray, const Cell& cell, double cellSize, int patch, Nearest& nearest)
        : ray_(ray), cell_(cell), cellSize_(cellSize), patch_(patch), nearest_(nearest) {
        const glm::dvec3 d = glm::normalize(ray.direction), a = glm::abs(d);
        const glm::dvec3 other = a.x <= a.y && a.x <= a.z ? glm::dvec3(1, 0, 0)
                                 : a.y <= a.z             ? glm::dvec3(0, 1, 0)
                                                          : glm::dvec3(0, 0, 1);
        const glm::dvec3 e = glm::normalize(glm::cross(d, other)), f = glm::cross(d, e);
        const double shift = closestApproach(ray, 0.5 * (cell.box.min + cell.box.max));
        origin_ = ray.at(shift);
        double size = 0.0;
        for (std::size_t i = 0; i < 16; ++i) {
            const glm::dvec3 p = cell.net[i] - origin_;
            flat_[i] = {glm::dot(e, p), glm::dot(f, p)};
            size = std::max({size, std::abs(flat_[i].x), std::abs(flat_[i].y)});
        }
        slack_ = 1e-14 * size;
    }

    void run() { visit(flat_, glm::dvec2(0.0), 1.0, 0); }

  private:
    static constexpr int kDepth = 12;  // 1/4096 of a cell: nothing a pixel could show

    void visit(const Net<glm::dvec2>& net, const glm::dvec2& corner, double size, int depth) {
        if (!holdsOrigin(net, slack_)) return;
        if (depth >= kDepth || regular(net)) {
            glm::dvec2 at = corner + 0.5 * size;
            const bool settled = newton(at);
            const glm::dvec2 inside = (at - corner) / size;
            if (settled && std::min(inside.x, inside.y) >= -1e-9 &&
                std::max(inside.x, inside.y) <= 1.0 + 1e-9)
                return report(at);
            // Settled outside says nothing yet: the hull test of the parts does.
            if (depth >= kDepth) return;
        }
        const auto parts = quarter(net);
        for (std::size_t i = 0; i < 4; ++i)
            visit(parts[i],
                  corner + 0.5 * size *
                               glm::dvec2(static_cast<double>(i % 2), static_cast<double>(i / 2)),
                  0.5 * size, depth + 1);
    }

    bool newton(glm::dvec2& at) const {
        for (int i = 0; i < 24; ++i) {
            const Local<glm::dvec2> here = evaluate(flat_, at);
            const double det = cross(here.du, here.dv);
            const glm::dvec2 step =
                glm::dvec2(cross(here.value, here.dv), cross(here.du, here.value)) / det;
            if (!std::isfinite(step.x) || !std::isfinite(step.y)) return false;
            at -= step;
            if (std::max(std::abs(at.x - 0.5), std::abs(at.y - 0.5)) > 4.0) return false;
            if (std::max(std::abs(step.x), std::abs(step.y)) < 1e-13) return true;
        }
        return glm::length(evaluate(flat_, at).value) <= 100.0 * slack_;
    }

    void report(const glm::dvec2& at) {
        const Local<glm::dvec3> here = evaluate(cell_.net, at);
        const double t = glm::dot(here.value - ray_.origin, ray_.direction) /
                         glm::dot(ray_.direction, ray_.direction);
        nearest_.offer(ray_, t, glm::cross(here.du, here.dv), 0, patch_,
                       cell_.corner + cellSize_ * at);
    }

    const Ray& ray_;
    const Cell& cell_;
    double cellSize_;
    int patch_;
    Nearest& nearest_;
    glm::dvec3 origin_;
    Net<glm::dvec2> flat_;
    double slack_;
};

class Patches final : public Shape {
  public:
    explicit Patches(const std::vector<PatchNet>& nets) {
        for (const PatchNet& points : nets) {
            if (points.size() != 16) throw std::invalid_argument("a patch has 16 points");
            Patch patch;
            std::copy(points.begin(), points.end(), patch.net.begin());
            patch.box = boundsOf(patch.net);
            cut(patch.net, glm::dvec2(0.0), 1.0, patch.cells);
            if (patches_.empty()) box_ = patch.box;
            box_.min = glm::min(box_.min, patch.box.min);
            box_.max = glm::max(box_.max, patch.box.max);
            patches_.push_back(std::move(patch));
        }
    }
    Bounds bounds() const override { return box_; }
    void intersect(const Ray& ray, Nearest& nearest) const override {
        for (std::size_t i = 0; i < patches_.size(); ++i) {
            if (!meets(ray, patches_[i].box)) continue;
            for (const Cell& cell : patches_[i].cells)
                if (meets(ray, cell.box))
                    Search(ray, cell, kCell, static_cast<int>(i), nearest).run();
        }
    }
    Surface surface(const Ray&, const Hit& hit) const override {
        const Net<glm::dvec3>& net = patches_[static_cast<std::size_t>(hit.piece)].net;
        Local<glm::dvec3> here = evaluate(net, hit.place);
        Surface s;
        s.point = here.value;
        s.uv = 1.0 - hit.place;
        // On a collapsed edge the directions do not span a plane: just inside they do.
        if (glm::length(glm::cross(here.du, here.dv)) <=
            1e-9 * (glm::dot(here.du, here.du) + glm::dot(here.dv, here.dv)))
            here = evaluate(net, glm::mix(hit.place, glm::dvec2(0.5), 1e-5));
        const double e = glm::dot(here.du, here.du), f = glm::dot(here.du, here.dv);
        const double g = glm::dot(here.dv, here.dv), area = e * g - f * f;
        s.normal = glm::normalize(glm::cross(here.du, here.dv));
        s.gradU = -(g * here.du - f * here.dv) / area;
        s.gradV = -(e * here.dv - f * here.du) / area;
        return s;
    }

  private:
    struct Patch {
        Net<glm::dvec3> net;
        std::vector<Cell> cells;
        Bounds box;
    };
    static constexpr double kCell = 1.0 / 8.0;  // of a patch's side

    static void cut(const Net<glm::dvec3>& net, const glm::dvec2& corner, double size,
                    std::vector<Cell>& cells) {
        if (size <= kCell) {
            cells.push_back({net, corner, boundsOf(net)});
            return;
        }
        const auto parts = quarter(net);
        for (std::size_t i = 0; i < 4; ++i)
            cut(parts[i],
                corner +
                    0.5 * size * glm::dvec2(static_cast<double>(i % 2), static_cast<double>(i / 2)),
                0.5 * size, cells);
    }

    std::vector<Patch> patches_;
    Bounds box_;
};

}  // namespace

std::unique_ptr<Shape> makePatches(const std::vector<PatchNet>& nets) {
    return std::make_unique<Patches>(nets);
}

}  // namespace farol::reference
