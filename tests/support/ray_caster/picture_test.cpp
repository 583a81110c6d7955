#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/support/ray_caster/scenes.h"
#include "tests/support/ray_caster/tracer.h"

using namespace farol;
using namespace farol::reference;
using namespace farol::reference::testing;

namespace {

World worldOf(const scene::Scene& scene, int width, int height) {
    Options options;
    options.width = width;
    options.height = height;
    return makeWorld(scene, {}, options);
}

/// White on black: the sum over the picture is the covered area, px^2.
double area(const Picture& picture) {
    double sum = 0.0;
    for (const glm::dvec3& c : picture.color) sum += c.x;
    return sum;
}

scene::Group& place(scene::Group& group, const glm::dvec3& offset) {
    group.transforms.push_back(scene::Translate{offset});
    return group;
}

}  // namespace

TEST_CASE("a sphere covers the area of its perspective ellipse") {
    // The cone of half angle alpha about an axis at theta cuts the picture plane in an ellipse.
    for (const glm::dvec3 center :
         {glm::dvec3(0, 0, -5), glm::dvec3(2, 1, -5), glm::dvec3(-3, 2.5, -6)}) {
        scene::Scene scene = emptyScene(0.0);
        scene.camera->target = {0, 0, -1};
        scene.lights.push_back(directional({0, 0, 1}));
        place(add(scene, "sphere 1", white()), center);
        const double d = glm::length(center), sine = 1.0 / d, cosine = std::sqrt(1 - sine * sine);
        const double cosTheta = -center.z / d, rest = cosTheta * cosTheta - sine * sine;
        const double exact = std::numbers::pi * sine * cosine / rest * sine / std::sqrt(rest);
        const int size = 128;
        const double unit = size / 2.0;  // px at depth 1
        const Picture picture = traceAreas(worldOf(scene, size, size), 16);
        INFO("side " << picture.side << " change " << picture.change * 255.0 << "/255");
        CHECK(area(picture) == Approx(exact * unit * unit).epsilon(1e-3));
        // Pixel centres alone converge too, with the picture's size.
        double before = 1e9;
        for (const int side : {64, 256, 1024}) {
            const Picture centers = traceCenters(worldOf(scene, side, side));
            const double error = std::abs(area(centers) / (0.25 * side * side) / exact - 1.0);
            CHECK(error < 10.0 / side);  // half a pixel all round: its radius is side / 10
            before = std::min(before, error);
        }
        CHECK(before < 1e-3);
    }
}

TEST_CASE("a tilted disc covers the area of its perspective ellipse") {
    for (const double tilt : {0.0, 30.0, 70.0}) {
        scene::Scene scene = emptyScene(0.0);
        scene.camera->target = {0, 0, -1};
        scene.lights.push_back(directional({0, 0, 1}));
        scene::Group& group = place(add(scene, "ring 0 1", white()), {0.5, 0.8, -4});
        group.transforms.push_back(scene::Rotate{90.0 - tilt, {1, 0, 0}});
        const glm::dvec3 center(0.5, 0.8, -4);
        const double angle = glm::radians(90.0 - tilt);
        const glm::dvec3 normal(0.0, std::cos(angle), std::sin(angle));
        const double across = 1.0 - normal.z * normal.z;
        const double exact = std::numbers::pi * std::abs(glm::dot(normal, center)) /
                             std::pow(center.z * center.z - across, 1.5);
        const Picture picture = traceAreas(worldOf(scene, 128, 128), 16);
        CHECK(area(picture) == Approx(exact * 64.0 * 64.0).epsilon(1e-3));
    }
}

TEST_CASE("the middle of a lit sphere has the colour of the formula") {
    scene::Scene scene = emptyScene(5.0);
    const glm::dvec3 towards = glm::normalize(glm::dvec3(1, 2, 2));
    scene.lights.push_back(directional(towards * 7.0));  // normalised by the rules
    scene.globalAmbient = glm::vec3(0.5F);
    scene::Material material;
    material.diffuse.rgb = {0.5F, 0.25F, 0.125F};
    material.ambient.rgb = {0.125F, 0.25F, 0.0F};
    material.specular.rgb = glm::vec3(0.25F);
    material.emissive.rgb = {0.0F, 0.0F, 0.0625F};
    material.shininess = 8.0F;
    add(scene, "sphere 1", material);
    const World world = worldOf(scene, 3, 3);
    // n = (0,0,1): n.L = 2/3; h = (L + z)/|L + z|, n.h = sqrt((1 + 2/3)/2)
    const double glint = 0.25 * std::pow((1.0 + 2.0 / 3.0) / 2.0, 4.0);
    const glm::dvec3 color = trace(world, 1.5, 1.5).color;
    CHECK(color.x == Approx(0.0625 + 1.0 / 3.0 + glint).epsilon(1e-12));
    CHECK(color.y == Approx(0.125 + 1.0 / 6.0 + glint).epsilon(1e-12));
    CHECK(color.z == Approx(0.0625 + 1.0 / 12.0 + glint).epsilon(1e-12));
}

TEST_CASE("the terms of the shading model, one by one") {
    Rules rules;
    rules.globalAmbient = glm::dvec3(0.0);
    Dress dress{glm::dvec3(0.5), glm::dvec3(0.25), glm::dvec3(0.0), glm::dvec3(0.0), 0.0};
    EyeLight light;
    light.positional = true;
    light.position = {0, 0, -3};
    const glm::dvec3 up(0, 0, 1), one(1.0), place(0, 0, -5);
    const auto value = [&] { return shade(rules, dress, {light}, place, up, one).x; };
    CHECK(value() == Approx(0.5));
    SECTION("attenuation over the distance 2") {
        light.attenuation = {1, 0.5, 0.25};
        CHECK(value() == Approx(0.5 / 3.0));
    }
    SECTION("a light's ambient part needs no facing, and is attenuated") {
        light.ambient = glm::dvec3(0.4);
        light.attenuation = {2, 0, 0};
        light.position = {0, 0, -7};
        CHECK(value() == Approx(0.25 * 0.4 / 2.0));
    }
    SECTION("the cone: cos^exponent inside, nothing outside") {
        light.cutoffDeg = 30.0;
        light.exponent = 3.0;
        light.shining = glm::normalize(glm::dvec3(1, 0, -2));  // 26.6 degrees off
        CHECK(value() == Approx(0.5 * std::pow(2.0 / std::sqrt(5.0), 3.0)));
        light.cutoffDeg = 26.0;
        CHECK(value() == 0.0);
        light.cutoffDeg = 180.0;
        CHECK(value() == Approx(0.5));
    }
    SECTION("a light at the point itself: ambient only") {
        light.position = place;
        light.ambient = glm::dvec3(0.4);
        CHECK(value() == Approx(0.1));
    }
    SECTION("shininess 0 is full specular, only where the light is in front") {
        dress.specular = glm::dvec3(0.125);
        CHECK(value() == Approx(0.625));
        light.position = {0, 0, -7};
        CHECK(value() == 0.0);
    }
    SECTION("local viewer: h leans towards the eye") {
        const glm::dvec3 aside(3, 0, -4);
        light.positional = false;
        light.towards = up;
        dress.diffuse = glm::dvec3(0.0);
        dress.specular = glm::dvec3(0.5);
        dress.shininess = 2.0;
        CHECK(shade(rules, dress, {light}, aside, up, one).x == Approx(0.5));
        rules.viewer = scene::Viewer::local;  // V = (-.6, 0, .8): n.h^2 = (1 + .8)/2
        CHECK(shade(rules, dress, {light}, aside, up, one).x == Approx(0.45));
    }
    SECTION("single specular is modulated by the texture, separate is not") {
        dress.diffuse = glm::dvec3(0.75);
        dress.specular = glm::dvec3(0.5);
        const glm::dvec3 grey(0.5);
        CHECK(shade(rules, dress, {light}, place, up, grey).x == Approx(0.5));
        rules.specular = scene::Specular::separate;
        CHECK(shade(rules, dress, {light}, place, up, grey).x == Approx(0.875));
    }
}

TEST_CASE("what is not between near and far does not count") {
    scene::Scene scene = emptyScene(5.0);
    scene.lights.push_back(directional({0, 0, 1}));
    add(scene, "box 2", white());
    const auto seen = [&] { return trace(worldOf(scene, 3, 3), 1.5, 1.5); };
    CHECK(seen().depth == Approx(4.0));
    scene.camera->near = 4.5;  // the front is cut away, the back looks away
    CHECK(seen().id == 0);
    scene.camera->near = 1.0;
    scene.camera->far = 3.9;
    CHECK(seen().id == 0);
}

TEST_CASE("transforms: order, non-uniform and mirrored scale, and their normals") {
    scene::Scene scene = emptyScene(20.0);
    scene.lights.push_back(directional({0, 0, 1}));
    scene::Material plain = white();
    scene::Group& group = add(scene, "sphere 1", plain);
    group.transforms = {scene::Translate{{1, 0, 0}}, scene::Scale{{-4, 2, 3}}};
    const World world = worldOf(scene, 401, 401);
    int hits = 0;
    for (int y = 0; y < 401; y += 4)
        for (int x = 0; x < 401; x += 4) {
            const Sample s = trace(world, x + 0.5, y + 0.5);
            if (s.id == 0) continue;
            ++hits;
            // World space: the camera looks along -Z from z = 20.
            const glm::dvec3 p = s.point + glm::dvec3(-1, 0, 20);
            const glm::dvec3 q = p / glm::dvec3(4, 2, 3);
            CHECK(glm::length(q) == Approx(1.0).epsilon(1e-12));
            CHECK(glm::length(s.normal - glm::normalize(q / glm::dvec3(4, 2, 3))) < 1e-12);
        }
    CHECK(hits > 50);
    // Scaled first and moved then is another place than moved and then scaled.
    group.transforms = {scene::Scale{{-4, 2, 3}}, scene::Translate{{1, 0, 0}}};
    CHECK(trace(worldOf(scene, 401, 401), 200.5 + 41.0, 200.5).id == 0);
}

TEST_CASE("nearer objects hide farther ones, ids follow the document") {
    scene::Scene scene = emptyScene(5.0);
    scene.lights.push_back(directional({0, 0, 1}));
    place(add(scene, "sphere 1", white()), {0, 0, -3});
    scene::Group& front = add(scene, "sphere 0.5", white());
    scene.groups[0].groups.push_back(front);  // second: a group's models go before its groups
    const World world = worldOf(scene, 101, 101);
    REQUIRE(world.instances.size() == 3);
    CHECK(trace(world, 50.5, 50.5).id == 3);
    scene.groups.pop_back();
    CHECK(trace(worldOf(scene, 101, 101), 50.5, 50.5).id == 1);
}

TEST_CASE("a supersampled edge is the covered share of its pixel") {
    // A box face at depth 1 whose right edge lies at a chosen share of a pixel.
    for (const double share : {0.25, 0.4, 0.9}) {
        const int size = 8;
        const double edge = (6.0 - 4.0 + share) / 4.0;  // pixel 6, in units at depth 1
        scene::Scene scene = emptyScene(0.0);
        scene.camera->target = {0, 0, -1};
        scene.lights.push_back(directional({0, 0, 1}));
        scene::Group& group = add(scene, "box 2", white());
        group.transforms = {scene::Translate{{edge - 4.0, 0, -2}}, scene::Scale{{4, 4, 1}}};
        const Picture picture = traceAreas(worldOf(scene, size, size), 32);
        CHECK(picture.color[picture.at(5, 4)].x == 1.0);
        CHECK(std::abs(picture.color[picture.at(6, 4)].x - share) <= 0.5 / picture.side + 1e-12);
        CHECK(picture.color[picture.at(7, 4)].x == 0.0);
        CHECK(picture.edge[picture.at(6, 4)] == kSilhouette);
        CHECK(picture.edge[picture.at(4, 4)] == kInterior);
    }
}

TEST_CASE("edges are flagged one pixel to either side, creases apart") {
    scene::Scene scene = emptyScene(5.0);
    scene.lights.push_back(directional({0, 0, 1}));
    scene::Group& group = add(scene, "box 2", white());
    group.transforms = {scene::Rotate{45.0, {0, 1, 0}}};
    const Picture picture = traceCenters(worldOf(scene, 100, 100));
    // The crease between the two seen faces stands at x = 50.
    CHECK(picture.edge[picture.at(49, 50)] == kCrease);
    CHECK(picture.edge[picture.at(50, 50)] == kCrease);
    CHECK(picture.edge[picture.at(48, 50)] == kInterior);
    CHECK(picture.edge[picture.at(51, 50)] == kInterior);
    for (int x = 0; x + 1 < 100; ++x)
        if (picture.id[picture.at(x, 50)] != picture.id[picture.at(x + 1, 50)])
            CHECK((picture.edge[picture.at(x, 50)] & kSilhouette) != 0);
}

TEST_CASE("what the reference does not cover is refused") {
    scene::Scene scene = emptyScene(5.0);
    add(scene, "sphere 1", white());
    CHECK_NOTHROW(worldOf(scene, 3, 3));
    scene.groups[0].transforms = {scene::Scale{{1, 0, 1}}};
    CHECK_THROWS(worldOf(scene, 3, 3));
    scene.groups[0].transforms.clear();
    scene.groups[0].models[0].material.reset();  // neither lights nor colours: a wireframe
    CHECK_THROWS(worldOf(scene, 3, 3));
    scene.camera.reset();
    CHECK_THROWS(worldOf(scene, 3, 3));
}
