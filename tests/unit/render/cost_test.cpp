// The estimate of what a frame costs, and the budget that refuses it before anything is drawn.
#include "render/plan/cost.h"

#include <catch2/catch.hpp>

#include "core/error.h"
#include "tests/support/plan_scene.h"

using namespace farol;
using namespace farol::render;

namespace {

/// Boxes behind each other that fill the view.
scene::Scene boxes(int count, int lights = 1) {
    scene::Scene scene;
    scene.camera = scene::Camera{};
    scene.camera->eye = glm::dvec3(0, 0, 10);
    for (int i = 0; i < count; ++i) {
        scene::Group& group = scene.groups.emplace_back();
        group.transforms.push_back(scene::Translate{{0, 0, -30.0 - i}});
        scene::Model& model = group.models.emplace_back();
        model.source.kind = scene::ModelSource::Kind::shape;
        model.source.shape = generator::parseCall({"box", "100", "1"});
    }
    for (int i = 0; i < lights; ++i) scene.lights.emplace_back();
    return scene;
}

FramePlan planOf(const scene::Scene& scene, int side, int samples,
                 scene::Shading shading = scene::Shading::phong) {
    PictureOptions options;
    options.width = options.height = side;
    options.samples = samples;
    options.shading = shading;
    MeshLibrary meshes(1 << 20);
    return support::planScene(scene, options, scene::BundleAssets(), meshes);
}

double costOf(const FramePlan& plan) { return estimateCost(plan).total(); }

/// "done", or the message of limit.cost.
std::string refusal(CostBudget& budget, const FramePlan& plan) {
    try {
        budget.spend(plan);
        return "done";
    } catch (const Error& error) {
        CHECK(error.code() == "limit.cost");
        return error.what();
    }
}

}  // namespace

TEST_CASE("cost grows with pixels, samples, layers, lights and triangles") {
    const double small = costOf(planOf(boxes(1), 512, 4));
    CHECK(costOf(planOf(boxes(1), 1024, 4)) > 3.0 * small);
    CHECK(costOf(planOf(boxes(1), 512, 16)) > 3.0 * small);
    CHECK(costOf(planOf(boxes(10), 512, 16)) > 4.0 * costOf(planOf(boxes(1), 512, 16)));
    CHECK(costOf(planOf(boxes(1, 8), 512, 16)) > 2.0 * costOf(planOf(boxes(1), 512, 16)));
    scene::Scene fine = boxes(1);
    fine.groups[0].models[0].source.shape = generator::parseCall({"box", "100", "100"});
    CHECK(estimateCost(planOf(fine, 512, 4)).geometry >
          10.0 * estimateCost(planOf(boxes(1), 512, 4)).geometry);
    CHECK(costOf(planOf(fine, 512, 4, scene::Shading::wireframe)) >
          estimateCost(planOf(fine, 512, 4)).geometry);
}

TEST_CASE(
    "the largest picture of a filled view is beyond two cores' deadline, a common one is not") {
    CHECK(costOf(planOf(boxes(3, 4), 4096, 16)) > 15.0);
    CHECK(costOf(planOf(boxes(1), 4096, 4)) < 15.0);
    CHECK(costOf(planOf(boxes(3, 4), 1024, 16)) < 15.0);
    CHECK(costOf(planOf(boxes(100, 8), 512, 4)) < 15.0);
}

TEST_CASE("a mesh of layers counts each of them") {
    generator::MeshArrays arrays;
    for (int i = 0; i < 100; ++i) {
        const auto z = static_cast<float>(0.001 * i);
        for (const glm::vec2 p : {glm::vec2(-50, -50), {50, -50}, {50, 50}, {-50, 50}})
            arrays.positions.emplace_back(p, z);
        for (const unsigned corner : {0U, 1U, 2U, 0U, 2U, 3U})
            arrays.indices.push_back(static_cast<std::uint32_t>(4 * i) + corner);
    }
    MeshData layers;
    layers.mesh = generator::Mesh(std::move(arrays));
    for (const glm::vec3& position : layers.mesh.positions())
        layers.bounds.add(glm::dvec3(position));
    FramePlan plan = planOf(boxes(1), 4096, 16);
    const double one = estimateCost(plan).fragments;
    plan.items[0].indices = layers.mesh.indices().size();
    plan.items[0].mesh = std::make_shared<const MeshData>(layers);
    CHECK(estimateCost(plan).fragments > 20.0 * one);
}

namespace {

/// The boxes, each `aside` further to the right, half transparent.
FramePlan planOfGlass(int count, double aside, scene::Transparency transparency, int samples = 4) {
    scene::Scene scene = boxes(count);
    for (std::size_t i = 0; i < scene.groups.size(); ++i) {
        scene.groups[i].transforms.push_back(
            scene::Translate{{aside * static_cast<double>(i), 0, 0}});
        scene::Model& model = scene.groups[i].models[0];
        model.source.shape = generator::parseCall({"box", "4", "1"});
        model.material.emplace().opacity = 0.5F;
    }
    scene.settings.transparency = transparency;
    return planOf(scene, 512, samples);
}

}  // namespace

TEST_CASE("blended models cost both their sides, peeled ones each of their layers") {
    using scene::Transparency;
    const auto fragments = [](const FramePlan& plan) { return estimateCost(plan).fragments; };
    const auto geometry = [](const FramePlan& plan) { return estimateCost(plan).geometry; };
    const FramePlan off = planOfGlass(4, 0, Transparency::off),
                    on = planOfGlass(4, 0, Transparency::on),
                    exact = planOfGlass(4, 0, Transparency::exact);
    CHECK(on.stats.blended == 4);
    CHECK(fragments(on) == Approx(2.0 * fragments(off)));
    CHECK(geometry(on) == Approx(2.0 * geometry(off)));
    // Eight sides, and a draw that finds none left.
    CHECK(geometry(exact) == Approx(9.0 * geometry(on)));
    CHECK(fragments(exact) > 9.0 * fragments(on));
    CHECK(estimateCost(exact).pixels > 2.0 * estimateCost(on).pixels);
    // Without antialiasing a pixel is one sample.
    CHECK(fragments(planOfGlass(4, 0, Transparency::exact, 1)) < 0.5 * fragments(exact));
    // Twice the boxes behind each other: twice the layers of twice the sides. Beside each other:
    // the layers of one.
    CHECK(geometry(planOfGlass(8, 0, Transparency::exact)) ==
          Approx(2.0 * 17.0 / 9.0 * geometry(exact)));
    CHECK(geometry(planOfGlass(3, 6, Transparency::exact)) ==
          Approx(3.0 / 4.0 * 3.0 / 9.0 * geometry(exact)));
    // Surfaces beyond the limit of layers are not drawn.
    CHECK(geometry(planOfGlass(80, 0, Transparency::exact)) ==
          Approx(20.0 * 65.0 / 9.0 * geometry(exact)));
}

TEST_CASE("a budget is refused by the layers that a frame peels") {
    const FramePlan on = planOfGlass(20, 0, scene::Transparency::on),
                    exact = planOfGlass(20, 0, scene::Transparency::exact);
    CostBudget budget(2.0 * costOf(on));
    CHECK(refusal(budget, on) == "done");
    CHECK(refusal(budget, exact) != "done");
}

TEST_CASE("a budget is spent by frames and refuses what exceeds it, and says what to lower") {
    const FramePlan frame = planOf(boxes(1), 512, 16);
    const double cost = costOf(frame);
    CostBudget budget(2.5 * cost);
    CHECK(refusal(budget, frame) == "done");
    CHECK(refusal(budget, frame) == "done");
    const std::string message = refusal(budget, frame);
    CHECK(message.find("512 x 512 px, 16 samples") != std::string::npos);
    CHECK(message.find("lower aa, width or height") != std::string::npos);
    CostBudget turn(2.5 * cost);
    turn.expectFrames(3);
    CHECK(refusal(turn, frame).find("lower frames") != std::string::npos);  // before the first
    turn.expectFrames(2);
    CHECK(refusal(turn, frame) == "done");
    CHECK(refusal(turn, frame) == "done");
    {
        CostBudget images(1.0);
        images.spend(0.75, "comparing");
        CHECK_THROWS_AS(images.spend(0.5, "comparing"), Error);
        images.spend(0.25, "comparing");
    }
    CostBudget unbounded(0.0);
    unbounded.spend(1e9, "comparing");
    CHECK(refusal(unbounded, planOf(boxes(100, 8), 4096, 16)) == "done");
}
