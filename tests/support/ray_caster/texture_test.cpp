#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/ray_caster/scenes.h"
#include "tests/support/ray_caster/tracer.h"

using namespace farol;
using namespace farol::reference;
using namespace farol::reference::testing;

namespace {

/// Red grows to the right, green upwards; the top row comes first.
Pixels ramp(int size) {
    Pixels pixels{size, size, {}};
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            for (const int value : {x, size - 1 - y, 0})
                pixels.rgb.push_back(static_cast<std::uint8_t>(value * 255 / (size - 1)));
    return pixels;
}

const glm::dvec2 kNone(0.0);

}  // namespace

TEST_CASE("lookups in a ramp: origin at the bottom left, texel centres, linear between") {
    const Texture texture(ramp(16));
    const auto at = [&](double u, double v) {
        return texture.sample({u, v}, kNone, kNone, scene::Filter::linear) * 15.0;
    };
    CHECK(at(0.5 / 16, 0.5 / 16).x == Approx(0.0).margin(1e-12));
    CHECK(at(15.5 / 16, 3.5 / 16).x == Approx(15.0));
    CHECK(at(15.5 / 16, 3.5 / 16).y == Approx(3.0));
    CHECK(at(6.75 / 16, 0.5).x == Approx(6.25));
    CHECK(at(6.75 / 16 - 3.0, 0.5 + 2.0).x == Approx(6.25));  // repeated
    CHECK(at(0.0, 0.5).x == Approx(7.5));                     // half way between last and first
    CHECK(texture.sample({6.99 / 16, 0.5}, kNone, kNone, scene::Filter::nearest).x ==
          Approx(6.0 / 15.0));
    CHECK_THROWS(texture.sample({0, 0}, kNone, kNone, scene::Filter::anisotropic));
    CHECK_THROWS(Texture(Pixels{2, 2, {0, 0, 0}}));
}

TEST_CASE("mipmap levels are area-weighted means") {
    const Pixels row{5, 1, {0, 0, 0, 255, 0, 0, 0, 0, 0, 255, 0, 0, 255, 0, 0}};
    const Texture texture(row);
    REQUIRE(texture.levels() == 3);
    CHECK(texture.texel(1, 0, 0).x * 255.0 == Approx(102.0));
    CHECK(texture.texel(1, 1, 0).x * 255.0 == Approx(204.0));
    CHECK(texture.texel(2, 0, 0).x * 255.0 == Approx(153.0));
    CHECK(texture.size(1) == glm::ivec2(2, 1));
}

TEST_CASE("the level of detail is log2 of the footprint, and levels are blended by it") {
    Pixels checker{8, 8, {}};
    for (int i = 0; i < 64; ++i)
        for (int c = 0; c < 3; ++c)
            checker.rgb.push_back(static_cast<std::uint8_t>((i + i / 8) % 2 ? 255 : 0));
    const Texture texture(checker);
    const glm::dvec2 wide(0.25, 0.0), high(0.0, 0.125);
    CHECK(texture.levelOfDetail(wide, high) == Approx(1.0));
    CHECK(texture.levelOfDetail({0.03, 0.04}, kNone) == Approx(std::log2(0.4)));
    // At a texel's centre: level 0 has its value, level 1 the mean.
    const glm::dvec2 center(1.5 / 8, 0.5 / 8);
    const double base = texture.sample(center, kNone, kNone, scene::Filter::mipmap).x;
    CHECK(std::abs(base - 0.5) == Approx(0.5));
    const glm::dvec2 step(std::exp2(0.25) / 8, 0.0);
    CHECK(texture.sample(center, step, kNone, scene::Filter::mipmap).x ==
          Approx(0.75 * base + 0.125));
    CHECK(texture.sample(center, wide, kNone, scene::Filter::mipmap).x == Approx(0.5));
    CHECK(texture.sample(center, {40.0, 0.0}, kNone, scene::Filter::mipmap).x == Approx(0.5));
}

TEST_CASE("a textured face shows the ramp at the pixels of its projection") {
    scene::Scene scene = emptyScene(2.0);  // the face at depth 1 fills the picture
    scene::Group& group = add(scene, "box 2", white());
    group.models[0].material.reset();
    scene::Texture texture;
    texture.file = "ramp";
    group.models[0].texture = texture;
    Options options;
    options.width = options.height = 64;
    Files files;
    files.pictures["ramp"] = ramp(64);
    const World world = makeWorld(scene, files, options);
    for (const int x : {0, 10, 40, 63})
        for (const int y : {0, 20, 63}) {
            const glm::dvec3 color = trace(world, x + 0.5, y + 0.5).color;
            CHECK(color.x == Approx(std::floor(x * 255.0 / 63.0) / 255.0).margin(1e-9));
            CHECK(color.y == Approx(std::floor((63 - y) * 255.0 / 63.0) / 255.0).margin(1e-9));
        }
    CHECK_THROWS(makeWorld(scene, {}, options));
}

TEST_CASE("the footprint of a slanted plane is the change of uv between neighbours") {
    // Seen through mipmaps of one colour each, the level itself becomes visible: compare with
    // finite differences of a linear ramp's colours.
    scene::Scene scene = emptyScene(0.0);
    scene.camera->eye = {0, 1, 0};
    scene.camera->target = {0, 0.2, -1};
    scene::Group& group = add(scene, "plane 40", white());
    group.models[0].material.reset();
    scene::Texture texture;
    texture.file = "it";
    group.models[0].texture = texture;
    Files files;
    Pixels stripes{256, 256, {}};
    for (int i = 0; i < 256 * 256; ++i)
        for (int c = 0; c < 3; ++c)
            stripes.rgb.push_back(static_cast<std::uint8_t>((i % 256) < 128 ? 255 : 0));
    files.pictures["it"] = stripes;
    Options options;
    options.width = options.height = 64;
    const World world = makeWorld(scene, files, options);
    const Texture reference(stripes);
    const auto uvAt = [&](double x, double y) {
        const Instance& one = world.instances[0];
        const Ray ray{-(one.objectFromView * one.originView),
                      one.objectFromView * world.direction(x, y)};
        Nearest nearest(world.near, world.far, false);
        one.shape->intersect(ray, nearest);
        return one.shape->surface(ray, nearest.best()).uv;
    };
    for (const double x : {20.5, 33.5})
        for (const double y : {30.5, 60.5}) {
            constexpr double kStep = 1e-5;
            const glm::dvec2 uv = uvAt(x, y);
            const glm::dvec2 dx = (uvAt(x + kStep, y) - uvAt(x - kStep, y)) / (2 * kStep);
            const glm::dvec2 dy = (uvAt(x, y + kStep) - uvAt(x, y - kStep)) / (2 * kStep);
            CHECK(trace(world, x, y).color.x ==
                  Approx(reference.sample(uv, dx, dy, scene::Filter::mipmap).x).epsilon(1e-6));
        }
}

TEST_CASE("generated coordinates follow their planes") {
    scene::Scene scene = emptyScene(2.0);
    scene::Group& group = add(scene, "box 2", white());
    group.models[0].material.reset();
    scene::Texture texture;
    texture.file = "ramp";
    texture.mapping = scene::Mapping::texgenObject;
    texture.planeS = {0.25, 0, 0, 0.5};
    texture.planeT = {0, 0.25, 0, 0.5};
    texture.filter = scene::Filter::linear;
    group.models[0].texture = texture;
    Options options;
    options.width = options.height = 64;
    Files files;
    files.pictures["ramp"] = ramp(64);
    const Texture reference(files.pictures["ramp"]);
    const auto expect = [&](const glm::dvec2& uv) {
        return reference.sample(uv, kNone, kNone, scene::Filter::linear).x;
    };
    // x = 0.5 on the face at depth 1: pixel 48.
    CHECK(trace(makeWorld(scene, files, options), 48.0, 32.5).color.x ==
          Approx(expect({0.625, 0.5})).margin(1e-9));
    group.models[0].texture->mapping = scene::Mapping::texgenEye;
    group.models[0].texture->planeS = {0.25, 0, 0.1, 0.5};  // eye z = -1 there
    CHECK(trace(makeWorld(scene, files, options), 48.0, 32.5).color.x ==
          Approx(expect({0.525, 0.5})).margin(1e-9));
}
