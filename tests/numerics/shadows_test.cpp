#include <algorithm>
#include <catch2/catch.hpp>
#include <iostream>

#include "scene/read/reader.h"
#include "tests/numerics/sweep.h"
#include "tests/support/ray_caster/tracer.h"

// Shadows from one end of the numbers to the other, against the ray caster's.
using namespace farol;
using namespace farol::numerics;

namespace {

constexpr int kSide = 128;
constexpr double kMostOff = 8.0;  // levels
constexpr int kBesidePx = 3;      // of a shadow's edge
constexpr double kMostWrong = 0.02;

glm::dvec3 direction(Sweep& sweep) {
    for (;;) {
        const double x = sweep.between(-1, 1), y = sweep.between(-1, 1);
        const glm::dvec3 v(x, y, sweep.between(-1, 1));
        const double size = glm::length(v);
        if (size > 0.1 && size <= 1.0) return v / size;
    }
}

std::string place(const char* kind, const glm::dvec3& value) {
    std::string out;
    for (int i = 0; i < 3; ++i)
        out += std::string(" ") + kind + "XYZ"[i] + "=\"" + text(value[i]) + '"';
    return out;
}

std::string model(const glm::dvec3& at, const std::string& command) {
    return "<group><transform><translate " + xyz(at) + "/></transform><models><model command=\"" +
           command + "\" diffuse=\"#c0c0c0\"/></models></group>";
}

/// A floor with a ball and a box above it, seen from near, and what may stand anywhere else.
std::string random(Sweep& sweep) {
    const double size = sweep.power(1e-3, 1e3);
    const glm::dvec3 origin =
        sweep.chance(0.5) ? glm::dvec3(0.0) : direction(sweep) * size * sweep.power(1.0, 1e6);
    glm::dvec3 towards = direction(sweep);
    towards.y = std::abs(towards.y) + 0.4;
    if (sweep.chance(0.1)) towards.y = -towards.y;  // from under the floor
    towards = glm::normalize(towards);
    Camera camera;
    const glm::dvec3 across(sweep.between(-1.0, 1.0), sweep.between(1.0, 2.0), 1.0);
    camera.target = origin + glm::dvec3(0.0, 0.4 * size, 0.0);
    camera.eye = camera.target + glm::normalize(across) * size * 6.0;
    camera.fovDeg = 35.0;
    camera.near = 0.05 * size;
    camera.far = size * 25.0;  // models farther off are out of view
    std::string light;
    const double kind = sweep.between(0.0, 1.0);
    if (kind < 0.35) {
        light = "<light type=\"directional\"" + place("dir", towards) + "/>";
        if (sweep.chance(0.5)) camera.far = size * sweep.power(25.0, 1e7);
    } else {
        const glm::dvec3 at = origin + towards * size * sweep.power(3.0, 1e9);
        light = std::string("<light type=\"") + (kind < 0.65 ? "spot" : "point") + '"' +
                place("pos", at);
        if (kind < 0.65)
            light += place("dir", -towards) + " cutoff=\"" + text(sweep.between(30.0, 80.0)) + '"';
        light += "/>";
    }
    std::string models =
        model(origin, "plane " + text(size * (sweep.chance(0.5) ? 8.0 : sweep.power(8.0, 1e6)))) +
        model(origin + glm::dvec3(0.7, 0.8, 0.2) * size, "sphere " + text(0.5 * size)) +
        model(origin + glm::dvec3(-0.6, 0.5, 0.1) * size, "box " + text(0.7 * size));
    if (sweep.chance(0.3))  // the floor casts, too
        models += model(origin - glm::dvec3(0.0, size, 0.0), "box " + text(0.5 * size));
    const int others = static_cast<int>(sweep.between(0.0, 3.0));
    for (int i = 0; i < others; ++i) {
        const double away = size * sweep.power(30.0, 1e8);
        models += model(origin + direction(sweep) * away,
                        "sphere " + text(std::clamp(away * sweep.power(1e-4, 0.2), 1e-4, 1e9)));
    }
    return "<world><render shadows=\"map\" shading=\"phong\"/>" + camera.xml() + "<lights>" +
           light + "</lights>" + models + "</world>";
}

struct Figures {
    int compared = 0, wrong = 0;
};

/// True within kBesidePx of a pixel that other lights reach, or that shows something else.
bool isNearEdge(const reference::Picture& exact, int x, int y) {
    const std::size_t here = exact.at(x, y);
    for (int j = std::max(0, y - kBesidePx); j <= std::min(exact.height - 1, y + kBesidePx); ++j)
        for (int i = std::max(0, x - kBesidePx); i <= std::min(exact.width - 1, x + kBesidePx);
             ++i) {
            const std::size_t there = exact.at(i, j);
            if (exact.id[there] != exact.id[here] || exact.lit[there] != exact.lit[here])
                return true;
        }
    return false;
}

Figures compare(const std::string& xml) {
    const image::Image image = draw(xml, kSide);
    const scene::Scene scene = scene::read(xml, {}, scene::BundleAssets()).scene;
    reference::Options options;
    options.width = options.height = kSide;
    options.shadows = true;
    options.threads = 1;
    const reference::Picture exact =
        reference::traceCenters(reference::makeWorld(scene, {}, options), 1);
    Figures figures;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const std::size_t at = exact.at(x, y);
            if (exact.id[at] == 0 || exact.edge[at] != reference::kInterior) continue;
            if (isNearEdge(exact, x, y)) continue;
            ++figures.compared;
            double off = 0.0;
            for (int c = 0; c < 3; ++c)
                off = std::max(off, std::abs(pixel(image, x, y)[c] - 255.0 * exact.color[at][c]));
            figures.wrong += off > kMostOff ? 1 : 0;
        }
    return figures;
}

}  // namespace

TEST_CASE("shadows at hand are those of rays, however far the light and other models are") {
    Sweep sweep("shadows", 40);
    int bad = 0;
    std::int64_t compared = 0, wrong = 0;
    for (int i = 0; i < sweep.cases(); ++i) {
        const std::string xml = random(sweep);
        const Figures figures = compare(xml);
        compared += figures.compared;
        wrong += figures.wrong;
        if (figures.wrong > kMostWrong * figures.compared && ++bad <= 5)
            UNSCOPED_INFO(figures.wrong << " of " << figures.compared << " px wrong: " << xml);
    }
    std::cout << "shadows: " << wrong << " of " << compared << " px wrong" << std::endl;
    CHECK(bad == 0);
    CHECK(compared > 1000 * sweep.cases());
}
