#include <catch2/catch.hpp>
#include <cstdio>
#include <fstream>
#include <iterator>

#include "render/renderer.h"
#include "tests/support/exact.h"
#include "tests/support/paths.h"

using namespace farol;

namespace {

std::string textOf(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    REQUIRE(in);
    return {std::istreambuf_iterator<char>(in), {}};
}

bench::Subject example(const std::string& name) {
    const std::string folder = std::string(farol::test::kSourceDir) + "/scenes/" + name;
    return bench::readSubject(textOf(folder + "/scene.xml"),
                              std::make_shared<scene::FolderAssets>(folder));
}

image::Image drawn(const bench::Subject& subject, int width, int height, int samples) {
    render::Job job;
    job.xml = subject.xml(0);
    job.assets = subject.assets;
    job.options.width = width;
    job.options.height = height;
    job.options.samples = samples;
    job.options.shading = scene::Shading::phong;
    image::Image image;
    render::Renderer().draw(job, image);
    return image;
}

const std::string kView =
    R"(<world><camera><position x="3" y="2.5" z="5"/><lookAt x="0" y="0" z="0"/>
       <projection fov="40" near="1" far="50"/></camera><lights>
       <light type="directional" dirx="1" diry="2" dirz="1.5"/></lights>)";

}  // namespace

TEST_CASE("more samples are nearer to the exact areas") {
    const bench::Subject subject = bench::readSubject(
        kView + R"(<group><models><model file="torus_1.2_0.4.3d"/><model file="sphere_0.6.3d"/>
            <model file="box_0.5_3_0.5.3d"/></models></group></world>)",
        std::make_shared<scene::BundleAssets>());
    const bench::Exact exact = bench::exactOf(subject, 160, 120, 16);
    std::vector<bench::Errors> errors;
    for (const int samples : {1, 4, 8, 16}) {
        errors.push_back(bench::errorsOf(exact, drawn(subject, 160, 120, samples)));
        std::printf("areas: aa=%d rms %.3f, mean FLIP %.5f\n", samples, errors.back().areasRms,
                    errors.back().flipMean);
    }
    for (std::size_t i = 1; i < errors.size(); ++i) {
        CHECK(errors[i].areasRms < errors[i - 1].areasRms);
        CHECK(errors[i].flipMean < errors[0].flipMean);
    }
}

// The four samples of one pass share one evaluation of the shader, those of aa=8 and aa=16 do not.
// So where the light changes within a pixel, away from any edge, aa=4 is as wrong as aa=1, and
// aa=8 and aa=16 are within a level.
TEST_CASE("8 and 16 samples are shaded each: what changes within a pixel is averaged") {
    const bench::Subject subject = bench::readSubject(
        kView + R"(<group><models><model file="plane_40.3d"><color><diffuse R="20" G="20" B="20"/>
            <ambient R="0" G="0" B="0"/></color></model><model file="sphere_1.5.3d"><color>
            <diffuse R="40" G="40" B="40"/><specular R="255" G="255" B="255"/>
            <shininess value="2000"/></color></model></models></group></world>)",
        std::make_shared<scene::BundleAssets>());
    const bench::Exact exact = bench::exactOf(subject, 60, 45, 16);
    std::vector<double> rms;
    for (const int samples : {1, 4, 8, 16}) {
        const image::Image image = drawn(subject, 60, 45, samples);
        double squares = 0.0;
        int pixels = 0;
        for (std::size_t i = 0; i < exact.areas.color.size(); ++i) {
            if (exact.centers.id[i] == 0 || exact.centers.edge[i] != reference::kInterior) continue;
            const double off = image.pixels[4 * i] - 255.0 * exact.areas.color[i].r;
            squares += off * off;
            ++pixels;
        }
        REQUIRE(pixels > 300);
        rms.push_back(std::sqrt(squares / pixels));
        std::printf("highlight: aa=%d rms %.3f inside outlines\n", samples, rms.back());
    }
    CHECK(rms[1] == Approx(rms[0]).epsilon(0.1));
    CHECK(rms[2] < 0.5 * rms[1]);
    CHECK(rms[3] < 0.5 * rms[1]);
}

// `scripts/bench quality` measures every scene; these are quick to trace.
TEST_CASE("samples bring example scenes nearer to their exact areas by mean FLIP") {
    for (const char* name : {"primitives", "police-box", "torch", "teapots"}) {
        const bench::Subject subject = example(name);
        const bench::Exact exact = bench::exactOf(subject, 160, 120, 8);
        std::vector<double> flip;
        for (const int samples : {1, 4, 8, 16})
            flip.push_back(bench::errorsOf(exact, drawn(subject, 160, 120, samples)).flipMean);
        std::printf("%s: mean FLIP %.5f, %.5f, %.5f, %.5f at aa=1, 4, 8, 16\n", name, flip[0],
                    flip[1], flip[2], flip[3]);
        INFO(name);
        CHECK(flip[1] < flip[0]);
        CHECK(flip[2] < 0.75 * flip[1]);
        // Not below 8 samples everywhere: 8 x 8 rays a pixel are not exact enough to tell.
        CHECK(flip[3] < 0.75 * flip[1]);
        // The bar of 0.01 is for 240 x 180 px; here outlines are half as much again of the picture.
        CHECK(flip[3] < 0.0125);
    }
}
