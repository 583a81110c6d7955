#include <catch2/catch.hpp>

#include "scene/read/reader.h"
#include "tests/numerics/sweep.h"
#include "tests/support/ray_caster/tracer.h"

// Faces of different models in one plane: the first of the document shows, for any transforms.
using namespace farol;
using namespace farol::numerics;

namespace {

constexpr int kSide = 96;
/// Nine ranks, each of which moves a border by 1/128 px, and the rasteriser's grid of 1/256 px.
constexpr double kMoved = 9.0 / 128.0 + 1.0 / 256.0;

std::string turned(double angleDeg, const glm::dvec3& axis) {
    return "<rotate angle=\"" + text(angleDeg) + "\" " + xyz(axis) + "/>";
}

/// A shape with a face at y = 0 that looks along +Y, and how it comes to lie there.
std::string shape(Sweep& sweep, double size) {
    const auto model = [](const std::string& transforms, const std::string& command) {
        return "<transform>" + transforms + "</transform><models><model command=\"" + command +
               "\"><color><diffuse R=\"200\" G=\"100\" B=\"60\"/></color></model></models>";
    };
    const double height = size * sweep.between(0.1, 0.5);
    const auto lowered = [&](double by) { return "<translate " + xyz({0.0, -by, 0.0}) + "/>"; };
    const std::string upsideDown = turned(180.0, {1.0, 0.0, 0.0});
    switch (static_cast<int>(sweep.between(0.0, 8.0))) {
        case 0:
        case 1:
            return model("", "plane " + text(size));
        case 2:
            return model(
                "", "plane " + text(size) + " " + text(1.0 + std::floor(sweep.between(0.0, 8.0))));
        case 3:
        case 4:
            return model(lowered(height / 2.0), "box " + text(size) + " " + text(height) + " " +
                                                    text(size * sweep.between(0.3, 2.0)));
        case 5:
            return model(lowered(height), "cylinder " + text(size / 2.0) + " " + text(height));
        case 6:
            return model(upsideDown, "cone " + text(size / 2.0) + " " + text(height));
        default:
            return model("<scale x=\"1\" y=\"1\" z=\"" + text(sweep.between(0.3, 2.0)) + "\"/>",
                         "ring " + text(size / 4.0) + " " + text(size / 2.0));
    }
}

struct Look {
    std::vector<std::string> models;  ///< a document each
    std::string xml;                  ///< of all
};

/// So many shapes in one plane, somewhere in it, anywhere in space.
Look stack(Sweep& sweep, int count) {
    const double size = sweep.power(1e-3, 1e3);
    const glm::dvec3 far =
        std::floor(sweep.power(1.0, 1e5)) * 64.0 * size *
        glm::round(glm::dvec3(sweep.between(-8, 8), sweep.between(-8, 8), sweep.between(-8, 8)));
    Camera camera;
    glm::dvec3 away(sweep.between(-1, 1), sweep.between(0.15, 1), sweep.between(-1, 1));
    camera.eye = far + glm::normalize(away) * size * 4.0;
    camera.target = far;
    camera.near = size * 0.01;
    camera.far = size * 100.0;
    camera.fovDeg = 50.0;
    const std::string head = "<world>" + camera.xml() +
                             R"(<lights><light type="directional" dirX="1" dirY="2" dirZ="3"/>
                                </lights><group><transform><translate )" +
                             xyz(far) + "/>" + turned(sweep.between(-25.0, 25.0), {1.0, 0.0, 0.3}) +
                             "<translate " + xyz({0.0, size * sweep.between(-0.5, 0.5), 0.0}) +
                             "/></transform>";
    Look look;
    look.xml = head;
    for (int i = 0; i < count; ++i) {
        std::string scale;
        if (sweep.chance(0.3))
            scale = "<scale " +
                    xyz({sweep.between(0.5, 2.0), sweep.between(0.5, 2.0),
                         sweep.between(0.5, 2.0) * (sweep.chance(0.3) ? -1.0 : 1.0)}) +
                    "/>";
        const double x = sweep.between(-1, 1) * size;
        const std::string group =
            "<group><transform><translate " + xyz({x, 0.0, sweep.between(-1, 1) * size}) + "/>" +
            turned(sweep.between(0.0, 360.0), {0.0, 1.0, 0.0}) + scale + "</transform><group>" +
            shape(sweep, size * sweep.power(0.2, 2.0)) + "</group></group>";
        look.models.push_back(head + group + "</group></world>");
        look.xml += group;
    }
    look.xml += "</group></world>";
    return look;
}

/// Pixels that do not show the first of the models that are nearest there. Within 0.3 px of where
/// another one begins either may show; so may a later one within kMoved of where its face in the
/// plane ends.
int wrong(const Look& look) {
    render::PictureOptions options;
    options.layer = render::Layer::id;
    const image::Image image = draw(look.xml, kSide, options);
    reference::Options size;
    size.width = size.height = kSide;
    std::vector<reference::World> worlds;
    for (const std::string& xml : look.models)
        worlds.push_back(
            reference::makeWorld(scene::read(xml, {}, scene::BundleAssets()).scene, {}, size));
    // Doubles far away hold a place to 1e-10 of its distance.
    constexpr double kSame = 1.0 - 1e-6;
    struct First {
        int id = 0;
        double depth = 1e300;
    };
    const auto first = [&](double x, double y) {
        First nearest;
        for (std::size_t i = 0; i < worlds.size(); ++i) {
            const reference::Sample sample = reference::trace(worlds[i], x, y);
            if (sample.id != 0 && sample.depth <= nearest.depth * kSame)
                nearest = {static_cast<int>(i) + 1, sample.depth};
        }
        return nearest;
    };
    const auto isInPlane = [&](int id, double x, double y) {
        if (id == 0) return true;
        const reference::Sample sample =
            reference::trace(worlds[static_cast<std::size_t>(id) - 1], x, y);
        return sample.id != 0 && sample.depth * kSame <= first(x, y).depth;
    };
    int count = 0;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const glm::ivec3 color = pixel(image, x, y);
            const int drawn = color.r * 65536 + color.g * 256 + color.b;
            const int expected = first(x + 0.5, y + 0.5).id;
            if (drawn == expected) continue;
            bool isEdge = false;
            for (const int dx : {-1, 0, 1})
                for (const int dy : {-1, 0, 1})
                    isEdge = isEdge ||
                             first(x + 0.5 + 0.3 * dx, y + 0.5 + 0.3 * dy).id != expected ||
                             !isInPlane(drawn, x + 0.5 + kMoved * dx, y + 0.5 + kMoved * dy);
            count += isEdge ? 0 : 1;
        }
    return count;
}

void check(Sweep& sweep, int models) {
    int bad = 0;
    for (int i = 0; i < sweep.cases(); ++i) {
        const Look look = stack(sweep, models);
        const int off = wrong(look);
        if (off > 0 && ++bad <= 5) UNSCOPED_INFO(off << " px show a later one: " << look.xml);
    }
    CHECK(bad == 0);
}

}  // namespace

TEST_CASE("of pairs of faces in one plane the first shows, under any transforms") {
    Sweep sweep("coplanar pairs", 60);
    check(sweep, 2);
}

TEST_CASE("of ten faces in one plane the first shows, under any transforms") {
    Sweep sweep("coplanar stacks", 10);
    check(sweep, 10);
}
