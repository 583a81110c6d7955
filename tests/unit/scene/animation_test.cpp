#include "scene/animation.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

using namespace farol::scene;

namespace {

/// Rounding of a few double operations on coordinates of size 10.
constexpr double kRounding = 1e-12;

using Points = std::vector<glm::dvec3>;
const Points kCourse = {{0, 0, 4}, {4, 0, 0}, {0, 0, -4}, {-4, 10, 0}};
const Points kTwisted = {{0, 0, 4}, {3, 5, 1}, {0, -2, -4}, {-4, 10, 0}, {2, 3, 3}};

double distance(const glm::dvec3& a, const glm::dvec3& b) { return glm::length(a - b); }

double difference(const glm::dmat4& a, const glm::dmat4& b) {
    double most = 0.0;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) most = std::max(most, std::abs(a[c][r] - b[c][r]));
    return most;
}

bool isFinite(const glm::dmat4& m) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            if (!std::isfinite(m[c][r])) return false;
    return true;
}

double orthonormalError(const glm::dmat4& m) {
    const glm::dmat3 r(m);
    double most = std::abs(glm::determinant(r) - 1.0);
    const glm::dmat3 product = glm::transpose(r) * r;
    for (int c = 0; c < 3; ++c)
        for (int k = 0; k < 3; ++k)
            most = std::max(most, std::abs(product[c][k] - (c == k ? 1.0 : 0.0)));
    return most;
}

glm::dmat4 along(const Points& points, double timeS, double seconds = 10.0) {
    return matrixAt(Transform(FollowCurve{seconds, true, points}), timeS);
}

}  // namespace

TEST_CASE("a curve passes through its points") {
    for (const Points& points : {kCourse, kTwisted})
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double u = static_cast<double>(i) / static_cast<double>(points.size());
            CHECK(distance(catmullRom(points, u).position, points[i]) < kRounding * 100);
        }
}

TEST_CASE("a curve's tangent at a point is that of its neighbours") {
    // Tension 1/2: P' = (next - previous) / 2 a segment, and a lap has 4 segments.
    const glm::dvec3 wanted = 0.5 * (kCourse[2] - kCourse[0]) * 4.0;
    CHECK(distance(catmullRom(kCourse, 0.25).tangent, wanted) < kRounding * 100);
}

TEST_CASE("position and tangent are continuous over points and laps") {
    constexpr double kStep = 1e-9;
    for (const Points& points : {kCourse, kTwisted})
        for (std::size_t i = 0; i <= points.size(); ++i) {
            const double u = static_cast<double>(i) / static_cast<double>(points.size());
            const CurvePoint before = catmullRom(points, u - kStep);
            const CurvePoint after = catmullRom(points, u + kStep);
            // The curve's derivatives are below 1e3 here.
            CHECK(distance(before.position, after.position) < 1e3 * kStep);
            CHECK(distance(before.tangent, after.tangent) < 1e4 * kStep);
        }
}

TEST_CASE("the tangent is the derivative of the position") {
    constexpr double kStep = 1e-5;
    for (double u = 0.013; u < 1.0; u += 0.05) {
        const glm::dvec3 slope =
            (catmullRom(kTwisted, u + kStep).position - catmullRom(kTwisted, u - kStep).position) /
            (2.0 * kStep);
        CHECK(distance(slope, catmullRom(kTwisted, u).tangent) < 1e-4);
    }
}

TEST_CASE("laps close, backwards and far away too") {
    for (const double u : {0.0, 0.1, 0.5, 0.999}) {
        const glm::dvec3 here = catmullRom(kTwisted, u).position;
        CHECK(distance(catmullRom(kTwisted, u + 3.0).position, here) < 1e-11);
        CHECK(distance(catmullRom(kTwisted, u - 2.0).position, here) < 1e-11);
        CHECK(difference(along(kTwisted, 10.0 * u), along(kTwisted, 10.0 * u + 70.0)) < 1e-9);
        CHECK(difference(along(kTwisted, 10.0 * u), along(kTwisted, 10.0 * u - 40.0)) < 1e-9);
    }
    CHECK(difference(along(kTwisted, 1e9), along(kTwisted, 0.0)) == 0.0);
}

TEST_CASE("few or coincident points make a curve without NaN") {
    const glm::dvec3 p{1, 2, 3}, q{4, 5, 6};
    for (const Points& points :
         {Points{p}, Points{p, q}, Points{p, q, {7, 0, 1}}, Points{p, p, p, p}, Points{p, p, q, q}})
        for (double t = 0.0; t <= 10.0; t += 0.37) {
            const glm::dmat4 m = along(points, t);
            CHECK(isFinite(m));
            CHECK(orthonormalError(m) < 1e-9);
        }
    CHECK(distance(catmullRom({p}, 0.3).position, p) < kRounding);
    CHECK(catmullRom({}, 0.3).position == glm::dvec3(0.0));
    CHECK(distance(catmullRom({p, q}, 0.5).position, q) < kRounding);
}

TEST_CASE("an aligned frame is orthonormal, x along the tangent, up near +Y at the start") {
    for (const Points& points : {kCourse, kTwisted})
        for (double t = 0.0; t < 10.0; t += 0.173) {
            const glm::dmat4 m = along(points, t);
            CHECK(orthonormalError(m) < 1e-9);
            const glm::dvec3 tangent = glm::normalize(catmullRom(points, t / 10.0).tangent);
            CHECK(distance(glm::dvec3(m[0]), tangent) < 1e-9);
        }
    // z = x cross up, y = z cross x with up = +Y.
    const glm::dmat4 start = along(kCourse, 0.0);
    const glm::dvec3 x = glm::normalize(catmullRom(kCourse, 0.0).tangent);
    const glm::dvec3 z = glm::normalize(glm::cross(x, glm::dvec3(0, 1, 0)));
    CHECK(distance(glm::dvec3(start[2]), z) < 1e-12);
    CHECK(distance(glm::dvec3(start[1]), glm::cross(z, x)) < 1e-12);
}

TEST_CASE("an aligned frame turns without a jump, over the end of a lap too") {
    // In a thousandth of a lap the tangent of these curves turns by less than 0.1 rad.
    for (const Points& points : {kCourse, kTwisted}) {
        glm::dmat4 last = along(points, 0.0);
        for (int i = 1; i <= 2000; ++i) {
            const glm::dmat4 next = along(points, 0.01 * i);
            REQUIRE(distance(glm::dvec3(last[1]), glm::dvec3(next[1])) < 0.1);
            last = next;
        }
    }
}

TEST_CASE("a curve in a plane keeps its side vector") {
    const Points ring = {{0, 0, 4}, {4, 0, 0}, {0, 0, -4}, {-4, 0, 0}};
    for (double t = 0.0; t < 20.0; t += 0.31)
        CHECK(distance(glm::dvec3(along(ring, t)[1]), {0, 1, 0}) < 1e-9);
}

TEST_CASE("a vertical tangent has a frame") {
    const Points loop = {{0, 0, 0}, {0, 4, 0}, {4, 4, 0}, {4, 0, 0}};
    const Points line = {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 0}};
    for (const Points& points : {loop, line})
        for (double t = 0.0; t < 10.0; t += 0.05) {
            const glm::dmat4 m = along(points, t);
            REQUIRE(isFinite(m));
            CHECK(orthonormalError(m) < 1e-9);
        }
}

TEST_CASE("rotations by time depend on the time alone") {
    const Transform spin = Spin{8.0, {0, 1, 0}};
    // A quarter turn about +Y takes +Z to +X.
    const glm::dvec4 z(0, 0, 1, 0);
    CHECK(distance(glm::dvec3(matrixAt(spin, 2.0) * z), {1, 0, 0}) == 0.0);
    CHECK(distance(glm::dvec3(matrixAt(spin, -2.0) * z), {-1, 0, 0}) == 0.0);
    CHECK(distance(glm::dvec3(matrixAt(Transform(Spin{-8.0, {0, 1, 0}}), 2.0) * z), {-1, 0, 0}) ==
          0.0);
    // A million turns later nothing has drifted.
    CHECK(difference(matrixAt(spin, 8e6 + 1.0), matrixAt(spin, 1.0)) == 0.0);
    CHECK(difference(matrixAt(spin, 0.0), glm::dmat4(1.0)) == 0.0);
}

TEST_CASE("rotation matrices") {
    const auto turned = [](double angle, const glm::dvec3& axis, const glm::dvec4& v) {
        return glm::dvec3(matrixAt(Transform(Rotate{angle, axis}), 0.0) * v);
    };
    CHECK(turned(90, {1, 0, 0}, {0, 1, 0, 0}) == glm::dvec3(0, 0, 1));
    CHECK(turned(-90, {1, 0, 0}, {0, 1, 0, 0}) == glm::dvec3(0, 0, -1));
    CHECK(turned(270, {0, 0, 2}, {1, 0, 0, 0}) == glm::dvec3(0, -1, 0));
    CHECK(turned(-450, {0, 0, 1}, {1, 0, 0, 0}) == glm::dvec3(0, -1, 0));
    CHECK(distance(turned(120, {1, 1, 1}, {1, 0, 0, 0}), {0, 1, 0}) < kRounding);
    CHECK(distance(turned(45, {0, 1e-30, 0}, {0, 0, 1, 0}), {std::sqrt(0.5), 0, std::sqrt(0.5)}) <
          kRounding);
    for (const glm::dvec3& axis : {glm::dvec3(1, 2, 3), glm::dvec3(-1e15, 1e15, 0)})
        CHECK(orthonormalError(matrixAt(Transform(Rotate{33.3, axis}), 0.0)) < 1e-12);
    CHECK(matrixAt(Transform(Rotate{90, glm::dvec3(0.0)}), 0.0) == glm::dmat4(1.0));
}

TEST_CASE("transforms multiply on the right, in document order") {
    const std::vector<Transform> order = {Translate{{1, 0, 0}}, Rotate{90, {0, 1, 0}},
                                          Scale{{2, 2, 2}}};
    // (0,0,1) is scaled to (0,0,2), turned to (2,0,0), moved to (3,0,0).
    CHECK(glm::dvec3(matrixAt(order, 0.0) * glm::dvec4(0, 0, 1, 1)) == glm::dvec3(3, 0, 0));
    const std::vector<Transform> other = {order[2], order[1], order[0]};
    CHECK(glm::dvec3(matrixAt(other, 0.0) * glm::dvec4(0, 0, 1, 1)) == glm::dvec3(2, 0, -2));
    CHECK(matrixAt(std::vector<Transform>{}, 5.0) == glm::dmat4(1.0));
}

TEST_CASE("the turning hue") {
    const Color hue{glm::vec3(1, 0, 0), true};
    const double sixth = kHueSeconds / 6.0;
    CHECK(colorAt(hue, 0.0) == glm::vec3(1, 0, 0));
    CHECK(colorAt(hue, sixth) == glm::vec3(1, 1, 0));
    CHECK(colorAt(hue, 2 * sixth) == glm::vec3(0, 1, 0));
    CHECK(colorAt(hue, 3 * sixth) == glm::vec3(0, 1, 1));
    CHECK(colorAt(hue, 4 * sixth) == glm::vec3(0, 0, 1));
    CHECK(colorAt(hue, 5 * sixth) == glm::vec3(1, 0, 1));
    CHECK(colorAt(hue, 0.5 * sixth) == glm::vec3(1, 0.5F, 0));
    CHECK(colorAt(hue, 1e6 * kHueSeconds) == glm::vec3(1, 0, 0));
    CHECK(colorAt(hue, -sixth) == glm::vec3(1, 0, 1));
    const Color still{glm::vec3(0.25F), false};
    CHECK(colorAt(still, 1.7) == glm::vec3(0.25F));
    for (double t = 0.0; t < kHueSeconds; t += 0.1) {
        const glm::vec3 c = colorAt(hue, t);
        CHECK(std::max({c.r, c.g, c.b}) == 1.0F);
        CHECK(std::min({c.r, c.g, c.b}) == 0.0F);
    }
}

TEST_CASE("scattered copies stay in their ring and are the same every time") {
    Scatter scatter;
    scatter.count = 2000;
    scatter.radiusMin = 19;
    scatter.radiusMax = 21;
    scatter.yMax = 1;
    const auto places = scatterMatrices(scatter, 7);
    REQUIRE(places.size() == 2000);
    double sum = 0.0, inner = 0.0;
    for (const glm::dmat4& m : places) {
        const double radius = std::hypot(m[3].x, m[3].z);
        CHECK(radius >= 19 - 1e-9);
        CHECK(radius <= 21 + 1e-9);
        CHECK(m[3].y >= 0.0);
        CHECK(m[3].y <= 1.0);
        sum += std::atan2(m[3].z, m[3].x);
        inner += radius < 20 ? 1 : 0;
    }
    // Uniform: the mean angle is 0 with deviation pi/sqrt(3 n) = 0.04, and the inner half of the
    // ring has (20^2-19^2)/(21^2-19^2) = 48.75 % with deviation 1.1 %; five deviations each.
    CHECK(std::abs(sum / 2000) < 0.2);
    CHECK(inner / 2000 == Approx(0.4875).margin(0.056));
    CHECK(scatterMatrices(scatter, 7) == places);
    CHECK(scatterMatrices(scatter, 8) != places);
    scatter.count = 0;
    CHECK(scatterMatrices(scatter, 7).empty());
}

TEST_CASE("what is animated") {
    Scene scene;
    CHECK_FALSE(isAnimated(scene));
    scene.groups.emplace_back().groups.emplace_back().transforms = {Rotate{1, {0, 1, 0}}};
    CHECK_FALSE(isAnimated(scene));
    scene.groups[0].groups[0].transforms.emplace_back(Spin{1, {0, 1, 0}});
    CHECK(isAnimated(scene));
    Scene curve;
    curve.groups.emplace_back().transforms = {FollowCurve{}};
    CHECK(isAnimated(curve));
    Scene hue;
    hue.groups.emplace_back().models.emplace_back().material.emplace().emissive.cycles = true;
    CHECK(isAnimated(hue));
    Scene entity;
    entity.entity = std::make_shared<Scene>(hue);
    CHECK(isAnimated(entity));
}
