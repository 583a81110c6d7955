#include "render/plan/batches.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>
#include <random>

#include "render/plan/passes.h"
#include "render/renderer.h"

// Models that differ in their place alone are drawn by one call: the same pixels as one by one.
using namespace farol;
using render::Batch;
using render::FramePlan;

namespace {

/// A unit cube at a place, eye space.
render::DrawItem cubeAt(int mesh, const glm::vec3& place) {
    auto data = std::make_shared<render::MeshData>();
    data->id = static_cast<std::uint64_t>(mesh);
    data->bounds.add(glm::dvec3(-0.5));
    data->bounds.add(glm::dvec3(0.5));
    render::DrawItem item;
    item.mesh = std::move(data);
    item.viewFromObject[3] = glm::vec4(place, 1.0F);
    return item;
}

/// Cubes of the meshes named, side by side.
FramePlan planOf(const std::vector<int>& meshes) {
    FramePlan plan;
    plan.camera.near = 1.0;
    plan.camera.far = 100.0;
    plan.camera.fovDeg = 60.0;
    plan.view = render::viewOf(plan.camera, glm::ivec2(512));
    plan.lightSets.emplace_back();
    for (std::size_t i = 0; i < meshes.size(); ++i)
        plan.items.push_back(cubeAt(meshes[i], {2.0F * static_cast<float>(i) - 20.0F, 0.0F, -40}));
    return plan;
}

/// Checks that every item is drawn once.
std::vector<std::size_t> countsOf(FramePlan plan) {
    render::composePasses(plan, {});
    const render::Batches& all = plan.batches;
    std::vector<std::size_t> counts;
    for (const Batch& batch : all.batches) {
        CHECK(batch.first == std::accumulate(counts.begin(), counts.end(), std::size_t{0}));
        CHECK(batch.instanced == (batch.count >= render::kMinInstances));
        counts.push_back(batch.count);
    }
    std::vector<std::uint32_t> order = all.order;
    std::sort(order.begin(), order.end());
    REQUIRE(order.size() == plan.items.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) CHECK(order[i] == i);
    return counts;
}

std::string number(double value) { return std::to_string(value); }

/// Models of one kind after the other, many of them in one place or flat against each other.
std::string crowdOf(const std::vector<std::string>& models, int each) {
    std::mt19937 random(5);
    std::uniform_int_distribution<int> step(-6, 6);
    std::string text =
        "<world><window width=\"150\" height=\"110\"/><camera><position x=\"1\" y=\"2\" "
        "z=\"12\"/><lookAt x=\"0\" y=\"0\" z=\"0\"/></camera><lights><light type=\"point\" "
        "posx=\"3\" posy=\"9\" posz=\"7\"/><light type=\"directional\" dirx=\"1\" diry=\"1\" "
        "dirz=\"1\"/></lights>";
    for (const std::string& model : models)
        for (int i = 0; i < each; ++i)
            text += "<group><transform><translate x=\"" + number(0.5 * step(random)) + "\" y=\"" +
                    number(0.5 * step(random)) + "\" z=\"" + number(0.5 * step(random)) +
                    "\"/><rotate angle=\"" + number(30 * step(random)) +
                    "\" x=\"0\" y=\"1\" z=\"0\"/><scale x=\"" + (i >= 20 ? "-1" : "1") +
                    "\" y=\"1\" z=\"" + (i % 3 == 2 ? "0.5" : "1") +
                    "\"/></transform><models><model " + model + "</models></group>";
    return text + "</world>";
}

}  // namespace

TEST_CASE("models that differ in their place alone make a batch") {
    using Counts = std::vector<std::size_t>;
    CHECK(countsOf(planOf({})).empty());
    FramePlan plan = planOf(std::vector<int>(20, 4));
    CHECK(countsOf(plan) == Counts{20});
    plan.items[9].diffuse.x = 0.5F;
    CHECK(countsOf(plan) == Counts{19, 1});
    plan.style.mergesCalls = false;
    CHECK(countsOf(plan) == Counts(20, 1));
    plan.style.mergesCalls = true;
    plan.style.layer = render::Layer::id;
    CHECK(countsOf(plan) == Counts(20, 1));
    CHECK(countsOf(planOf({1, 2, 1, 2, 1, 2, 1, 2, 1, 2})) == Counts{5, 5});
}

TEST_CASE("nothing moves past a model that it may meet") {
    using Counts = std::vector<std::size_t>;
    const std::vector<int> meshes{1, 1, 1, 1, 2, 1, 1, 1, 1};
    CHECK(countsOf(planOf(meshes)) == Counts{8, 1});
    FramePlan plan = planOf(meshes);
    plan.items[4] = cubeAt(2, {-10.0F, 0.4F, -40.0F});  // where item 5 is
    CHECK(countsOf(plan) == Counts{4, 1, 4});           // and those behind join the nearest
    plan.items[4] = cubeAt(2, {-10.0F, 0.0F, -30.0F});  // before it, farther than both are deep
    CHECK(countsOf(plan) == Counts{8, 1});
    plan.items[4] = cubeAt(2, {0.0F, 0.0F, -1.2F});  // reaches the viewer
    CHECK(countsOf(plan) == Counts{4, 1, 4});
}

TEST_CASE("what is drawn by one call gives the same pixels as model by model") {
    const std::string red =
        "<color><diffuse R=\"200\" G=\"30\" B=\"20\"/>"
        "<specular R=\"200\" G=\"200\" B=\"200\"/><shininess "
        "value=\"40\"/></color></model>";
    const std::string blue = "<color><diffuse R=\"20\" G=\"30\" B=\"200\"/></color></model>";
    const std::string board = "<texture file=\"chess:4x4\"/></model>";
    const std::string xml =
        crowdOf({"file=\"box_0.8_1.3d\">" + red, "file=\"box_0.8_1.3d\">" + blue,
                 "file=\"sphere_0.5.3d\">" + red, "file=\"sphere_0.5_8_8.3d\">" + blue,
                 "file=\"cone_0.5_1.3d\">" + blue, "file=\"torus_0.5_0.2.3d\">" + red,
                 "file=\"sphere_0.4.3d\">" + board, "file=\"box_0.8_1.3d\">" + board},
                30);
    render::Renderer renderer;
    using scene::Shading;
    for (const Shading shading : {Shading::phong, Shading::gouraud, Shading::flat, Shading::solid,
                                  Shading::chess, Shading::wireframe, Shading::points})
        for (const render::Layer layer : {render::Layer::color, render::Layer::normal,
                                          render::Layer::depth, render::Layer::id}) {
            if (layer != render::Layer::color && shading != Shading::phong) continue;
            render::Job job;
            job.xml = xml;
            job.options.shading = shading;
            job.options.layer = layer;
            image::Image batched, single;
            const render::Stats few = renderer.draw(job, batched).stats;
            job.drawUnseen = true;
            const render::Stats many = renderer.draw(job, single).stats;
            CAPTURE(static_cast<int>(shading), static_cast<int>(layer));
            CHECK(batched.pixels == single.pixels);
            CHECK(many.drawCalls > 200);
            if (layer != render::Layer::id)
                // Models close to others have exact depth and are drawn apart from their like.
                CHECK(few.drawCalls <= many.drawCalls * 3 / 5);
        }
}
