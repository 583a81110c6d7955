#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <random>

#include "tests/support/ray_caster/shape.h"

using namespace farol;
using namespace farol::reference;

namespace {

using Implicit = std::function<double(const glm::dvec3&)>;

glm::dvec3 randomIn(std::mt19937_64& random, double size) {
    std::uniform_real_distribution<double> number(-size, size);
    const double x = number(random), y = number(random), z = number(random);
    return {x, y, z};
}

std::optional<Hit> first(const Shape& shape, const Ray& ray) {
    Nearest nearest(0.0, 1e300, false);
    shape.intersect(ray, nearest);
    if (!nearest.found()) return std::nullopt;
    return nearest.best();
}

/// Marches along the ray and halves where the sign changes from outside (> 0) to inside: slow,
/// and sure to share nothing with the closed forms.
std::optional<double> march(const Implicit& inside, const Ray& ray, double from, double to) {
    constexpr int kSteps = 4000;
    double before = inside(ray.at(from));
    for (int i = 1; i <= kSteps; ++i) {
        double low = from + (to - from) * (i - 1) / kSteps, high = from + (to - from) * i / kSteps;
        const double here = inside(ray.at(high));
        if (before > 0.0 && here <= 0.0) {
            for (int k = 0; k < 60; ++k) {
                const double middle = 0.5 * (low + high);
                (inside(ray.at(middle)) > 0.0 ? low : high) = middle;
            }
            return 0.5 * (low + high);
        }
        before = here;
    }
    return std::nullopt;
}

double distanceToBox(const glm::dvec3& p, const glm::dvec3& half) {
    const glm::dvec3 q = glm::abs(p) - half;
    return std::max({q.x, q.y, q.z});
}

double frustumValue(const glm::dvec3& p, double bottom, double top, double height) {
    const double radius = bottom + (top - bottom) * p.y / height;
    return std::max({std::hypot(p.x, p.z) - radius, -p.y, p.y - height});
}

double torusValue(const glm::dvec3& p, double ring, double tube) {
    return std::hypot(std::hypot(p.x, p.z) - ring, p.y) - tube;
}

struct Solid {
    std::string words;
    Implicit value;  ///< < 0 inside
};

std::vector<Solid> solids() {
    return {
        {"sphere 1.3", [](const glm::dvec3& p) { return glm::length(p) - 1.3; }},
        {"ellipsoid 1 0.4 1.7",
         [](const glm::dvec3& p) { return glm::length(p / glm::dvec3(1, 0.4, 1.7)) - 1.0; }},
        {"dome 1.3", [](const glm::dvec3& p) { return std::max(glm::length(p) - 1.3, -p.y); }},
        {"box 1 2 1.5",
         [](const glm::dvec3& p) { return distanceToBox(p, glm::dvec3(0.5, 1.0, 0.75)); }},
        {"cone 1 2", [](const glm::dvec3& p) { return frustumValue(p, 1, 0, 2); }},
        {"cylinder 0.7 1.5", [](const glm::dvec3& p) { return frustumValue(p, 0.7, 0.7, 1.5); }},
        {"frustum 0.4 1.1 1.2", [](const glm::dvec3& p) { return frustumValue(p, 0.4, 1.1, 1.2); }},
        {"torus 1 0.4", [](const glm::dvec3& p) { return torusValue(p, 1, 0.4); }},
        {"torus 1.5 0.05", [](const glm::dvec3& p) { return torusValue(p, 1.5, 0.05); }},
    };
}

std::unique_ptr<Shape> shapeOf(const std::string& words) {
    scene::Model model;
    model.command = words;
    return makeShape(wordsOf(model), scene::UvLayout::face, {});
}

}  // namespace

TEST_CASE("rays meet solids where marching along their implicit functions does") {
    std::mt19937_64 random(1);
    for (const Solid& solid : solids()) {
        const std::unique_ptr<Shape> shape = shapeOf(solid.words);
        int hits = 0;
        for (int i = 0; i < 300; ++i) {
            const glm::dvec3 from = 6.0 * glm::normalize(randomIn(random, 1.0));
            const Ray ray{from, glm::normalize(randomIn(random, 1.5) - from)};
            const auto hit = first(*shape, ray);
            const auto marched = march(solid.value, ray, 0.0, 12.0);
            INFO(solid.words << " ray " << i);
            // A march may step over a graze; it never finds what is not there.
            if (marched) REQUIRE(hit);
            if (!hit) continue;
            ++hits;
            CHECK(std::abs(solid.value(ray.at(hit->t))) < 1e-12);
            if (marched) CHECK(hit->t <= *marched + 1e-9);
            if (marched && hit->t < *marched - 1e-9)  // a chord shorter than a step
                CHECK(solid.value(ray.at(hit->t + 12.0 / 4000)) > 0.0);
        }
        INFO(solid.words << ": " << hits << " hits");
        CHECK(hits > 10);
    }
}

TEST_CASE("normals are the numerical gradients of the implicit functions") {
    std::mt19937_64 random(2);
    constexpr double kStep = 1e-6;
    for (const Solid& solid : solids()) {
        const std::unique_ptr<Shape> shape = shapeOf(solid.words);
        for (int i = 0; i < 200; ++i) {
            const glm::dvec3 from = 6.0 * glm::normalize(randomIn(random, 1.0));
            const Ray ray{from, glm::normalize(randomIn(random, 1.5) - from)};
            const auto hit = first(*shape, ray);
            if (!hit) continue;
            const Surface s = shape->surface(ray, *hit);
            glm::dvec3 gradient;
            for (int axis = 0; axis < 3; ++axis) {
                glm::dvec3 step(0.0);
                step[axis] = kStep;
                gradient[axis] = solid.value(s.point + step) - solid.value(s.point - step);
            }
            INFO(solid.words << " ray " << i);
            CHECK(glm::length(s.normal) == Approx(1.0).epsilon(1e-12));
            CHECK(glm::length(glm::normalize(gradient) - s.normal) < 1e-5);
        }
    }
}

TEST_CASE("the gradients of texture coordinates are their numerical ones along the surface") {
    std::mt19937_64 random(3);
    const std::string patch =
        "1\n0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15\n16\n"
        "-1.5,-1.5,.2\n-.5,-1.5,0\n.5,-1.6,.3\n1.5,-1.5,0\n-1.5,-.5,.5\n-.5,-.5,.9\n.5,-.5,1\n"
        "1.5,-.4,.2\n-1.4,.5,.3\n-.5,.5,.8\n.5,.5,.7\n1.5,.5,0\n-1.5,1.5,0\n-.5,1.5,.1\n"
        ".5,1.5,.3\n1.5,1.5,.4\n";
    const std::string profile =
        "ply\nformat ascii 1.0\nelement vertex 4\nend_header\n"
        "1 -1 0\n1.2 0 0\n0.6 .5 0\n0 1 0\n";
    for (const std::string words :
         {"sphere 1.3", "dome 1.3", "ellipsoid 1 .4 1.7", "box 1 2 1.5", "cone 1 2",
          "cylinder .7 1.5", "torus 1 .4", "plane 2", "ring .2 1.4", "patch it", "revolution it"}) {
        for (const scene::UvLayout layout : {scene::UvLayout::face, scene::UvLayout::atlas}) {
            scene::Model model;
            model.command = words;
            const std::unique_ptr<Shape> shape =
                makeShape(wordsOf(model), layout, {{"it", words[0] == 'p' ? patch : profile}});
            int checked = 0;
            for (int i = 0; i < 300; ++i) {
                const glm::dvec3 from = 6.0 * glm::normalize(randomIn(random, 1.0));
                const Ray ray{from, glm::normalize(randomIn(random, 1.0) - from)};
                Ray aside = ray;
                aside.direction += 1e-6 * randomIn(random, 1.0);
                const auto hit = first(*shape, ray), near = first(*shape, aside);
                if (!hit || !near || hit->face != near->face) continue;
                const Surface a = shape->surface(ray, *hit), b = shape->surface(aside, *near);
                const glm::dvec3 step = b.point - a.point;
                const glm::dvec2 change = b.uv - a.uv;
                const glm::dvec2 predicted(glm::dot(0.5 * (a.gradU + b.gradU), step),
                                           glm::dot(0.5 * (a.gradV + b.gradV), step));
                if (glm::length(change) > 0.5 || glm::length(step) > 1e-3) continue;  // the seam
                INFO(words << " ray " << i);
                CHECK(glm::length(change - predicted) < 1e-4 * glm::length(change) + 1e-11);
                ++checked;
            }
            INFO(words << ": " << checked << " checked");
            CHECK(checked > 20);
        }
    }
}

TEST_CASE("texture coordinates follow the conventions of the scene language") {
    const auto uvAt = [](const std::string& words, const glm::dvec3& from, const glm::dvec3& to) {
        const std::unique_ptr<Shape> shape = shapeOf(words);
        const Ray ray{from, to - from};
        const auto hit = first(*shape, ray);
        REQUIRE(hit);
        return shape->surface(ray, *hit).uv;
    };
    const auto near = [](const glm::dvec2& a, const glm::dvec2& b) {
        return glm::length(a - b) < 1e-9;
    };
    const glm::dvec3 center(0.0);
    // The sphere starts at +Z and grows towards +X, from the south pole upwards.
    CHECK(near(uvAt("sphere 1", {5, 0, 0}, center), {0.25, 0.5}));
    CHECK(near(uvAt("sphere 1", {0, 0, -5}, center), {0.5, 0.5}));
    CHECK(near(uvAt("sphere 1", {5, 5, 0}, center), {0.25, 0.75}));
    // The dome's picture begins at the rim; its base is a disc with +Z up.
    CHECK(near(uvAt("dome 1", {5, 5, 0}, center), {0.25, 0.5}));
    CHECK(near(uvAt("dome 2", {1, -5, 0.5}, {1, 0, 0.5}), {0.75, 0.625}));
    CHECK(near(uvAt("cylinder 1 2", {-5, 0.5, 0}, {0, 0.5, 0}), {0.75, 0.25}));
    CHECK(near(uvAt("cone 1 2", {5, 1, 0}, {0, 1, 0}), {0.25, 0.5}));
    CHECK(near(uvAt("torus 2 0.5", {6, 0, 0}, center), {0.25, 0.0}));
    CHECK(near(uvAt("torus 2 0.5", {2, 6, 0}, {2, 0, 0}), {0.25, 0.25}));
    // The plane: u along +X, v towards -Z. The box: upright, the top's upper edge at +Z.
    CHECK(near(uvAt("plane 2", {0.5, 5, 0.5}, {0.5, 0, 0.5}), {0.75, 0.25}));
    CHECK(near(uvAt("box 2", {0.5, 0.5, 5}, {0.5, 0.5, 0}), {0.75, 0.75}));
    CHECK(near(uvAt("box 2", {0.5, 0.5, -5}, {0.5, 0.5, 0}), {0.25, 0.75}));
    CHECK(near(uvAt("box 2", {5, 0.5, 0.5}, {0, 0.5, 0.5}), {0.25, 0.75}));
    CHECK(near(uvAt("box 2", {0.5, 5, 0.5}, {0.5, 0, 0.5}), {0.75, 0.75}));
}

TEST_CASE("silhouettes of torus, cylinder and cone stand where tangents from the eye say") {
    constexpr double kAside = 1e-7;  // rays this far inside and outside tell hit from miss
    const auto hits = [](const std::string& words, const glm::dvec3& eye, const glm::dvec3& d) {
        return first(*shapeOf(words), {eye, d}).has_value();
    };
    SECTION("torus from above: both tangents to the tube's circle") {
        const double ring = 2.0, tube = 0.5, height = 7.0;
        const double middle = std::atan2(ring, height);
        const double half = std::asin(tube / std::hypot(ring, height));
        for (const double turn : {0.0, 0.7, 2.0, 4.0})
            for (const double side : {-1.0, 1.0}) {
                const auto ray = [&](double inwards) {
                    const double angle = middle + side * (half - inwards);
                    return glm::dvec3(std::sin(angle) * std::cos(turn), -std::cos(angle),
                                      std::sin(angle) * std::sin(turn));
                };
                CHECK(hits("torus 2 0.5", {0, height, 0}, ray(kAside)));
                CHECK_FALSE(hits("torus 2 0.5", {0, height, 0}, ray(-kAside)));
            }
    }
    SECTION("cylinder from the side: asin(r/d)") {
        const double angle = std::asin(1.0 / 5.0);
        for (const double side : {-1.0, 1.0}) {
            const auto ray = [&](double inwards) {
                const double a = side * (angle - inwards);
                return glm::dvec3(std::sin(a), 0.0, -std::cos(a));
            };
            CHECK(hits("cylinder 1 4", {0, 2, 5}, ray(kAside)));
            CHECK_FALSE(hits("cylinder 1 4", {0, 2, 5}, ray(-kAside)));
        }
    }
    SECTION("cone from its apex's height: the planes x = r (h - y)/h") {
        for (const double down : {0.1, 0.3})
            for (const double side : {-1.0, 1.0}) {
                const auto ray = [&](double inwards) {
                    return glm::dvec3(side * (down * 0.5 - inwards), -down, -1.0);
                };
                CHECK(hits("cone 1 2", {0, 2, 5}, ray(kAside)));
                CHECK_FALSE(hits("cone 1 2", {0, 2, 5}, ray(-kAside)));
            }
    }
}

TEST_CASE("only outward faces count, unless backs are asked for") {
    const std::unique_ptr<Shape> sphere = shapeOf("sphere 2");
    const Ray inside{{0, 0, 0}, {0, 0, -1}};
    CHECK_FALSE(first(*sphere, inside));
    Nearest both(0.0, 1e300, true);
    sphere->intersect(inside, both);
    REQUIRE(both.found());
    CHECK(both.best().t == Approx(2.0));
    CHECK(first(*shapeOf("plane 2"), {{0, 1, 0}, {0, -1, 0}}));
    CHECK_FALSE(first(*shapeOf("plane 2"), {{0, -1, 0}, {0, 1, 0}}));
    CHECK(first(*shapeOf("ring 0 2"), {{0, 1, 0}, {0, -1, 0}}));
    CHECK(first(*shapeOf("ring 0 2"), {{0, -1, 0}, {0, 1, 0}}));
}

TEST_CASE("roots stay exact from far away") {
    // A unit sphere a million away: the closest approach keeps the digits.
    const std::unique_ptr<Shape> sphere = shapeOf("sphere 1");
    const Ray ray{{0.6, 0, 1e6}, {0, 0, -1}};
    const auto hit = first(*sphere, ray);
    REQUIRE(hit);
    CHECK(1e6 - hit->t == Approx(0.8).epsilon(1e-9));
    const std::unique_ptr<Shape> torus = shapeOf("torus 1 0.25");
    const auto side = first(*torus, {{1e6, 0, 0}, {-1, 0, 0}});
    REQUIRE(side);
    CHECK(1e6 - side->t == Approx(1.25).epsilon(1e-9));
}

TEST_CASE("words of models") {
    scene::Model model;
    model.file = "demos/sphere_1_8_8.3d";
    CHECK(wordsOf(model) == std::vector<std::string>{"sphere", "1", "8", "8"});
    model.command = "cone 1 2";
    CHECK(wordsOf(model) == std::vector<std::string>{"cone", "1", "2"});
    CHECK_THROWS(makeShape({"bunny"}, scene::UvLayout::face, {}));
    CHECK_THROWS(makeShape({"sphere", "x"}, scene::UvLayout::face, {}));
    CHECK_THROWS(makeShape({"sphere"}, scene::UvLayout::face, {}));
    CHECK_THROWS(makeShape({"patch", "none"}, scene::UvLayout::face, {}));
}
