#include "render/plan/quality.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <memory>

#include "render/renderer.h"

using namespace farol;
using namespace farol::render;

namespace {

const std::vector<FrameLoad> kLoads{{1.0, 0, 0, 0},
                                    {512.0 * 512, 20, 5'000, 2},
                                    {1920.0 * 1080, 1'000, 0, 1},
                                    {4096.0 * 4096, 100'000, 4e6, 64}};

Job spheres(const std::string& settings,
            const std::vector<std::pair<std::string, std::string>>& options) {
    Job job;
    job.xml =
        "<world><window width=\"96\" height=\"64\"/>" + settings +
        "<lights><light type=\"directional\" dirx=\"1\" diry=\"1\" dirz=\"1\"/></lights><group>"
        "<models><model file=\"sphere_1.3d\"/></models></group></world>";
    job.assets = std::make_shared<scene::BundleAssets>();
    for (const auto& [name, value] : options) applyOption(job.options, name, value);
    return job;
}

}  // namespace

TEST_CASE("a larger budget never chooses worse, a heavier scene never better") {
    for (const FrameLoad& load : kLoads) {
        Quality before = chooseQuality(0.1, load, {}, {});
        for (double budget = 0.1; budget <= 60'000; budget *= 1.1) {
            const Quality now = chooseQuality(budget, load, {}, {});
            CAPTURE(budget, load.pixels);
            CHECK(now.expectedMs >= before.expectedMs);
            CHECK(now.samples >= before.samples);
            CHECK(now.errorPx <= before.errorPx);
            CHECK(now.within == (now.expectedMs <= budget));
            before = now;
            FrameLoad heavier = load;
            heavier.writtenTriangles += 1e6;
            CHECK(chooseQuality(budget, heavier, {}, {}).samples <= now.samples);
        }
    }
    // The range is worth having: both ends of the front are reached.
    CHECK(chooseQuality(60'000, kLoads[1], {}, {}).samples >
          chooseQuality(0.1, kLoads[1], {}, {}).samples);
    CHECK_FALSE(chooseQuality(0.1, kLoads[3], {}, {}).within);
}

TEST_CASE("an error has the samples of the front, as documented") {
    // These numbers are in the text of the option `error` and in docs/explanation/accuracy.md.
    for (const auto& [errorPx, samples] : std::vector<std::pair<double, int>>{{64, 1},
                                                                              {2.01, 1},
                                                                              {2, 4},
                                                                              {0.25, 4},
                                                                              {0.126, 4},
                                                                              {0.125, 8},
                                                                              {0.063, 8},
                                                                              {0.0625, 16},
                                                                              {0.01, 16}}) {
        CAPTURE(errorPx);
        CHECK(samplesFor(errorPx) == samples);
    }
}

TEST_CASE("more of anything is expected to take longer") {
    const FrameLoad load = kLoads[1];
    const double ms = expectedMs(load, 4, 0.25);
    CHECK(ms > 0);
    CHECK(expectedMs(load, 16, 0.25) > ms);
    CHECK(expectedMs(load, 4, 0.06) > ms);
    for (const auto part : {&FrameLoad::pixels, &FrameLoad::openModels,
                            &FrameLoad::writtenTriangles, &FrameLoad::lights}) {
        FrameLoad more = load;
        more.*part *= 4;
        CHECK(expectedMs(more, 4, 0.25) > ms);
    }
}

TEST_CASE("see-through surfaces are expected to take longer, sorted in each pixel longest") {
    const FrameLoad opaque{1.0e6, 0, 10'000, 1};
    FrameLoad blended = opaque;
    blended.seeThrough = 2.0;
    FrameLoad peeled = blended;
    peeled.peels = 3.0;
    CHECK(expectedMs(blended, 4, 0.25) > 2.0 * expectedMs(opaque, 4, 0.25));
    CHECK(expectedMs(peeled, 4, 0.25) > 3.0 * expectedMs(blended, 4, 0.25));
    FrameLoad deeper = peeled;
    deeper.peels = 6.0;
    CHECK(expectedMs(deeper, 4, 0.25) > 1.5 * expectedMs(peeled, 4, 0.25));
    // Without antialiasing a pixel is one sample.
    CHECK(expectedMs(peeled, 1, 0.25) < 2.0 * expectedMs(blended, 1, 0.25));
}

TEST_CASE("a budget counts a scene's see-through models as they are drawn") {
    Renderer renderer;
    const auto expected = [&](const char* opacity, const char* transparency) {
        render::Job job;
        job.xml = std::string(
                      "<world><camera><position x=\"0\" y=\"0\" z=\"4\"/></camera><group>"
                      "<models><model file=\"box_2_1.3d\" opacity=\"") +
                  opacity + "\"/></models></group></world>";
        job.assets = std::make_shared<scene::BundleAssets>();
        render::applyOption(job.options, "budget_ms", "60000");
        render::applyOption(job.options, "aa", "4");
        render::applyOption(job.options, "transparency", transparency);
        return renderer.render(job).quality->expectedMs;
    };
    const double opaque = expected("1", "on");
    CHECK(expected("0.5", "off") == opaque);
    CHECK(expected("0.5", "on") > 1.2 * opaque);
    CHECK(expected("0.5", "exact") > 1.5 * expected("0.5", "on"));
}

TEST_CASE("what the request or the scene says stays under a budget") {
    Renderer renderer;
    const Picture cheap = renderer.render(spheres("", {{"budget_ms", "0.1"}}));
    const Picture fine = renderer.render(spheres("", {{"budget_ms", "60000"}}));
    REQUIRE(cheap.quality);
    REQUIRE(fine.quality);
    CHECK(cheap.quality->samples < fine.quality->samples);
    CHECK(cheap.bytes != fine.bytes);
    CHECK_FALSE(renderer.render(spheres("", {})).quality);

    const Picture samples = renderer.render(spheres("", {{"budget_ms", "0.1"}, {"aa", "8"}}));
    CHECK(samples.quality->samples == 8);
    const Picture error = renderer.render(spheres("", {{"error", "0.11"}, {"budget_ms", "0.1"}}));
    CHECK(error.quality->errorPx == 0.11);
    const Picture scene = renderer.render(spheres("<render aa=\"2\"/>", {{"budget_ms", "60000"}}));
    CHECK(scene.quality->samples == 2);
}

TEST_CASE("a budget gives the bytes of the options that it chose, each time") {
    Renderer renderer;
    for (const char* budget : {"0.1", "2", "8", "60000"}) {
        const Picture first = renderer.render(spheres("", {{"budget_ms", budget}}));
        const Picture again = Renderer().render(spheres("", {{"budget_ms", budget}}));
        CHECK(first.bytes == again.bytes);
        const Quality& chosen = *first.quality;
        const Picture said =
            renderer.render(spheres("", {{"aa", std::to_string(chosen.samples)},
                                         {"error", std::to_string(chosen.errorPx)}}));
        CHECK(said.bytes == first.bytes);
    }
}
