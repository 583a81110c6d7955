#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/support/ray_caster/roots.h"
#include "tests/support/ray_caster/shape.h"

using namespace farol::reference;

namespace {

/// x = u, y = v, and the height by the given Bezier ordinates.
PatchNet graph(const std::array<double, 16>& heights) {
    PatchNet net;
    for (std::size_t k = 0; k < 16; ++k)
        net.emplace_back(static_cast<double>(k % 4) / 3.0, static_cast<double>(k / 4) / 3.0,
                         heights[k]);
    return net;
}

/// Bezier ordinates of u^2 - v^2 (u^2: 0 0 1/3 1).
PatchNet saddle() {
    const double square[4] = {0.0, 0.0, 1.0 / 3.0, 1.0};
    std::array<double, 16> heights{};
    for (std::size_t k = 0; k < 16; ++k) heights[k] = square[k % 4] - square[k / 4];
    return graph(heights);
}

std::vector<double> allHits(const Shape& shape, const Ray& ray) {
    std::vector<double> found;
    double from = -1e300;
    for (;;) {
        Nearest nearest(from, 1e300, true);
        shape.intersect(ray, nearest);
        if (!nearest.found()) return found;
        found.push_back(nearest.best().t);
        from = nearest.best().t + 1e-7;
    }
}

}  // namespace

TEST_CASE("a flat patch is met as its plane is") {
    const auto shape = makePatches({graph({})});
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> number(-0.2, 1.2);
    int inside = 0;
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 target(number(random), number(random), 0.0);
        const glm::dvec3 from(number(random) * 4.0, number(random) * 4.0, 3.0);
        const Ray ray{from, target - from};
        Nearest nearest(0.0, 1e300, true);
        shape->intersect(ray, nearest);
        const bool expected =
            std::min(target.x, target.y) >= 0.0 && std::max(target.x, target.y) <= 1.0;
        CHECK(nearest.found() == expected);
        if (!nearest.found()) continue;
        ++inside;
        const Surface s = shape->surface(ray, nearest.best());
        CHECK(glm::length(s.point - target) < 1e-12);
        CHECK(glm::length(s.normal - glm::dvec3(0, 0, 1)) < 1e-12);
        CHECK(glm::length(s.uv - glm::dvec2(1.0 - target.x, 1.0 - target.y)) < 1e-12);
    }
    CHECK(inside > 100);
}

TEST_CASE("a saddle patch is met at the roots of its closed form, with its normal") {
    const auto shape = makePatches({saddle()});
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> number(0.0, 1.0);
    int hits = 0;
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 from(3.0 * number(random) - 1.0, 3.0 * number(random) - 1.0, 2.0);
        const glm::dvec3 through(number(random), number(random), number(random) - 0.5);
        const Ray ray{from, through - from};
        const glm::dvec3 o = from, d = ray.direction;
        // z = x^2 - y^2 along the ray
        std::vector<double> expected;
        for (const double t :
             solveQuadratic(d.x * d.x - d.y * d.y, 2.0 * (o.x * d.x - o.y * d.y) - d.z,
                            o.x * o.x - o.y * o.y - o.z)) {
            const glm::dvec3 p = ray.at(t);
            if (std::min(p.x, p.y) >= 0.0 && std::max(p.x, p.y) <= 1.0) expected.push_back(t);
        }
        const std::vector<double> found = allHits(*shape, ray);
        INFO("ray " << i);
        REQUIRE(found.size() == expected.size());
        for (std::size_t k = 0; k < found.size(); ++k) {
            ++hits;
            CHECK(found[k] == Approx(expected[k]).epsilon(1e-10));
            const Surface s =
                shape->surface(ray, {found[k], 0, 0, {ray.at(found[k]).x, ray.at(found[k]).y}});
            const glm::dvec3 n(-2.0 * s.point.x, 2.0 * s.point.y, 1.0);
            CHECK(glm::length(s.normal - glm::normalize(n)) < 1e-9);
        }
    }
    CHECK(hits > 300);
}

TEST_CASE("an extruded fold is met as often as its cubic has roots") {
    // x(u) = 6u^3 - 9u^2 + 3.6u turns back; y = u, z = v: rays along y meet it up to three times.
    const double x[4] = {0.0, 1.2, -0.6, 0.6};
    PatchNet net;
    for (std::size_t k = 0; k < 16; ++k)
        net.emplace_back(x[k % 4], static_cast<double>(k % 4) / 3.0,
                         static_cast<double>(k / 4) / 3.0);
    const auto shape = makePatches({net});
    for (int i = 0; i < 200; ++i) {
        const double at = -0.1 + 0.8 * i / 199.0;
        const double c[4] = {-at, 3.6, -9.0, 6.0};
        const Roots expected = solvePolynomial(c, 0.0, 1.0);
        const std::vector<double> found = allHits(*shape, {{at, -1.0, 0.4}, {0, 1, 0}});
        INFO("x = " << at);
        REQUIRE(found.size() == static_cast<std::size_t>(expected.count));
        for (std::size_t k = 0; k < found.size(); ++k)
            CHECK(found[k] - 1.0 == Approx(expected.at[k]).margin(1e-9));
    }
}

TEST_CASE("an arc of four points is the quarter cylinder to its known error") {
    // The usual quarter arc by 0.5523 is never more than 2.8e-4 off the circle, always outside.
    constexpr double k = 0.5522847498;
    const glm::dvec2 arc[4] = {{1, 0}, {1, k}, {k, 1}, {0, 1}};
    PatchNet net;
    for (std::size_t i = 0; i < 16; ++i)
        net.emplace_back(arc[i % 4].x, arc[i % 4].y, static_cast<double>(i / 4) / 3.0);
    const auto shape = makePatches({net});
    double worst = 0.0;
    for (int i = 1; i < 100; ++i) {
        const double angle = i * 1.5707963267948966 / 100.0;
        const Ray ray{{0, 0, 0.3}, {std::cos(angle), std::sin(angle), 0.0}};
        Nearest nearest(0.0, 1e300, true);
        shape->intersect(ray, nearest);
        REQUIRE(nearest.found());
        CHECK(nearest.best().t > 1.0 - 1e-9);
        worst = std::max(worst, nearest.best().t - 1.0);
        const Surface s = shape->surface(ray, nearest.best());
        CHECK(std::abs(glm::dot(s.normal, glm::normalize(ray.direction))) > 0.99999);
    }
    CHECK(worst == Approx(2.73e-4).epsilon(0.02));
}

TEST_CASE("a collapsed edge has the normal of the surface beside it") {
    // A corner of the plane z = 0 as a patch whose first row is one point.
    PatchNet net;
    for (std::size_t i = 0; i < 16; ++i) {
        const double r = static_cast<double>(i / 4) / 3.0, a = static_cast<double>(i % 4) / 3.0;
        net.emplace_back(r * (1.0 - a), r * a, 0.0);
    }
    const auto shape = makePatches({net});
    const Ray ray{{0, 0, 1}, {0, 0, -1}};
    const Surface s = shape->surface(ray, {1.0, 0, 0, {0.3, 0.0}});
    CHECK(std::abs(s.normal.z) == Approx(1.0).epsilon(1e-9));
}

TEST_CASE("a revolved profile is its cones and cylinders") {
    const auto shape = makeRevolution({{1, 0}, {1, 2}, {0.5, 3}});
    const auto at = [&](const Ray& ray) {
        Nearest nearest(0.0, 1e300, false);
        shape->intersect(ray, nearest);
        REQUIRE(nearest.found());
        return shape->surface(ray, nearest.best());
    };
    // From +X, turning towards -Z; t by arc length: 2 of 2 + sqrt(1.25).
    const double length = 2.0 + std::sqrt(1.25);
    const Surface low = at({{5, 0.5, 0}, {-1, 0, 0}});
    CHECK(low.point.x == Approx(1.0));
    CHECK(low.uv.y == Approx(0.5 / length));
    CHECK(at({{0, 0.5, -5}, {0, 0, 1}}).uv.x == Approx(0.25));
    const Surface high = at({{5, 2.5, 0}, {-1, 0, 0}});
    CHECK(high.point.x == Approx(0.75));
    const glm::dvec3 n = glm::normalize(glm::dvec3(1.0, 0.5, 0.0));
    CHECK(glm::length(high.normal - n) < 1e-12);
    // Half way up the upper band the normal lies between the vertex's mean and the band's own.
    const glm::dvec3 mean = glm::normalize(n + glm::dvec3(1, 0, 0));
    CHECK(glm::length(high.shadingNormal - glm::normalize(mean + n)) < 1e-12);
    // Run downwards, it is turned inside out: the same surface.
    const auto down = makeRevolution({{0.5, 3}, {1, 2}, {1, 0}});
    Nearest nearest(0.0, 1e300, false);
    down->intersect({{5, 2.5, 0}, {-1, 0, 0}}, nearest);
    CHECK(nearest.found());
}
