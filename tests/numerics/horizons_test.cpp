#include <catch2/catch.hpp>

#include "tests/numerics/sweep.h"

// Spheres of any size from places of any height above them, against the exact outline and light.
using namespace farol;
using namespace farol::numerics;

namespace {

constexpr int kSide = 48;
constexpr glm::dvec3 kSun{0.36, 0.8, 0.48};  ///< unit

struct Globe {
    glm::dvec3 center{0.0};
    double radius = 1.0;
    Camera camera;

    /// How bright the sphere is there, 0..1; negative beside it.
    double at(double x, double y) const {
        using real = long double;
        const glm::dvec3 ray = camera.ray(x, y, kSide);
        real a = 0.0L, b = 0.0L, c = -real(radius) * real(radius);
        for (int k = 0; k < 3; ++k) {
            const real from = real(camera.eye[k]) - real(center[k]);
            a += real(ray[k]) * real(ray[k]);
            b += real(ray[k]) * from;
            c += from * from;
        }
        const real root = b * b - a * c;
        if (!(root >= 0.0L) || !(b < 0.0L)) return -1.0;
        const real t = c / (std::sqrt(root) - b);
        if (t < real(camera.near) || t > real(camera.far)) return -1.0;
        double light = 0.0;
        for (int k = 0; k < 3; ++k)
            light += kSun[k] *
                     static_cast<double>(
                         (real(camera.eye[k]) - real(center[k]) + t * real(ray[k])) / real(radius));
        return std::max(0.0, light);
    }
};

/// An eye above the middle of the image's lower half or of its horizon.
Globe random(Sweep& sweep) {
    Globe globe;
    globe.radius = sweep.power(1e-2, 1e8);
    const double height = sweep.power(1e-10, 1.0);  // in radii
    const double turn = sweep.between(0.0, 6.2831853), rise = sweep.between(-1.4, 1.4);
    const glm::dvec3 up(std::cos(rise) * std::cos(turn), std::sin(rise),
                        std::cos(rise) * std::sin(turn));
    Camera& camera = globe.camera;
    camera.eye = up * (height * globe.radius);
    globe.center = -up * globe.radius;
    camera.fovDeg = sweep.power(0.01, 120.0);
    const double half = glm::radians(camera.fovDeg) / 2.0;
    const double horizon = std::atan(std::sqrt(height * (2.0 + height)));
    const double down =
        sweep.chance(0.7) ? horizon + sweep.between(-0.8, 0.8) * half : sweep.between(horizon, 1.5);
    const glm::dvec3 ahead = glm::normalize(glm::cross(up, glm::dvec3(up.z, up.x, up.y + 2.0)));
    camera.target = camera.eye + globe.radius * (std::cos(down) * ahead - std::sin(down) * up);
    camera.up = up;
    camera.near = std::max(1e-9, height * globe.radius * sweep.power(1e-2, 0.2));
    camera.far = 4.0 * globe.radius;
    return globe;
}

std::string sceneOf(const Globe& globe) {
    return "<world>" + globe.camera.xml() +
           R"(<lights><light type="directional" dirx="0.36" diry="0.8" dirz="0.48"/></lights>
              <group><transform><translate )" +
           xyz(globe.center) + R"(/></transform><models><model command="sphere )" +
           text(globe.radius) +
           R"("><color><diffuse R="255" G="255" B="255"/><ambient R="0" G="0" B="0"/>
              <emissive R="0" G="0" B="51"/></color></model></models></group></world>)";
}

}  // namespace

TEST_CASE("spheres have their exact outline and light from any height above them") {
    Sweep sweep("horizons", 160);
    int bad = 0, outlines = 0, lights = 0;
    for (int i = 0; i < sweep.cases(); ++i) {
        const Globe globe = random(sweep);
        const std::string xml = sceneOf(globe);
        const image::Image image = draw(xml, kSide);
        int off = 0, wrong = 0;
        bool hasInside = false, hasOutside = false;
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                const double middle = globe.at(x + 0.5, y + 0.5);
                constexpr double kMargin = 0.35;  // the bound is 0.25 px
                const auto same = [&](double dx, double dy) {
                    return (globe.at(x + 0.5 + dx, y + 0.5 + dy) < 0.0) == (middle < 0.0);
                };
                if (!same(0.0, kMargin) || !same(0.0, -kMargin) || !same(kMargin, 0.0) ||
                    !same(-kMargin, 0.0))
                    continue;
                const glm::ivec3 color = pixel(image, x, y);
                (middle < 0.0 ? hasOutside : hasInside) = true;
                if ((middle < 0.0) != (color.b < 40)) {
                    ++off;
                } else if (middle >= 0.0) {
                    wrong += std::abs(color.r - 255.0 * middle) > 3.0 ? 1 : 0;
                    ++lights;
                }
            }
        outlines += hasInside && hasOutside ? 1 : 0;
        if (off + wrong > 0 && ++bad <= 5)
            UNSCOPED_INFO(off << " px of the outline, " << wrong << " of the light wrong: " << xml);
    }
    CHECK(bad == 0);
    CHECK(outlines > sweep.cases() / 4);
    CHECK(lights > 200 * sweep.cases());
}
