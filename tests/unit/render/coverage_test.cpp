// Where a frame draws: never less than that, and not much more.
#include "render/plan/coverage.h"

#include <catch2/catch.hpp>
#include <random>

#include "render/plan/frustum.h"
#include "render/plan/passes.h"
#include "render/renderer.h"
#include "tests/support/plan_scene.h"

using namespace farol;
using render::Box;
using render::FramePlan;

namespace {

// Without a light models are outlines.
const std::string kLights =
    "<lights><light type=\"directional\" dirx=\"1\" diry=\"2\" dirz=\"3\"/></lights>";

std::mt19937 random_(23);  // a fixed seed

double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
}

glm::dvec3 placeWithin(double reach) {
    return {between(-reach, reach), between(-reach, reach), between(-reach, reach)};
}

/// A world of spheres; the first is as large as a house, round the eye's side.
std::string worldOf(int spheres, const std::string& background) {
    std::string groups;
    for (int i = 0; i < spheres; ++i) {
        const glm::dvec3 at = placeWithin(6.0);
        groups += "<group><transform><translate x=\"" + std::to_string(at.x) + "\" y=\"" +
                  std::to_string(at.y) + "\" z=\"" + std::to_string(at.z) +
                  "\"/></transform><models><model file=\"sphere_0.4_9_9.3d\"/></models></group>";
    }
    return "<world" + background +
           "><camera><position x=\"3\" y=\"2\" z=\"9\"/><lookAt x=\"0\" y=\"0\" z=\"0\"/>"
           "<projection fov=\"60\" near=\"1\" far=\"100\"/></camera>" +
           kLights +
           "<group><models>"
           "<model file=\"plane_9_3.3d\"/></models></group>" +
           groups + "</world>";
}

}  // namespace

TEST_CASE("the visible rectangle holds every point of a box that is behind the near plane") {
    int crossing = 0, hidden = 0;
    for (int i = 0; i < 3000; ++i) {
        scene::Camera camera;
        camera.eye = placeWithin(8.0);
        camera.target = placeWithin(8.0);
        camera.near = between(0.1, 3.0);
        camera.far = 100.0;
        const render::ViewTransform view = render::viewOf(camera, {320, 200});
        Box box;
        box.add(placeWithin(8.0));
        box.add(placeWithin(8.0));
        glm::dmat4 viewFromObject(view.rotation);
        viewFromObject[3] = glm::dvec4(view.eyeFromWorld(glm::dvec3(0.0)), 1.0);
        const auto rect = render::visibleRect(box, viewFromObject, view);
        hidden += rect ? 0 : 1;
        crossing += rect && !render::pixelRect(box, viewFromObject, view) ? 1 : 0;
        for (int k = 0; k < 50; ++k) {
            const glm::dvec3 at =
                glm::mix(box.min, box.max, glm::dvec3(between(0, 1), between(0, 1), between(0, 1)));
            const glm::dvec4 p = view.clip * viewFromObject * glm::dvec4(at, 1.0);
            if (p.z > p.w) continue;
            REQUIRE(rect);
            const glm::dvec2 px = (glm::dvec2(p) / p.w + 1.0) * 0.5 * glm::dvec2(view.size);
            const double slack = 1e-9 * (1.0 + glm::length(px));
            REQUIRE(px.x >= rect->min.x - slack);
            REQUIRE(px.y >= rect->min.y - slack);
            REQUIRE(px.x <= rect->max.x + slack);
            REQUIRE(px.y <= rect->max.y + slack);
        }
    }
    CHECK(crossing > 300);
    CHECK(hidden > 100);
}

TEST_CASE("a frame of four samples knows where it draws, one with lines or a backdrop does not") {
    FramePlan plan;
    plan.view = render::viewOf(plan.camera, {640, 480});
    plan.lightSets = {{}};
    auto mesh = std::make_shared<render::MeshData>();
    mesh->bounds.add(glm::dvec3(-0.1));
    mesh->bounds.add(glm::dvec3(0.1));
    render::DrawItem item;
    item.mesh = mesh;
    item.viewFromObject[3] = glm::vec4(0.0F, 0.0F, -5.0F, 1.0F);
    plan.items.push_back(item);
    plan.style.samples = 4;
    const auto compose = [&] { render::composePasses(plan, support::fourSamples()); };
    compose();
    REQUIRE_FALSE(plan.covered.empty());
    int area = 0;
    for (const glm::ivec4& part : plan.covered) area += part.z * part.w;
    CHECK(area <= 192 * 192);
    CHECK(area >= 64 * 64);
    FramePlan other = plan;
    other.lines.resize(2);
    CHECK(render::coveredRects(other).empty());
    other = plan;
    other.passes[0].target.clearColor.reset();
    CHECK(render::coveredRects(other).empty());
    other = plan;
    other.passes[0].state.polygons = render::Polygons::outlined;
    CHECK(render::coveredRects(other).empty());
    other = plan;
    other.items[0].viewFromObject[3].z = -0.15F;  // all over the view
    CHECK(render::coveredRects(other).empty());
    plan.style.crops = false;
    compose();
    CHECK(plan.covered.empty());
    plan.style.crops = true;
    plan.style.samples = 1;
    compose();
    CHECK(plan.covered.empty());
}

TEST_CASE("samples that are resolved only where models are give the same image") {
    render::Renderer renderer;
    for (const char* background : {"", " background=\"#807f33\"", " background=\"transparent\""})
        for (const auto& size : {glm::ivec2(640, 360), {200, 333}, {65, 64}}) {
            render::Job job;
            job.xml = worldOf(8, background);
            job.options.width = size.x;
            job.options.height = size.y;
            job.options.samples = 4;
            CAPTURE(background, size.x);
            image::Image image, whole;
            renderer.draw(job, image);
            job.drawUnseen = true;
            renderer.draw(job, whole);
            CHECK(image.pixels == whole.pixels);
        }
}

TEST_CASE("a model that moves over the image looks as if each frame had its own target") {
    render::Renderer renderer;
    render::Job job;
    job.options.width = 500;
    job.options.height = 300;
    job.options.samples = 4;
    // Small in a corner, larger and larger, over the whole image, and small again.
    for (const double distance : {60.0, 30.0, 12.0, 2.0, 9.0, 25.0, 90.0, 90.0, 30.0}) {
        job.xml = "<world><camera><position x=\"0\" y=\"0\" z=\"" + std::to_string(distance) +
                  "\"/><lookAt x=\"" + std::to_string(distance * 0.5) +
                  "\" y=\"0\" z=\"0\"/></camera>" + kLights +
                  "<group><models>"
                  "<model file=\"sphere_1_20_20.3d\"/></models></group></world>";
        image::Image image;
        renderer.draw(job, image);
        image::Image whole;
        render::Renderer other;
        job.drawUnseen = true;
        other.draw(job, whole);
        job.drawUnseen = false;
        CAPTURE(distance);
        CHECK(image.pixels == whole.pixels);
    }
}
