// A frame's style becomes passes, and its models' materials the features of their shaders.
#include "render/plan/passes.h"

#include <catch2/catch.hpp>
#include <set>

#include "generator/registry.h"
#include "render/plan/sampling.h"
#include "tests/support/plan_scene.h"

using namespace farol;
using render::Feature;
using render::FeatureSet;
using render::FramePlan;
using render::PassItem;

namespace {

/// One lit and textured model before a camera.
FramePlan frameOf(const render::FrameStyle& style = {}) {
    FramePlan plan;
    plan.style = style;
    plan.view = render::viewOf(plan.camera, {200, 100});
    render::EyeLight light{};
    light.position = glm::vec4(0, 0, 1, 0);
    light.spot.w = -2.0F;
    light.specular = glm::vec4(1.0F);
    plan.lightSets = {{light}};
    plan.textures.emplace_back();
    render::DrawItem item;
    item.mesh = std::make_shared<const render::MeshData>();
    item.texture = 0;
    item.specular = glm::vec3(0.5F);
    item.id = 0x102030;
    scene::Model ball;
    ball.source.kind = scene::ModelSource::Kind::shape;
    ball.source.shape = generator::parseCall({"sphere", "1"});
    item.surface = generator::surfaceOf(ball);
    plan.items.push_back(item);
    return plan;
}

FramePlan composed(const render::FrameStyle& style = {}) {
    FramePlan plan = frameOf(style);
    if (!style.lit) plan.lightSets = {{}};
    render::composePasses(plan, support::fourSamples());
    return plan;
}

/// The defines of the model's shader.
FeatureSet featuresOf(const FramePlan& plan) {
    const render::Pass& pass = plan.passes.at(0);
    return pass.features | (plan.batches.batches.at(0).features & pass.itemFeatures);
}

}  // namespace

TEST_CASE("the default frame is one pass") {
    const FramePlan plan = composed();
    REQUIRE(plan.passes.size() == 1);
    const render::Pass& pass = plan.passes[0];
    CHECK(pass.target.samples == 1);
    CHECK(pass.target.scale == 1);
    CHECK(pass.target.rows == plan.view.size.y);
    CHECK(pass.target.output == render::PassOutput::mean);
    CHECK(pass.target.clearColor == glm::vec4(0, 0, 0, 1));
    CHECK(pass.state.depthTest);
    CHECK(pass.state.polygons == render::Polygons::filled);
    CHECK(pass.clip == plan.view.clip);
    REQUIRE(pass.items.size() == 1);
    CHECK(pass.items[0].kind == PassItem::Kind::models);
    CHECK(pass.items[0].count == 1);
}

TEST_CASE("lines come before models, a backdrop behind them, and nothing is cleared for it") {
    FramePlan plan = frameOf();
    plan.lines.resize(4);
    plan.style.backgroundTexture = 0;
    render::composePasses(plan, support::fourSamples());
    REQUIRE(plan.passes[0].items.size() == 3);
    CHECK(plan.passes[0].items[0].kind == PassItem::Kind::lines);
    CHECK(plan.passes[0].items[0].count == 4);
    CHECK(plan.passes[0].items[2].kind == PassItem::Kind::picture);
    CHECK_FALSE(plan.passes[0].target.clearColor);
    plan.style.skyboxTexture = 0;  // hides the picture
    render::composePasses(plan, support::fourSamples());
    REQUIRE(plan.passes[0].items.size() == 3);
    CHECK(plan.passes[0].items[2].kind == PassItem::Kind::skybox);
}

TEST_CASE("more samples than four are larger targets, and passes that differ in their place") {
    render::FrameStyle style;
    struct Case {
        int wanted, scale, samples, passes;
    };
    for (const Case& one :
         std::vector<Case>{{1, 1, 1, 1}, {2, 1, 4, 1}, {4, 1, 4, 1}, {8, 3, 1, 1}, {16, 3, 1, 2}}) {
        style.samples = one.wanted;
        const FramePlan plan = composed(style);
        CAPTURE(one.wanted);
        REQUIRE(plan.passes.size() == static_cast<std::size_t>(one.passes));
        for (int i = 0; i < one.passes; ++i) {
            const render::Pass& pass = plan.passes[static_cast<std::size_t>(i)];
            CHECK(pass.target.scale == one.scale);
            CHECK(pass.target.samples == one.samples);
            CHECK(pass.features.has(Feature::supersampled) == (one.scale > 1));
            const glm::dvec2 offset = render::passOffset(i, {one.scale, one.samples, one.passes});
            CHECK(pass.clip == render::movedClip(plan.view, offset));
            CHECK(pass.features == plan.passes[0].features);
        }
    }
    // Without multisampling, and beside the largest target.
    CHECK(render::chooseSampling(4, {}, 512).scale == 2);
    render::GlFacts small;
    small.maxTargetSide = 1024;
    CHECK(render::chooseSampling(8, small, 512).passes == 2);
    CHECK(render::chooseSampling(16, small, 512).passes == 4);
    CHECK(render::chooseSampling(8, small, 1024).passes == 16);
}

TEST_CASE("samples of a pixel lie in its middle as a whole, few in one row or column") {
    for (const int wanted : {2, 4, 8, 16}) {
        const render::SamplePattern pattern = render::samplePattern(
            render::chooseSampling(wanted, support::fourSamples(), 512), support::fourSamples());
        CAPTURE(wanted);
        CHECK(pattern.size() >= static_cast<std::size_t>(wanted));
        glm::dvec2 sum(0.0);
        std::set<double> columns, rows;
        for (const glm::dvec2& at : pattern) {
            CHECK(at.x > 0.0);
            CHECK(at.x < 1.0);
            sum += at - 0.5;
            columns.insert(at.x);
            rows.insert(at.y);
        }
        CHECK(glm::length(sum) < 1e-9);
        CHECK(columns.size() >= (wanted == 8 ? 3U : wanted == 16 ? 6U : std::size_t(wanted) / 2));
        CHECK(rows.size() == columns.size());
    }
}

TEST_CASE("a large target is drawn in bands of as many rows each") {
    for (const glm::ivec2 size : {glm::ivec2(4096, 4096), {2048, 2048}, {4000, 1999}}) {
        render::FrameStyle style;
        style.samples = 8;
        FramePlan plan = frameOf(style);
        plan.view.size = size;
        render::composePasses(plan, support::fourSamples());
        REQUIRE(plan.passes.size() > 1);
        int drawn = 0;
        for (const render::Pass& pass : plan.passes) {
            CHECK(pass.target.rows == plan.passes[0].target.rows);
            CHECK(pass.target.firstRow <= drawn);
            CHECK(pass.target.firstRow + pass.target.rows > drawn);
            CHECK(std::int64_t{9} * size.x * pass.target.rows <= 32 << 20);
            drawn = pass.target.firstRow + pass.target.rows;
        }
        CHECK(drawn == size.y);
    }
}

TEST_CASE("a shader has what its model needs and no more") {
    render::FrameStyle style;
    FeatureSet features = featuresOf(composed(style));
    for (const Feature needed : {Feature::lightCount, Feature::phong, Feature::textured,
                                 Feature::filterMipmap, Feature::specular, Feature::surface})
        CHECK(features.has(needed));
    for (const Feature spare : {Feature::unlit, Feature::positional, Feature::spot,
                                Feature::localViewer, Feature::separateSpecular, Feature::layerId})
        CHECK_FALSE(features.has(spare));
    style.viewer = scene::Viewer::local;
    style.specular = scene::Specular::separate;
    features = featuresOf(composed(style));
    CHECK(features.has(Feature::localViewer));
    CHECK(features.has(Feature::separateSpecular));
    FramePlan dull = frameOf(style);
    dull.items[0].specular = glm::vec3(0.0F);
    dull.items[0].texture = -1;
    render::composePasses(dull, {});
    for (const Feature spare :
         {Feature::specular, Feature::localViewer, Feature::separateSpecular, Feature::textured})
        CHECK_FALSE(featuresOf(dull).has(spare));
    CHECK(featuresOf(dull).has(Feature::surface));  // for its normals
    dull.style.lit = false;
    dull.style.shading = scene::Shading::solid;
    dull.lightSets = {{}};
    render::composePasses(dull, {});
    CHECK(featuresOf(dull) == FeatureSet{Feature::lightCount, Feature::unlit});
}

TEST_CASE("a layer replaces what is shown and keeps what it needs of a model") {
    render::FrameStyle style;
    style.lit = false;
    style.layer = render::Layer::id;
    const FramePlan ids = composed(style);
    CHECK(featuresOf(ids) == FeatureSet{Feature::lightCount, Feature::layerId});
    CHECK(ids.batches.batches[0].plainColor == glm::vec3(0x10, 0x20, 0x30) / 255.0F);
    style.layer = render::Layer::normal;
    CHECK(featuresOf(composed(style)) == FeatureSet{Feature::lightCount, Feature::layerNormal,
                                                    Feature::surface, Feature::surfaceRay});
    style.layer = render::Layer::depth;
    CHECK(featuresOf(composed(style)).has(Feature::layerDepth));
    CHECK_FALSE(featuresOf(composed(style)).has(Feature::textured));
}

TEST_CASE("wireframe and points change how models are filled, not what a layer shows") {
    render::FrameStyle style;
    style.lit = false;
    style.shading = scene::Shading::wireframe;
    CHECK(composed(style).passes[0].state.polygons == render::Polygons::outlined);
    style.shading = scene::Shading::points;
    CHECK(composed(style).passes[0].state.polygons == render::Polygons::cornered);
    style.layer = render::Layer::normal;
    CHECK(composed(style).passes[0].state.polygons == render::Polygons::filled);
}
