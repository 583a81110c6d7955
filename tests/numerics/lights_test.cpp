#include <catch2/catch.hpp>

#include "scene/read/reader.h"
#include "tests/numerics/sweep.h"
#include "tests/support/ray_caster/tracer.h"

// Lights and materials from one end of the numbers to the other: no NaN, no infinity.
using namespace farol;
using namespace farol::numerics;

namespace {

constexpr int kSide = 16;
constexpr double kFloor = 0.2;  ///< emissive light of every material

std::string attribute(const char* name, double value) {
    return std::string(" ") + name + "=\"" + text(value) + '"';
}

/// 0, or a number of any size.
double any(Sweep& sweep, double low, double high) {
    return sweep.chance(0.25) ? 0.0 : sweep.power(low, high);
}

glm::dvec3 direction(Sweep& sweep) {
    for (;;) {
        const glm::dvec3 v(sweep.between(-1, 1), sweep.between(-1, 1), sweep.between(-1, 1));
        const double size = glm::length(v);
        if (size > 0.1 && size <= 1.0) return v / size;
    }
}

std::string colors(Sweep& sweep, const char* kind) {
    std::string out;
    for (const char* channel : {"R", "G", "B"})
        out += attribute((kind + std::string(channel)).c_str(), sweep.chance(0.3) ? 0.0
                                                                : sweep.chance(0.3)
                                                                    ? 1.0
                                                                    : sweep.power(1e-12, 1));
    return out;
}

std::string light(Sweep& sweep, double size) {
    const bool isSpot = sweep.chance(0.4);
    std::string out = "<light type=\"" +
                      std::string(isSpot              ? "spot"
                                  : sweep.chance(0.2) ? "directional"
                                                      : "point") +
                      '"';
    // At the surface, in it, near it, or anywhere.
    const glm::dvec3 at = direction(sweep) * (sweep.chance(0.5) ? size * sweep.power(1e-12, 10.0)
                                                                : any(sweep, 1e-12, 9e17));
    out += attribute("posX", at.x) + attribute("posY", at.y) + attribute("posZ", at.z);
    const glm::dvec3 towards = direction(sweep) * sweep.power(1e-8, 9e17);
    out +=
        attribute("dirX", towards.x) + attribute("dirY", towards.y) + attribute("dirZ", towards.z);
    double factors[3] = {any(sweep, 1e-37, 9e17), any(sweep, 1e-37, 9e17), any(sweep, 1e-37, 9e17)};
    if (factors[0] + factors[1] + factors[2] == 0.0) factors[sweep.chance(0.5) ? 1 : 2] = 2e-38;
    out += attribute("constant", factors[0]) + attribute("linear", factors[1]) +
           attribute("quadratic", factors[2]);
    if (isSpot)
        out += attribute("cutoff", sweep.between(0.0, 180.0)) +
               attribute("exponent", any(sweep, 1e-30, 1e4));
    return out + colors(sweep, "diff") + colors(sweep, "ambt") + colors(sweep, "spec") + "/>";
}

std::string material(Sweep& sweep) {
    return "<color><diffuse" + colors(sweep, "") + "/><ambient" + colors(sweep, "") +
           "/><specular" + colors(sweep, "") + "/><emissive" + attribute("R", kFloor) +
           attribute("G", kFloor) + attribute("B", kFloor) + "/><shininess" +
           attribute("value", any(sweep, 1e-38, 1e4)) + "/></color>";
}

struct Case {
    std::string xml;
    render::PictureOptions options;
    bool isExact = false;  ///< lit per pixel: the reference says the same
};

Case random(Sweep& sweep) {
    Case out;
    const double size = sweep.power(1e-4, 1e6);
    Camera camera;
    camera.eye = direction(sweep) * size * sweep.between(1.0, 3.0);
    camera.target = direction(sweep) * size * 0.1;
    camera.fovDeg = sweep.between(5.0, 120.0);
    camera.near = std::max(1e-9, size * sweep.power(1e-5, 1e-2));
    camera.far = size * 10.0;
    out.xml = "<world>" + camera.xml() + "<lights>";
    const int lights = 1 + static_cast<int>(sweep.between(0.0, 3.0));
    for (int i = 0; i < lights; ++i) out.xml += light(sweep, size);
    const char* const shapes[] = {"sphere ", "plane ", "box ", "cylinder ", "cone ", "torus "};
    std::string shape = shapes[static_cast<int>(sweep.between(0.0, 6.0))];
    const std::string radius = text(size * 0.5);
    if (shape == "cylinder " || shape == "cone ")
        shape += radius + ' ' + text(size);
    else if (shape == "torus ")
        shape += radius + ' ' + text(size * 0.2);
    else
        shape += shape == "plane " ? text(size * 3.0) : radius;
    std::string moves;
    if (sweep.chance(0.3))
        moves = "<transform><scale " +
                xyz({sweep.power(0.01, 2.0), sweep.power(1e-12, 2.0), sweep.power(0.01, 2.0)}) +
                "/></transform>";
    out.xml += "</lights><group>" + moves + "<models><model command=\"" + shape + "\">" +
               material(sweep) + "</model></models></group></world>";
    const scene::Shading shadings[] = {scene::Shading::phong, scene::Shading::phong,
                                       scene::Shading::gouraud, scene::Shading::flat};
    out.options.shading = shadings[static_cast<int>(sweep.between(0.0, 4.0))];
    out.options.viewer = sweep.chance(0.5) ? scene::Viewer::local : scene::Viewer::infinite;
    out.options.specular = sweep.chance(0.5) ? scene::Specular::single : scene::Specular::separate;
    out.options.samples = sweep.chance(0.5) ? 1 : 4;
    // An exponent of the cosine multiplies what floats lose of it: such spots are looked at for
    // NaN.
    const bool isSharp = out.xml.find("exponent=") != std::string::npos;
    out.isExact = !isSharp && out.options.samples == 1 &&
                  out.options.shading == scene::Shading::phong && moves.empty();
    return out;
}

std::string shadingName(const Case& one) {
    return *one.options.shading == scene::Shading::phong     ? "phong"
           : *one.options.shading == scene::Shading::gouraud ? "gouraud"
                                                             : "flat";
}

/// The exact image; with `share` other than 0, lights are moved and turned by that share.
reference::Picture exact(const Case& random, double share, const glm::dvec3& towards) {
    scene::Scene scene = scene::read(random.xml, {}, scene::BundleAssets()).scene;
    for (scene::Light& light : scene.lights) {
        light.position +=
            share * (glm::length(light.position) + glm::length(scene.camera->eye)) * towards;
        light.direction += share * glm::length(light.direction) * towards;
    }
    reference::Options options;
    options.width = options.height = kSide;
    options.viewer = *random.options.viewer;
    options.specular = *random.options.specular;
    options.threads = 1;
    return reference::traceCenters(reference::makeWorld(scene, {}, options), 1);
}

/// Pixels darker than half of what the material emits by itself: NaN and infinity are magenta,
/// nothing else takes light away. The background is white.
int dark(const image::Image& image) {
    int count = 0;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const glm::ivec3 color = pixel(image, x, y);
            const bool isDark =
                std::min({color.r, color.g, color.b}) < static_cast<int>(128 * kFloor);
            if (isDark) UNSCOPED_INFO("a pixel of " << color.r << ' ' << color.g << ' ' << color.b);
            count += isDark ? 1 : 0;
        }
    return count;
}

}  // namespace

TEST_CASE("no light and no material of finite numbers gives NaN or infinity") {
    Sweep sweep("lights and materials", 500);
    int bad = 0, compared = 0, off = 0;
    for (int i = 0; i < sweep.cases(); ++i) {
        Case one = random(sweep);
        one.options.background = "white";
        const image::Image image = drawMarked(one.xml, kSide, one.options);
        const int lost = dark(image);
        if (lost > 0 && ++bad <= 5)
            UNSCOPED_INFO(lost << " px dark, " << shadingName(one) << ": " << one.xml);
        if (*one.options.shading == scene::Shading::phong) {
            render::PictureOptions shadowed = one.options;
            shadowed.shadows = scene::Shadows::map;
            const int black = dark(drawMarked(one.xml, kSide, shadowed));
            if (black > 0 && ++bad <= 5)
                UNSCOPED_INFO(black << " px dark with shadows: " << one.xml);
        }
        if (!one.isExact) continue;
        const reference::Picture expected = exact(one, 0.0, {});
        // A float's rounding puts a light on either side of a near surface or cone.
        const reference::Picture moved[] = {
            exact(one, 1e-6, {1, 0, 0}),  exact(one, 1e-6, {0, 1, 0}),
            exact(one, -1e-6, {1, 0, 0}), exact(one, -1e-6, {0, 1, 0}),
            exact(one, 1e-6, {0, 0, 1}),  exact(one, -1e-6, {0, 0, 1})};
        int here = 0;
        for (int y = 1; y + 1 < kSide; ++y)
            for (int x = 1; x + 1 < kSide; ++x) {
                const std::size_t at = expected.at(x, y);
                if (expected.id[at] == 0 || expected.edge[at] != reference::kInterior) continue;
                // Where the light changes by a level a pixel at most, a rounding is no excuse.
                const glm::dvec3 color = expected.color[at];
                double change = 0.0;
                for (int dy = -1; dy <= 1; ++dy)
                    for (int dx = -1; dx <= 1; ++dx)
                        for (int c = 0; c < 3; ++c)
                            change = std::max(
                                change, std::abs(expected.color[expected.at(x + dx, y + dy)][c] -
                                                 color[c]));
                for (const reference::Picture& other : moved)
                    for (int c = 0; c < 3; ++c)
                        change = std::max(change, std::abs(other.color[at][c] - color[c]));
                if (change > 1.0 / 255.0) continue;
                ++compared;
                for (int c = 0; c < 3; ++c)
                    if (std::abs(pixel(image, x, y)[c] - 255.0 * color[c]) > 2.0) {
                        ++here;
                        break;
                    }
            }
        off += here;
        if (here > 0 && ++bad <= 5) UNSCOPED_INFO(here << " px off: " << one.xml);
    }
    CHECK((bad == 0 && off == 0));
    CHECK(compared > sweep.cases());
}
