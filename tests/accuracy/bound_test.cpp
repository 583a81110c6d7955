#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <random>
#include <set>

#include "generator/registry.h"
#include "tests/support/plan_scene.h"

// The promise of error=: nothing of a surface whose divisions are open is drawn farther from its
// place than that many pixels. Meshes are those of the plan, exact surfaces are evaluated here.
using namespace farol;

namespace {

using glm::dvec2;
using glm::dvec3;

/// f is 0 on the surface; its gradient follows.
struct Implicit {
    double value;
    dvec3 gradient;
};
using Field = std::function<Implicit(const dvec3&)>;

Implicit cone(const dvec3& p, double bottom, double slope) {
    const double radius = bottom + slope * p.y;
    return {p.x * p.x + p.z * p.z - radius * radius, 2.0 * dvec3(p.x, -slope * radius, p.z)};
}

struct Subject {
    std::string name;
    std::vector<std::string> words;
    double size = 1.0;
    Field field;                              ///< empty: a patch
    std::function<double(double)> capRadius;  ///< of the disc at this height; may be empty
    std::array<dvec3, 16> net{};
    /// The surface's nearest point, where steps along gradients do not find it: from within a thin
    /// tube.
    std::function<dvec3(const dvec3&)> foot = {};
};

double cubic(int i, double t) {
    constexpr std::array<double, 4> kChoose{1, 3, 3, 1};
    return kChoose[static_cast<std::size_t>(i)] * std::pow(t, i) * std::pow(1.0 - t, 3 - i);
}

double cubicRate(int i, double t) {
    const double low = i > 0 ? std::pow(t, i - 1) * std::pow(1.0 - t, 3 - i) * i : 0.0;
    const double high = i < 3 ? std::pow(t, i) * std::pow(1.0 - t, 2 - i) * (3 - i) : 0.0;
    return (i == 1 || i == 2 ? 3.0 : 1.0) * (low - high);
}

/// A point of the patch near `target`, from the parameters (s, t) on: each step goes to the nearest
/// point of the tangent plane.
dvec3 patchFoot(const std::array<dvec3, 16>& net, const dvec3& target, double s, double t) {
    dvec3 best(0.0);
    double least = 1e300;
    for (int step = 0; step < 8; ++step) {
        dvec3 q(0.0), u(0.0), v(0.0);
        for (int i = 0; i < 16; ++i) {
            const dvec3& point = net[static_cast<std::size_t>(i)];
            q += cubic(i / 4, t) * cubic(i % 4, s) * point;
            u += cubic(i / 4, t) * cubicRate(i % 4, s) * point;
            v += cubicRate(i / 4, t) * cubic(i % 4, s) * point;
        }
        if (glm::length(q - target) < least) {
            least = glm::length(q - target);
            best = q;
        }
        const dvec3 d = target - q;
        const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v);
        const double det = uu * vv - uv * uv;
        if (!(det > 1e-12 * uu * vv)) break;
        const double before = s;
        s = std::clamp(s + (glm::dot(d, u) * vv - glm::dot(d, v) * uv) / det, 0.0, 1.0);
        // Beside the patch, the nearest point of its outline.
        t = std::clamp(t + glm::dot(d - (s - before) * u, v) / vv, 0.0, 1.0);
        if (t == 0.0 || t == 1.0) s = std::clamp(before + glm::dot(d, u) / uu, 0.0, 1.0);
    }
    return best;
}

class Lottery {
  public:
    explicit Lottery(unsigned seed) : random_(seed) {}
    double between(double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(random_);
    }
    dvec3 direction() {
        dvec3 d(0.0);
        while (glm::length(d) < 0.1) d = {between(-1, 1), between(-1, 1), between(-1, 1)};
        return glm::normalize(d);
    }
    Subject subject(int kind, std::map<std::string, std::string>& files);

  private:
    std::mt19937 random_;
};

std::string word(double value) { return std::to_string(value); }

Subject Lottery::subject(int kind, std::map<std::string, std::string>& files) {
    const auto length = [&] { return std::stod(word(std::pow(10.0, between(-1.0, 1.0)))); };
    const double a = length(), b = length(), c = length();
    Subject s;
    switch (kind) {
        case 0:
            s = {"plane",
                 {"plane", word(a)},
                 a,
                 [](const dvec3& p) {
                     return Implicit{p.y, {0, 1, 0}};
                 },
                 {}};
            break;
        case 1:
            s = {"box",
                 {"box", word(a)},
                 a,
                 [a](const dvec3& p) {
                     const dvec3 q = glm::abs(p);
                     const int axis = q.x > q.y && q.x > q.z ? 0 : q.y > q.z ? 1 : 2;
                     dvec3 g(0.0);
                     g[axis] = p[axis] < 0 ? -1 : 1;
                     return Implicit{q[axis] - a / 2, g};
                 },
                 {}};
            break;
        case 2:
            s = {"sphere",
                 {"sphere", word(a)},
                 a,
                 [a](const dvec3& p) {
                     return Implicit{glm::dot(p, p) - a * a, 2.0 * p};
                 },
                 {}};
            break;
        case 3:
            s = {"ellipsoid",
                 {"ellipsoid", word(a), word(b), word(c)},
                 std::max({a, b, c}),
                 [r = dvec3(a, b, c)](const dvec3& p) {
                     return Implicit{glm::dot(p / r, p / r) - 1.0, 2.0 * p / (r * r)};
                 },
                 {}};
            break;
        case 4:
            s = {"cone",
                 {"cone", word(a), word(b)},
                 std::max(a, b),
                 [a, b](const dvec3& p) { return cone(p, a, -a / b); },
                 [a](double) { return a; }};
            break;
        case 5:
            s = {"cylinder",
                 {"cylinder", word(a), word(b)},
                 std::max(a, b),
                 [a](const dvec3& p) { return cone(p, a, 0.0); },
                 [a](double) { return a; }};
            break;
        case 6:
            s = {"frustum",
                 {"frustum", word(a), word(b), word(c)},
                 std::max({a, b, c}),
                 [a, b, c](const dvec3& p) { return cone(p, a, (b - a) / c); },
                 [a, b, c](double y) { return y < c / 2 ? a : b; }};
            break;
        case 7: {
            const double ring = std::max(a, b) * 1.01, tube = std::min(a, b);
            const double r = std::stod(word(ring));
            s = {"torus",
                 {"torus", word(ring), word(tube)},
                 ring + tube,
                 [r, tube](const dvec3& p) {
                     const double radius = std::hypot(p.x, p.z), across = radius - r;
                     return Implicit{
                         across * across + p.y * p.y - tube * tube,
                         2.0 * dvec3(across * p.x / radius, p.y, across * p.z / radius)};
                 },
                 {}};
            s.foot = [r, tube](const dvec3& p) {
                const dvec3 core = glm::normalize(dvec3(p.x, 0.0, p.z)) * r;
                const double away = glm::length(p - core);
                return away > 0.0 ? core + (p - core) * (tube / away) : core + dvec3(0, tube, 0);
            };
            break;
        }
        case 8: {
            const double in = std::min(a, b), out = std::stod(word(1.1 * std::max(a, b)));
            s = {"ring", {"ring", word(in), word(out)}, out, {}, [out](double) { return out; }};
            break;
        }
        case 9: {
            std::vector<dvec2> points;
            std::string text;
            for (int i = 0; i < 5; ++i) {
                points.emplace_back(std::stod(word(between(0.2, 1.0) * a)), i * 0.25 * b);
                points.back().y = std::stod(word(points.back().y));
                text += word(points.back().x) + " " + word(points.back().y) + " 0\n";
            }
            files["p.ply"] =
                "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
                "property float z\nend_header\n" +
                text;
            s = {"revolution",
                 {"revolution", "p.ply"},
                 std::max(a, b),
                 [points](const dvec3& p) {
                     std::size_t i = 0;
                     while (i + 2 < points.size() && p.y > points[i + 1].y) ++i;
                     const dvec2 from = points[i], to = points[i + 1];
                     const double slope = (to.x - from.x) / (to.y - from.y);
                     return cone(p, from.x - slope * from.y, slope);
                 },
                 {}};
            break;
        }
        case 10:
            s = {"dome",
                 {"dome", word(a)},
                 a,
                 [a](const dvec3& p) {
                     return Implicit{glm::dot(p, p) - a * a, 2.0 * p};
                 },
                 [a](double) { return a; }};
            break;
        default: {
            std::string text = "1\n0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15\n16\n";
            s.name = "patch";
            s.words = {"patch", "n.patch"};
            s.size = 3.0 * a;
            for (int i = 0; i < 16; ++i) {
                dvec3& p = s.net[static_cast<std::size_t>(i)];
                p = a * dvec3(i % 4 + between(-0.4, 0.4), between(-1.5, 1.5),
                              i / 4 + between(-0.4, 0.4));
                for (int k = 0; k < 3; ++k) p[k] = std::stod(word(p[k]));
                text += word(p.x) + ", " + word(p.y) + ", " + word(p.z) + "\n";
            }
            files["n.patch"] = text;
        }
    }
    return s;
}

struct View {
    scene::Scene scene;
    render::PictureOptions options;
};

View viewOf(Lottery& lottery, const Subject& subject) {
    View view;
    scene::Model model;
    model.source.kind = scene::ModelSource::Kind::shape;
    model.source.shape = generator::parseCall(subject.words);
    model.source.path = model.source.shape.file;
    model.twoSided = false;
    scene::Group group;
    const dvec3 place = lottery.between(0.0, 1e4) * lottery.direction();
    group.transforms.emplace_back(scene::Translate{place});
    group.transforms.emplace_back(scene::Rotate{lottery.between(0.0, 360.0), lottery.direction()});
    const double scale = std::pow(10.0, lottery.between(-1.0, 1.0));
    dvec3 factors(scale);
    if (lottery.between(0, 1) < 0.4)
        factors *= dvec3(lottery.between(0.3, 1.0), lottery.between(-1.0, -0.3), 1.0);
    group.transforms.emplace_back(scene::Scale{factors});
    group.models.push_back(std::move(model));
    view.scene.groups.push_back(std::move(group));
    scene::Camera camera;
    const double extent = subject.size * scale;
    camera.target = place + 0.3 * extent * lottery.direction();
    camera.eye = place + extent * std::pow(10.0, lottery.between(0.05, 2.0)) * lottery.direction();
    camera.up = lottery.direction();
    camera.fovDeg = lottery.between(10.0, 100.0);
    camera.near = 0.05 * extent;
    camera.far = 1000.0 * extent;
    view.scene.camera = camera;
    view.options.width = static_cast<int>(lottery.between(32, 320));
    view.options.height = static_cast<int>(lottery.between(32, 320));
    view.options.layer = render::Layer::normal;
    view.options.errorPx = std::pow(10.0, lottery.between(-0.8, 0.8));
    return view;
}

/// Largest distance on the screen, px, between points of the mesh and the surface's nearest.
double worstPx(const Subject& subject, const render::FramePlan& plan, Lottery& lottery) {
    const render::DrawItem& item = plan.items.at(0);
    const generator::Mesh& mesh = item.mesh->mesh;
    const glm::dmat4 viewFromMesh(item.viewFromObject);
    const dvec3 balance = item.mesh->balance;
    glm::dmat4 viewFromObject = viewFromMesh;
    for (int i = 0; i < 3; ++i) viewFromObject[i] /= balance[i];
    const glm::dmat4 objectFromView = glm::inverse(viewFromObject);
    const double focal = plan.view.size.y / 2.0 / std::tan(glm::radians(plan.camera.fovDeg) / 2.0);
    const auto screen = [&](const dvec3& p) { return focal * dvec2(p.x, p.y) / -p.z; };
    const dvec2 half(plan.view.size.x / 2.0, plan.view.size.y / 2.0);
    double worst = 0.0;
    const std::size_t triangles = mesh.triangles();
    const std::size_t step = std::max<std::size_t>(1, triangles / 60);
    for (std::size_t k = static_cast<std::size_t>(lottery.between(0, double(step))); k < triangles;
         k += step)
        for (const dvec3& w :
             {dvec3(1.0 / 3), dvec3(0.5, 0.5, 0), dvec3(0, 0.5, 0.5), dvec3(0.5, 0, 0.5),
              dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1)}) {
            dvec3 p(0.0);
            dvec2 uv(0.0);
            bool flat = true;
            for (std::size_t c = 0; c < 3; ++c) {
                const std::uint32_t index = mesh.indices()[3 * k + c];
                p += w[static_cast<int>(c)] * dvec3(mesh.positions()[index]);
                uv += w[static_cast<int>(c)] * dvec2(mesh.uvs()[index]);
                flat = flat && mesh.normals()[index].x == 0.0F && mesh.normals()[index].z == 0.0F;
            }
            p *= balance;
            const dvec3 seen(viewFromObject * glm::dvec4(p, 1.0));
            if (-seen.z < plan.camera.near) continue;
            const dvec2 at = screen(seen);
            if (std::abs(at.x) > half.x || std::abs(at.y) > half.y) continue;
            dvec3 exact = seen;
            if (subject.name == "patch") {
                const dvec3 q = patchFoot(subject.net, p, 1.0 - uv.x, 1.0 - uv.y);
                exact = dvec3(viewFromObject * glm::dvec4(q, 1.0));
            } else if (flat && subject.capRadius) {
                const double most = subject.capRadius(p.y), r = std::hypot(p.x, p.z);
                if (r > most)
                    exact = dvec3(viewFromObject *
                                  glm::dvec4(p.x * most / r, p.y, p.z * most / r, 1.0));
            } else if (subject.field) {
                // The foot of the perpendicular in view space, and that of object space: steps
                // along gradients find the one or the other better. Either bounds the true
                // distance.
                const glm::dmat3 back(objectFromView);
                dvec3 foot = p;
                for (int i = 0; i < 6; ++i) {
                    const Implicit f = subject.field(dvec3(objectFromView * glm::dvec4(exact, 1)));
                    const dvec3 g = glm::transpose(back) * f.gradient;
                    if (!(glm::dot(g, g) > 0.0)) break;
                    exact -= g * (f.value / glm::dot(g, g));
                    const Implicit own = subject.field(foot);
                    foot -= own.gradient * (own.value / glm::dot(own.gradient, own.gradient));
                }
                if (subject.foot) foot = subject.foot(p);
                foot = dvec3(viewFromObject * glm::dvec4(foot, 1.0));
                if (!(glm::length(exact - seen) < glm::length(foot - seen))) exact = foot;
            }
            worst = std::max(worst, glm::length(screen(exact) - at));
        }
    return worst;
}

}  // namespace

TEST_CASE("the error bound is never exceeded: 10,000 shapes, cameras and scales") {
    Lottery lottery(2024);
    std::map<std::string, std::vector<double>> shares;
    render::MeshLibrary meshes(std::size_t{64} << 20);
    int seen = 0;
    for (int i = 0; seen < 10'000 && i < 20'000; ++i) {
        std::map<std::string, std::string> files;
        const Subject subject = lottery.subject(i % 12, files);
        const View view = viewOf(lottery, subject);
        const scene::BundleAssets assets(files);
        const render::FramePlan plan = support::planScene(view.scene, view.options, assets, meshes);
        if (plan.items.empty()) continue;  // outside the view
        ++seen;
        const double worst = worstPx(subject, plan, lottery);
        CAPTURE(i, subject.name, *view.options.errorPx, worst,
                plan.items[0].mesh->mesh.triangles());
        // Positions are floats: 6e-8 of the distance to the object's middle.
        REQUIRE(worst <= *view.options.errorPx + 2e-3);
        shares[subject.name].push_back(worst / *view.options.errorPx);
    }
    REQUIRE(seen == 10'000);
    for (auto& [name, all] : shares) {
        std::sort(all.begin(), all.end());
        const auto at = [&](double share) {
            return all[static_cast<std::size_t>(share * static_cast<double>(all.size() - 1))];
        };
        std::printf("%-11s %4zu cases: true error / bound: median %.2f, 90 %% %.2f, most %.2f\n",
                    name.c_str(), all.size(), at(0.5), at(0.9), at(1.0));
    }
}

TEST_CASE("half the error never makes a coarser mesh, and an orbit meets few meshes") {
    Lottery lottery(7);
    render::MeshLibrary meshes(std::size_t{64} << 20);
    for (int i = 0; i < 400; ++i) {
        std::map<std::string, std::string> files;
        const Subject subject = lottery.subject(i % 12, files);
        View view = viewOf(lottery, subject);
        const scene::BundleAssets assets(files);
        const auto triangles = [&] {
            return support::planScene(view.scene, view.options, assets, meshes).stats.triangles;
        };
        const auto before = triangles();
        view.options.errorPx = std::max(0.01, *view.options.errorPx / 2.0);
        CHECK(triangles() >= before);
    }
    std::map<std::string, std::string> files;
    for (int kind = 2; kind < 11; ++kind) {
        const Subject subject = lottery.subject(kind, files);
        View view = viewOf(lottery, subject);
        const scene::BundleAssets assets(files);
        std::set<std::uint64_t> met;
        // About the object itself: an orbit about another point comes nearer and goes away.
        const auto& group = view.scene.groups[0];
        view.scene.camera->target = std::get<scene::Translate>(group.transforms[0]).offset;
        view.options.orbit.distance = 20.0 * view.scene.camera->near * 4.0;
        for (int angle = 0; angle < 360; angle += 5) {
            view.options.orbit.azimuthDeg = angle;
            view.options.orbit.elevationDeg = 20.0;
            const render::FramePlan plan =
                support::planScene(view.scene, view.options, assets, meshes);
            for (const render::DrawItem& item : plan.items) met.insert(item.mesh->id);
        }
        INFO(subject.name);
        CHECK(met.size() <= 8);
    }
}

TEST_CASE("half the error lowers the median of the true error over 100 cameras") {
    Lottery lottery(31);
    render::MeshLibrary meshes(std::size_t{64} << 20);
    for (int kind = 2; kind < 12; ++kind) {  // planes and boxes have none
        std::vector<double> whole, half;
        std::string name;
        while (whole.size() < 100) {
            std::map<std::string, std::string> files;
            const Subject subject = lottery.subject(kind, files);
            View view = viewOf(lottery, subject);
            const scene::BundleAssets assets(files);
            // Fine enough that the roundUpToStep's coarsest mesh is not the one for both.
            view.options.errorPx = 0.5;
            const render::FramePlan coarse =
                support::planScene(view.scene, view.options, assets, meshes);
            if (coarse.items.empty()) continue;
            view.options.errorPx = 0.25;
            const render::FramePlan fine =
                support::planScene(view.scene, view.options, assets, meshes);
            whole.push_back(worstPx(subject, coarse, lottery));
            half.push_back(worstPx(subject, fine, lottery));
            name = subject.name;
        }
        const auto median = [](std::vector<double>& all) {
            std::nth_element(all.begin(), all.begin() + 50, all.end());
            return all[50];
        };
        const double before = median(whole), after = median(half);
        std::printf("%-11s median of the true error: %.3f px at 0.5, %.3f px at 0.25\n",
                    name.c_str(), before, after);
        CAPTURE(name, before, after);
        CHECK(after < before);
    }
}
