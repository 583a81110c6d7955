// A pass of depths before the shading one: chosen where it saves time, and never seen.
#include "render/plan/depth_pass.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "render/renderer.h"
#include "tests/support/paths.h"

using namespace farol;
namespace fs = std::filesystem;

namespace {

std::string model(const std::string& shape, const glm::dvec3& place, double scale, double turn) {
    const auto text = [](double value) { return std::to_string(value); };
    return "<group><transform><translate x=\"" + text(place.x) + "\" y=\"" + text(place.y) +
           "\" z=\"" + text(place.z) + "\"/><rotate angle=\"" + text(turn) +
           "\" x=\"1\" y=\"2\" z=\"0.5\"/><scale x=\"" + text(scale) + "\" y=\"" + text(scale) +
           "\" z=\"" + text(scale) + "\"/></transform><models><model command=\"" + shape +
           "\" diffuse=\"" + text(std::abs(std::sin(place.x))) + " " +
           text(std::abs(std::cos(place.y))) + " 0.5\"/></models></group>";
}

render::Job jobOf(const std::string& models, int samples) {
    render::Job job;
    job.xml =
        "<world><window width=\"160\" height=\"120\"/><camera><position x=\"0\" y=\"0\" "
        "z=\"12\"/><lookAt x=\"0\" y=\"0\" z=\"0\"/></camera><lights><light type=\"point\" "
        "posx=\"3\" posy=\"5\" posz=\"9\"/></lights>" +
        models + "</world>";
    job.assets = std::make_shared<scene::BundleAssets>();
    job.options.samples = samples;
    return job;
}

/// Draws with and without a pass of depths; returns the statistics with it.
render::Stats sameWithout(render::Renderer& renderer, render::Job job) {
    image::Image image, plain;
    const render::Stats stats = renderer.draw(job, image).stats;
    job.drawUnseen = true;
    const render::Stats all = renderer.draw(job, plain).stats;
    CHECK(all.occluders == 0);
    CHECK(image.pixels == plain.pixels);
    return stats;
}

}  // namespace

TEST_CASE("depths are drawn first of what covers others later, and of nothing else") {
    render::Renderer renderer;
    const std::string behind = model("box 6", {0, 0, -6}, 1.0, 0.0),
                      before = model("box 5", {0, 0, 4}, 1.0, 0.0);
    for (const int samples : {8, 16}) {
        const render::Stats later = sameWithout(renderer, jobOf(behind + before, samples));
        CHECK(later.occluders == 1);
        CHECK(later.overdraw > 1.1);
        CHECK(later.overdraw < 2.0);
        const render::Stats earlier = sameWithout(renderer, jobOf(before + behind, samples));
        CHECK(earlier.occluders == 0);
        CHECK(earlier.overdraw == 1.0);
    }
    // The GL's own samples share their shading; lines have no insides.
    CHECK(sameWithout(renderer, jobOf(behind + before, 4)).occluders == 0);
    render::Job lines = jobOf(behind + before, 8);
    lines.options.shading = scene::Shading::wireframe;
    CHECK(sameWithout(renderer, lines).occluders == 0);
    // A room around the viewer is behind all that is in it.
    const std::string room = model("box 40", {0, 0, 0}, -1.0, 0.0);
    CHECK(sameWithout(renderer, jobOf(before + room, 8)).occluders == 0);
}

TEST_CASE("a pass of depths changes no byte of models that cross, touch and share planes") {
    render::Renderer renderer;
    std::mt19937 random(23);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    const std::vector<std::string> shapes{"box 2",         "sphere 1 24 12", "sphere 1",
                                          "cone 1 2 16 2", "torus 1 0.4",    "plane 4 3",
                                          "cylinder 1 2"};
    int withDepths = 0;
    for (int i = 0; i < 120; ++i) {
        std::string models;
        for (int j = 0; j < 9; ++j) {
            // One in three stands on a grid, not turned: its faces lie in others' planes.
            const bool onGrid = random() % 3 == 0;
            glm::dvec3 place(between(-3, 3), between(-2, 2), between(-9, 9));
            if (onGrid) place = glm::round(place);
            models += model(shapes[random() % shapes.size()], place,
                            onGrid ? 1.0 : between(0.4, 2.5), onGrid ? 0.0 : between(0, 360));
        }
        CAPTURE(i, models);
        const int samples = std::array{1, 8, 16}[random() % 3];
        withDepths += sameWithout(renderer, jobOf(models, samples)).occluders > 0;
    }
    CHECK(withDepths > 40);
}

TEST_CASE("a pass of depths changes no byte of the example scenes") {
    render::Renderer renderer;
    int withDepths = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(test::kSourceDir) / "scenes")) {
        const fs::path file = entry.path() / "scene.xml";
        if (!fs::exists(file)) continue;
        std::ifstream in(file, std::ios::binary);
        render::Job job;
        job.name = "scene.xml";
        job.xml = {std::istreambuf_iterator<char>(in), {}};
        job.assets = std::make_shared<scene::FolderAssets>(entry.path().string());
        job.options.width = 240;
        job.options.height = 180;
        for (const int samples : {1, 8, 16}) {
            CAPTURE(file.string(), samples);
            job.options.samples = samples;
            withDepths += sameWithout(renderer, job).occluders > 0;
        }
    }
    CHECK(withDepths >= 12);
}
