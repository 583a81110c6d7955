// What fragments read comes from uniforms or from flat attributes: the same image.
#include <catch2/catch.hpp>
#include <fstream>

#include "image/image_file.h"
#include "render/gl/painter.h"
#include "render/plan/instances.h"
#include "render/plan/passes.h"
#include "render/plan/plan.h"
#include "render/prepare.h"
#include "tests/support/lesser_context.h"
#include "tests/support/paths.h"
#include "tests/support/plan_scene.h"

using namespace farol;
using render::Feature;
using render::FramePlan;
using render::gl::Painter;

namespace {

/// A model that fills the view, of so many triangles.
FramePlan frameOf(std::size_t triangles) {
    FramePlan plan;
    plan.view = render::viewOf(plan.camera, {200, 100});
    plan.lightSets = {{}};
    auto mesh = std::make_shared<render::MeshData>();
    mesh->bounds.add(glm::dvec3(-100.0));
    mesh->bounds.add(glm::dvec3(100.0));
    render::DrawItem item;
    item.mesh = mesh;
    item.indices = 3 * triangles;
    plan.items.push_back(item);
    return plan;
}

bool isCarried(FramePlan plan, const render::GlFacts& gl) {
    render::composePasses(plan, gl);
    return plan.passes.at(0).features.has(Feature::carried);
}

render::Job exampleOf(const std::string& name) {
    const std::string folder = std::string(test::kSourceDir) + "/scenes/" + name;
    std::ifstream in(folder + "/scene.xml", std::ios::binary);
    render::Job job;
    job.xml = {std::istreambuf_iterator<char>(in), {}};
    job.assets = std::make_shared<scene::FolderAssets>(folder);
    job.options.width = 200;
    job.options.height = 150;
    return job;
}

struct Drawn {
    image::Image image;
    bool isCarried = false;
};

Drawn draw(Painter& painter, const render::Job& job) {
    const render::Prepared prepared = render::prepare(job);
    render::MeshLibrary meshes(std::size_t{64} << 20);
    FramePlan plan = render::plan(
        prepared.scene,
        render::place(prepared.scene, job.options.timeS, false, *prepared.assets, meshes),
        job.options, *prepared.assets, meshes, painter.facts());
    const auto open = [&](const render::TextureRef& ref) -> render::UndecodedTexture {
        const std::string bytes = prepared.assets->read(ref.path).value();
        return {0, 0, false, [=](std::string& damage) {
                    return image::decodeImage(bytes, ref.path, ref.where, &damage);
                }};
    };
    Drawn drawn{{}, plan.passes.back().features.has(Feature::carried)};
    Painter::Timings timings;
    Diagnostics warnings;
    painter.draw(plan, open, drawn.image, timings, warnings);
    return drawn;
}

}  // namespace

TEST_CASE("attributes carry uniforms where fragments are many and the GL reads those slowly") {
    render::GlFacts gl = support::fourSamples();
    gl.readsUniformsByPixel = true;
    gl.vertexComponents = 128;
    CHECK(isCarried(frameOf(2), gl));
    CHECK(isCarried(frameOf(10'000), gl));
    CHECK_FALSE(isCarried(frameOf(100'000), gl));
    FramePlan fine = frameOf(100'000);
    fine.style.samples = 8;  // nine fragments a pixel
    CHECK(isCarried(fine, gl));
    FramePlan flat = frameOf(2);
    flat.style.shading = scene::Shading::flat;  // lit at vertices
    CHECK_FALSE(isCarried(flat, gl));
    gl.vertexComponents = 64;
    CHECK_FALSE(isCarried(frameOf(2), gl));
    gl.vertexComponents = 128;
    gl.readsUniformsByPixel = false;
    CHECK_FALSE(isCarried(frameOf(2), gl));
}

TEST_CASE("a mesh that fills little of its box counts as little") {
    const std::string ring = "<models><model file=\"ring_40_40.1_400.3d\"/></models>";
    render::Job job;
    job.xml = "<world>" + ring + "</world>";
    const render::Prepared prepared = render::prepare(job);
    render::MeshLibrary meshes(std::size_t{1} << 20);
    const render::Placed placed =
        render::place(prepared.scene, 0.0, false, *prepared.assets, meshes);
    CHECK(placed.scene.instances.at(0).mesh->filled < 0.01);
}

TEST_CASE("images are the same by uniforms and by attributes") {
    const std::string name = GENERATE("primitives", "robot-arm", "lighthouse", "shadows");
    CAPTURE(name);
    Painter painter(render::gl::createContext(render::GlSource::automatic));
    Painter plain(std::make_unique<support::LesserContext>(
        [](render::GlFacts& gl) { gl.readsUniformsByPixel = false; }));
    render::Job job = exampleOf(name);
    job.options.samples = GENERATE(1, 4);
    if (name == "shadows") job.options.shadows = scene::Shadows::map;
    const Drawn by = draw(painter, job), without = draw(plain, job);
    CHECK(by.isCarried);
    CHECK_FALSE(without.isCarried);
    CHECK(by.image == without.image);
}
