#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "render/plan/bounds_tree.h"
#include "render/plan/camera.h"
#include "render/plan/frustum.h"
#include "render/plan/light_reach.h"
#include "render/plan/sampling.h"
#include "render/renderer.h"
#include "tests/support/paths.h"
#include "tests/support/plan_scene.h"

// Skipped parts of an image must not show: boxes against brute force, pictures against pictures
// from which nothing is left out.
using namespace farol;
using render::Box;
using render::Frustum;
namespace fs = std::filesystem;

namespace {

std::mt19937 random_(11);  // a fixed seed: the same boxes on every run

double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
}

glm::dvec3 placeWithin(double reach) {
    return {between(-reach, reach), between(-reach, reach), between(-reach, reach)};
}

Box boxAt(const glm::dvec3& center, double size) {
    Box box;
    box.add(center - glm::dvec3(between(0, size), between(0, size), between(0, size)));
    box.add(center + glm::dvec3(between(0, size), between(0, size), between(0, size)));
    return box;
}

scene::Camera cameraAt(const glm::dvec3& eye, const glm::dvec3& target) {
    scene::Camera camera;
    camera.eye = eye;
    camera.target = target;
    camera.near = 0.5;
    camera.far = 80.0;
    return camera;
}

bool inView(const glm::dvec3& point, const render::ViewTransform& view) {
    const glm::dvec4 p = view.clip * glm::dvec4(view.eyeFromWorld(point), 1.0);
    return std::abs(p.x) <= p.w && std::abs(p.y) <= p.w && p.z >= 0.0 && p.z <= p.w;
}

render::Job jobOf(const std::string& xml) {
    render::Job job;
    job.xml = xml;
    return job;
}

/// Both ways of drawing; returns the statistics of the one that skips.
render::Stats sameWithout(render::Renderer& renderer, render::Job job) {
    image::Image image, whole;
    const render::Stats stats = renderer.draw(job, image).stats;
    job.drawUnseen = true;
    const render::Stats all = renderer.draw(job, whole).stats;
    CHECK(image.pixels == whole.pixels);
    CHECK(all.betweenSamples == 0);
    CHECK(all.drawCalls >= stats.drawCalls);
    return stats;
}

std::string worldOf(const std::string& content) {
    return "<world><window width=\"120\" height=\"90\"/><camera><position x=\"0\" y=\"0\" "
           "z=\"10\"/><lookAt x=\"0\" y=\"0\" z=\"0\"/></camera>" +
           content + "</world>";
}

std::string sphereAt(const glm::dvec3& place, double size) {
    const auto triple = [](const glm::dvec3& v) {
        return "x=\"" + std::to_string(v.x) + "\" y=\"" + std::to_string(v.y) + "\" z=\"" +
               std::to_string(v.z) + "\"";
    };
    return "<group><transform><translate " + triple(place) + "/><scale " +
           triple(glm::dvec3(size)) + "/></transform><models><model " +
           "file=\"sphere_1_6_6.3d\"/></models></group>";
}

}  // namespace

TEST_CASE("a box with a point in view is never outside, one found inside has no point out") {
    int inside = 0, outside = 0, straddling = 0;
    for (int i = 0; i < 4000; ++i) {
        const scene::Camera camera = cameraAt(placeWithin(30.0), placeWithin(30.0));
        const glm::ivec2 size(static_cast<int>(between(1, 900)), static_cast<int>(between(1, 900)));
        const render::ViewTransform view = render::viewOf(camera, size);
        const Frustum frustum(view, 0.25);
        const Box box = boxAt(placeWithin(40.0), i % 3 == 0 ? 30.0 : 3.0);
        unsigned planes = Frustum::kAllPlanes;
        const Frustum::Side side = frustum.test(box, planes);
        inside += side == Frustum::Side::inside;
        outside += side == Frustum::Side::outside;
        straddling += side == Frustum::Side::straddles;
        for (int k = 0; k < 60; ++k) {
            const glm::dvec3 point =
                glm::mix(box.min, box.max, glm::dvec3(between(0, 1), between(0, 1), between(0, 1)));
            const bool seen = inView(point, view);
            if (side == Frustum::Side::outside) REQUIRE_FALSE(seen);
            // Inside is tested against the view widened by two pixels: nothing needs drawing less.
        }
    }
    CHECK(inside > 50);
    CHECK(outside > 500);
    CHECK(straddling > 500);
}

TEST_CASE("the tree finds the same boxes as a look at each of them") {
    for (const int count : {0, 1, 2, 9, 100, 3000}) {
        std::vector<Box> boxes;
        for (int i = 0; i < count; ++i)
            boxes.push_back(i % 17 == 5 ? Box{} : boxAt(placeWithin(100.0), 4.0));
        const render::BoundsTree tree(boxes);
        for (int view = 0; view < 20; ++view) {
            const scene::Camera camera = cameraAt(placeWithin(100.0), placeWithin(100.0));
            const Frustum frustum(render::viewOf(camera, {64, 48}), 0.25);
            const render::BoundsTree::Found found = tree.find(frustum);
            REQUIRE(found.sides.size() == boxes.size());
            for (std::size_t i = 0; i < boxes.size(); ++i) {
                unsigned planes = Frustum::kAllPlanes;
                const bool out =
                    boxes[i].empty() || frustum.test(boxes[i], planes) == Frustum::Side::outside;
                REQUIRE((found.sides[i] == Frustum::Side::outside) == out);
            }
        }
    }
}

TEST_CASE("a group beside the view costs one test, however many models it holds") {
    std::vector<Box> boxes;
    for (int i = 0; i < 10'000; ++i) boxes.push_back(boxAt(glm::dvec3(500, 0, 0), 5.0));
    const render::BoundsTree tree(boxes);
    const scene::Camera camera = cameraAt(glm::dvec3(0, 0, 10), glm::dvec3(0));
    const Frustum frustum(render::viewOf(camera, {64, 64}), 0.25);
    CHECK(tree.find(frustum).tests == 1);
    CHECK(tree.find(frustum).groupsSkipped == 1);
    const scene::Camera towards = cameraAt(glm::dvec3(400, 0, 40), glm::dvec3(500, 0, 0));
    scene::Camera wide = towards;
    wide.far = 1000.0;
    const Frustum within(render::viewOf(wide, {64, 64}), 0.25);
    CHECK(tree.find(within).tests == 1);
}

TEST_CASE("a rectangle misses the samples only where none lies in it") {
    const render::GlFacts gl = support::fourSamples();
    for (const int samples : {1, 2, 4, 8, 16}) {
        const render::SamplePattern pattern =
            render::samplePattern(render::chooseSampling(samples, gl, 512), gl);
        CHECK(static_cast<int>(pattern.size()) >= samples);
        for (int i = 0; i < 2000; ++i) {
            render::PixelRect rect;
            rect.min = {between(0, 30), between(0, 30)};
            rect.max = rect.min + glm::dvec2(between(0, 1.2), between(0, 1.2));
            bool hit = false;
            for (int y = -1; y < 33; ++y)
                for (int x = -1; x < 33; ++x)
                    for (const glm::dvec2& at : pattern) {
                        const glm::dvec2 p = glm::dvec2(x, y) + at;
                        hit |= p.x >= rect.min.x && p.x <= rect.max.x && p.y >= rect.min.y &&
                               p.y <= rect.max.y;
                    }
            if (hit) REQUIRE_FALSE(render::missesSamples(rect, pattern, gl.snapPx));
        }
    }
    CHECK(
        render::missesSamples({{0.6, 0.6}, {0.9, 0.9}}, render::samplePattern({}, gl), gl.snapPx));
}

TEST_CASE("dust between the samples is left out and does not show") {
    std::string content = "<lights><light type=\"directional\" dirx=\"1\" diry=\"1\"/></lights>";
    for (int i = 0; i < 600; ++i) content += sphereAt(placeWithin(4.0), between(0.004, 0.05));
    render::Renderer renderer;
    for (const int samples : {1, 4, 8, 16}) {
        render::Job job = jobOf(worldOf(content));
        job.options.samples = samples;
        CAPTURE(samples);
        const render::Stats stats = sameWithout(renderer, job);
        if (samples <= 4) CHECK(stats.betweenSamples > 20);
    }
}

TEST_CASE("lights whose cone a model is outside of are left out of it, and do not show") {
    render::EyeLight spot{};
    spot.position = glm::vec4(0, 0, 0, 1);
    spot.spot = glm::vec4(0, 0, -1, std::cos(glm::radians(20.0F)));
    spot.diffuse = glm::vec4(1.0F);
    CHECK_FALSE(render::addsNothing(spot, glm::dvec3(0, 0, -5), 1.0));
    CHECK_FALSE(
        render::addsNothing(spot, glm::dvec3(2.7, 0, -5), 1.0));  // edge of the cone at 1.82
    CHECK(render::addsNothing(spot, glm::dvec3(3.2, 0, -5), 1.0));
    CHECK(render::addsNothing(spot, glm::dvec3(0, 0, 5), 1.0));
    CHECK_FALSE(render::addsNothing(spot, glm::dvec3(0, 0, 5), 6.0));  // the light is within it
    spot.diffuse = glm::vec4(0.0F);
    CHECK(render::addsNothing(spot, glm::dvec3(0, 0, -5), 1.0));

    std::string content = "<lights>";
    for (const char* x : {"-3", "0", "3"})
        content += std::string("<light type=\"spotlight\" posx=\"") + x +
                   "\" posy=\"3\" posz=\"0\" dirx=\"0\" diry=\"-1\" dirz=\"0\" cutoff=\"25\"/>";
    content += "</lights>";
    for (int i = -4; i <= 4; ++i) content += sphereAt(glm::dvec3(i, 0, 0), 0.45);
    render::Renderer renderer;
    CHECK(sameWithout(renderer, jobOf(worldOf(content))).lightsSkipped >= 9);
}

TEST_CASE("every example scene gives the same picture with nothing left out") {
    render::Renderer renderer;
    int culled = 0, scenes = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(farol::test::kSourceDir) / "scenes")) {
        const fs::path file = entry.path() / "scene.xml";
        if (!fs::exists(file)) continue;
        ++scenes;
        std::ifstream in(file, std::ios::binary);
        render::Job job = jobOf({std::istreambuf_iterator<char>(in), {}});
        job.assets = std::make_shared<scene::FolderAssets>(entry.path().string());
        job.identity = entry.path().string();
        job.options.width = 160;
        job.options.height = 120;
        for (const double fov : {60.0, 20.0}) {
            CAPTURE(entry.path().filename().string(), fov);
            job.options.fovDeg = fov;
            culled += sameWithout(renderer, job).culled;
        }
    }
    CHECK(scenes > 10);
    CHECK(culled > 100);  // the test has something to say
}
