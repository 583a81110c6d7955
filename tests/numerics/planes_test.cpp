#include <catch2/catch.hpp>
#include <iostream>
#include <optional>

#include "tests/numerics/sweep.h"

// Planes of any size before any camera, against the exact half-plane.
using namespace farol;
using namespace farol::numerics;

namespace {

constexpr int kSide = 48;
constexpr int kSquares = 8;    ///< of the chess texture, a side
constexpr int kRedSquare = 0;  ///< Ground::at of its first colour
constexpr glm::ivec3 kRed{255, 0, 0}, kBlue{0, 0, 255};

struct Ground {
    double size = 1.0;
    Camera camera;

    /// Where a ray through a place of the image meets the plane: shares of its size, in 0..1.
    std::optional<glm::dvec2> placeAt(double x, double y) const {
        const glm::dvec3 ray = camera.ray(x, y, kSide);
        if (!(ray.y < 0.0)) return std::nullopt;
        const double depth = camera.eye.y / -ray.y;
        const double u = (camera.eye.x + depth * ray.x) / size + 0.5;
        const double v = (camera.eye.z + depth * ray.z) / size + 0.5;
        const auto isIn = [](double share) { return share >= 0.0 && share < 1.0; };
        if (!isIn(u) || !isIn(v) || depth < camera.near || depth > camera.far) return std::nullopt;
        return glm::dvec2(u, v);
    }
    /// What it shows there: nothing; 0 or 1, the colours of a chess board's squares.
    std::optional<int> at(double x, double y) const {
        const std::optional<glm::dvec2> place = placeAt(x, y);
        if (!place) return std::nullopt;
        const glm::ivec2 square = *place * static_cast<double>(kSquares);
        return (square.x + square.y) % 2;
    }
};

/// An eye above a plane of that size, anywhere, looking at the ground or at the horizon.
Ground random(Sweep& sweep, double size, double fovDeg) {
    Ground ground;
    ground.size = size;
    Camera& camera = ground.camera;
    camera.fovDeg = fovDeg;
    const double height = sweep.power(1e-6, 1e6);
    camera.eye = {sweep.between(-0.4, 0.4) * ground.size, height,
                  sweep.between(-0.4, 0.4) * ground.size};
    const double turn = sweep.between(0.0, 6.2831853);
    const double half = glm::radians(camera.fovDeg) / 2.0;
    // Half of them see the horizon.
    const double down =
        sweep.chance(0.5) ? sweep.between(-0.8, 0.8) * half : sweep.power(1e-3, 1.5);
    // Far away, so that the text of the target loses nothing of the direction.
    const double away = ground.size + height;
    camera.target = camera.eye + away * glm::dvec3(std::cos(down) * std::sin(turn), -std::sin(down),
                                                   std::cos(down) * std::cos(turn));
    camera.near = std::max(1e-9, height * sweep.power(1e-3, 0.3));
    camera.far = 4.0 * away;
    return ground;
}

Ground random(Sweep& sweep) {
    const double size = sweep.power(1.0, 1e12);
    return random(sweep, size, sweep.power(1e-3, 170.0));
}

std::string sceneOf(const Ground& ground, bool isTextured) {
    const std::string look =
        isTextured
            ? R"(<texture file="chess:8x8" color1="red" color2="blue" filter="nearest"/>
                        <color><diffuse R="0" G="0" B="0"/><emissive R="255" G="255" B="255"/></color>)"
            : R"(<color><diffuse R="255" G="0" B="0"/><emissive R="255" G="0" B="0"/></color>)";
    // Shapes end at 1e9; a power of two changes no digit.
    const double scale = ground.size > 1e8 ? 0x1p20 : 1.0;
    return "<world>" + ground.camera.xml() +
           R"(<lights><light type="directional" dirx="1" diry="2" dirz="3"/></lights>
              <group><transform><scale )" +
           xyz(glm::dvec3(scale)) + R"(/></transform><models><model command="plane )" +
           text(ground.size / scale) + "\">" + look + "</model></models></group></world>";
}

/// Pixels that show something else than the exact plane does within `margin` px of their middle;
/// pixels at a border of the exact plane do not count.
int wrong(const Ground& ground, const image::Image& image, double margin, bool isTextured) {
    int count = 0;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const std::optional<int> middle = ground.at(x + 0.5, y + 0.5);
            const auto same = [&](double dx, double dy) {
                const std::optional<int> there = ground.at(x + 0.5 + dx, y + 0.5 + dy);
                return isTextured ? there == middle : there.has_value() == middle.has_value();
            };
            if (!same(margin, margin) || !same(-margin, margin) || !same(margin, -margin) ||
                !same(-margin, -margin))
                continue;
            const glm::ivec3 color = pixel(image, x, y);
            if (!middle)
                count += color != glm::ivec3(0) ? 1 : 0;
            else if (!isTextured)
                count += color.r < 200 ? 1 : 0;
            else
                count += color != (*middle == kRedSquare ? kRed : kBlue) ? 1 : 0;
        }
    return count;
}

/// The pixels of `shading=chess` that are of the wrong one of the plane's two triangles.
int wrongTriangles(const Ground& ground, const image::Image& image) {
    int count = 0;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const auto side = [&](double dx, double dy) {
                const std::optional<glm::dvec2> place = ground.placeAt(x + dx, y + dy);
                return place ? (place->x > place->y ? 1 : 0) : -1;
            };
            const int middle = side(0.5, 0.5);
            if (middle < 0 || side(0.2, 0.2) != middle || side(0.8, 0.2) != middle ||
                side(0.2, 0.8) != middle || side(0.8, 0.8) != middle)
                continue;
            const int red = pixel(image, x, y).r;
            count += (middle == 0 ? red < 200 : red < 40 || red > 90) ? 1 : 0;
        }
    return count;
}

}  // namespace

TEST_CASE("planes of 1 to 1e12 cover what the exact plane covers, before any camera") {
    Sweep sweep("planes", 240);
    int bad = 0, seen = 0;
    for (int i = 0; i < sweep.cases(); ++i) {
        const Ground ground = random(sweep);
        const std::string xml = sceneOf(ground, false);
        const scene::Shading shadings[] = {scene::Shading::phong, scene::Shading::flat,
                                           scene::Shading::chess, scene::Shading::gouraud};
        render::PictureOptions options;
        options.shading = shadings[i % 4];
        const image::Image image = draw(xml, kSide, options);
        const int off = options.shading == scene::Shading::chess ? wrongTriangles(ground, image)
                                                                 : wrong(ground, image, 0.1, false);
        if (off > 0 && ++bad <= 5) UNSCOPED_INFO(off << " px wrong: " << xml);
        seen += pixel(image, kSide / 2, kSide - 1).r > 0 ? 1 : 0;
    }
    CHECK(bad == 0);
    CHECK(seen > sweep.cases() / 4);
}

TEST_CASE("texture coordinates of planes of 1 to 1e12 are where the exact plane has them") {
    Sweep sweep("texture coordinates of planes", 120);
    int bad = 0, first = 0, second = 0;
    for (int i = 0; i < sweep.cases(); ++i) {
        const Ground ground = random(sweep);
        const std::string xml = sceneOf(ground, true);
        const image::Image image = draw(xml, kSide);
        const int off = wrong(ground, image, 0.5, true);
        if (off > 0 && ++bad <= 5) UNSCOPED_INFO(off << " px wrong: " << xml);
        first += pixel(image, kSide / 2, kSide - 1).r > 200 ? 1 : 0;
        second += pixel(image, kSide / 2, kSide - 1).b > 200 ? 1 : 0;
    }
    CHECK(bad == 0);
    CHECK(first > sweep.cases() / 16);
    CHECK(second > sweep.cases() / 16);
}

TEST_CASE("light at the corners of huge planes is interpolated over the whole of them") {
    Sweep sweep("light at corners", 40);
    int bad = 0, lit = 0;
    for (int i = 0; i < sweep.cases(); ++i) {
        const Ground ground = random(sweep, sweep.power(1e4, 1e12), sweep.power(1.0, 120.0));
        const glm::dvec3 light = ground.size * glm::dvec3(0.3, 0.4, -0.2);
        const auto cornerLight = [&](double u, double v) {
            const glm::dvec3 corner(ground.size * (u - 0.5), 0.0, ground.size * (v - 0.5));
            return glm::normalize(light - corner).y;
        };
        const double c00 = cornerLight(0, 0), c01 = cornerLight(0, 1), c10 = cornerLight(1, 0),
                     c11 = cornerLight(1, 1);
        const double scale = ground.size > 1e8 ? 0x1p20 : 1.0;
        const std::string xml =
            "<world>" + ground.camera.xml() + "<lights><light type=\"point\" posX=\"" +
            text(light.x) + "\" posY=\"" + text(light.y) + "\" posZ=\"" + text(light.z) +
            "\"/></lights><group><transform><scale " + xyz(glm::dvec3(scale)) +
            "/></transform><models><model command=\"plane " + text(ground.size / scale) +
            R"("><color><diffuse R="255" G="255" B="255"/><ambient R="0" G="0" B="0"/></color>
               </model></models></group></world>)";
        render::PictureOptions options;
        options.shading = scene::Shading::gouraud;
        const image::Image image = draw(xml, kSide, options);
        int off = 0;
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                const auto place = ground.placeAt(x + 0.5, y + 0.5);
                if (!place || !ground.placeAt(x + 0.5, y) || !ground.placeAt(x + 0.5, y + 1.0) ||
                    !ground.placeAt(x, y + 0.5) || !ground.placeAt(x + 1.0, y + 0.5))
                    continue;
                const double u = place->x, v = place->y;
                const double expected = v > u ? c00 * (1 - v) + c01 * (v - u) + c11 * u
                                              : c00 * (1 - u) + c10 * (u - v) + c11 * v;
                off += std::abs(pixel(image, x, y).r - 255.0 * expected) > 2.0 ? 1 : 0;
                ++lit;
            }
        if (off > 0 && ++bad <= 5) UNSCOPED_INFO(off << " px wrong: " << xml);
    }
    CHECK(bad == 0);
    CHECK(lit > 200 * sweep.cases());
}

// The table of docs/benchmarks/numerics.md; run by its tag alone.
TEST_CASE("views of planes that are wrong, by size and field of view", "[.table]") {
    constexpr int kViews = 24;
    for (const double size : {1e1, 1e3, 1e5, 1e7, 1e9, 1e12})
        for (const double fov : {0.001, 0.1, 5.0, 60.0, 170.0}) {
            Sweep sweep("table", kViews);
            int bad = 0;
            for (int i = 0; i < kViews; ++i) {
                const Ground ground = random(sweep, size, fov);
                bad += wrong(ground, draw(sceneOf(ground, false), kSide), 0.1, false) > 0 ? 1 : 0;
            }
            std::cout << size << " " << fov << ": " << bad << " of " << kViews << std::endl;
            CHECK(bad == 0);
        }
}
