#include <catch2/catch.hpp>

#include "image/format.h"
#include "render/prepare.h"
#include "render/renderer.h"
#include "scene/files/assets.h"

using namespace farol;

namespace {

render::Job jobOf(const std::string& xml, std::map<std::string, std::string> files = {}) {
    render::Job job;
    job.xml = xml;
    job.assets = std::make_shared<scene::BundleAssets>(std::move(files));
    job.options.missing = render::Missing::placeholder;
    job.options.width = 64;
    job.options.height = 64;
    return job;
}

std::string codesOf(const Diagnostics& diagnostics) {
    std::string codes;
    for (const Diagnostic& one : diagnostics)
        if (one.severity == Severity::error) codes += one.code + " ";
    return codes;
}

std::string world(const std::string& models) {
    return "<world><lights><light type=\"directional\" dirZ=\"1\" dirY=\"1\"/></lights>"
           "<group><models>" +
           models + "</models></group></world>";
}

}  // namespace

TEST_CASE("missing and damaged files have placeholders, and the errors stay in the list") {
    const render::Job job =
        jobOf(world("<model file=\"box_1.3d\"><texture file=\"gone.png\"/></model>"
                    "<model file=\"gone.obj\"/>"
                    "<model file=\"damaged.obj\"/>"
                    "<model file=\"damaged.obj\"/>"
                    "<model file=\"box_2.3d\"><texture file=\"damaged.png\"/></model>"
                    "<model file=\"box_3.3d\"/>"),
              {{"damaged.obj", "v 0 0 0\nf 1 2 nonsense\n"}, {"damaged.png", "no image"}});
    const render::Prepared prepared = render::prepare(job);
    CHECK(codesOf(prepared.diagnostics).find("asset.missing asset.missing") == 0);
    // One error for each file, however often it is named.
    CHECK(std::count_if(prepared.diagnostics.begin(), prepared.diagnostics.end(),
                        [](const Diagnostic& one) { return one.severity == Severity::error; }) ==
          4);
    const std::vector<scene::Model>& models = prepared.scene.groups.at(0).models;
    CHECK(models.at(0).texture->chess);
    for (const int box : {1, 2, 3}) {
        const scene::Model& model = models.at(static_cast<std::size_t>(box));
        CHECK(model.source.kind == scene::ModelSource::Kind::shape);
        CHECK(model.texture->chess);
    }
    CHECK(models.at(4).texture->chess);
    CHECK_FALSE(models.at(5).texture);

    render::Job strict = job;
    strict.options.missing = render::Missing::error;
    CHECK_THROWS_AS(render::prepare(strict), Error);
}

TEST_CASE("a placeholder is seen in the image") {
    render::Renderer renderer;
    image::Image image;
    const render::Picture picture =
        renderer.draw(jobOf("<world><camera><position z=\"3\"/><lookAt x=\"0\"/></camera><group>"
                            "<models><model file=\"gone.obj\"><color/></model></models></group>"
                            "</world>"),
                      image);
    CHECK(codesOf(picture.diagnostics) == "asset.missing ");
    std::size_t magenta = 0, black = 0;
    for (int y = 28; y < 36; ++y)
        for (int x = 28; x < 36; ++x) {
            const std::size_t at = 4 * static_cast<std::size_t>(y * image.width + x);
            const bool red = image.pixels[at] > 200, green = image.pixels[at + 1] > 200;
            magenta += red && !green ? 1 : 0;
            black += !red && !green ? 1 : 0;
        }
    CHECK(magenta > 8);
    CHECK(black > 8);
}

TEST_CASE("a scene of lines keeps its lines beside a placeholder") {
    const render::Prepared prepared = render::prepare(
        jobOf("<world><group><models><model file=\"gone.obj\"/><model file=\"box_1.3d\"/>"
              "</models></group></world>"));
    for (const scene::Model& model : prepared.scene.groups.at(0).models) {
        CHECK_FALSE(model.texture);
        CHECK_FALSE(model.material);
    }
}

TEST_CASE("a background, a skybox and an included scene that are missing are left out") {
    const render::Prepared prepared = render::prepare(
        jobOf("<world><background texture=\"no.png\"/><skybox texture=\"no.png\"/>"
              "<entity file=\"no.xml\"/><group><model file=\"box_1.3d\"/></group></world>"));
    CHECK(prepared.scene.background.path.empty());
    CHECK_FALSE(prepared.scene.skybox);
    CHECK_FALSE(prepared.scene.entity);
    CHECK(codesOf(prepared.diagnostics) == "asset.missing asset.missing asset.missing ");
}

TEST_CASE("a document that cannot be read at all has no placeholder") {
    for (const char* xml : {"", "{}", "<svg/>", "<scene><integrator/></scene>"})
        CHECK_THROWS_AS(render::prepare(jobOf(xml)), Error);
    render::Job mesh = jobOf("v 0 0 0\nf 1 2 nonsense\n");
    mesh.name = "damaged.obj";
    render::Renderer renderer;
    CHECK_THROWS_AS(renderer.render(mesh), Error);
}
