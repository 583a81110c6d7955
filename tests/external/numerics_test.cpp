// Inputs of numbers that once broke images (../shared/data/numerics/README.md): each row is right.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "image/image.h"
#include "render/renderer.h"
#include "scene/files/assets.h"
#include "tests/support/mismatch.h"
#include "tests/support/paths.h"
#include "tests/support/skip.h"

using namespace farol;
namespace fs = std::filesystem;

namespace {

const fs::path kNumerics =
    fs::path(farol::test::kSourceDir) / ".." / "shared" / "data" / "numerics";

struct Drawn {
    image::Image image;
    render::Picture picture;

    bool warns(const std::string& code) const {
        return std::any_of(picture.diagnostics.begin(), picture.diagnostics.end(),
                           [&](const Diagnostic& one) { return one.code == code; });
    }
    glm::ivec3 at(std::size_t pixel) const {
        const std::uint8_t* p = &image.pixels[4 * pixel];
        return {p[0], p[1], p[2]};
    }
    std::size_t pixels() const { return image.pixels.size() / 4; }
    /// Pixels of a colour that is not the background's.
    std::size_t covered() const {
        std::size_t count = 0;
        for (std::size_t i = 0; i < pixels(); ++i) count += at(i) != glm::ivec3(0) ? 1 : 0;
        return count;
    }
};

std::string textOf(const char* file) {
    if (!fs::is_directory(kNumerics)) farol::test::skip("no folder ../shared/data/numerics");
    std::ifstream in(kNumerics / file, std::ios::binary);
    REQUIRE(in);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::shared_ptr<const scene::Assets> folder() {
    return std::make_shared<scene::FolderAssets>(kNumerics.string());
}

Drawn draw(const std::string& xml, int samples = 1, render::Layer layer = render::Layer::color) {
    render::Job job;
    job.xml = xml;
    job.assets = folder();
    job.options.samples = samples;
    job.options.layer = layer;
    Drawn drawn;
    drawn.picture = render::Renderer().draw(job, drawn.image);
    return drawn;
}

Drawn drawFile(const char* file, int samples = 1) { return draw(textOf(file), samples); }

}  // namespace

TEST_CASE("numbers: a house far away is the house at the origin, byte for byte") {
    for (const int samples : {1, 4}) {
        const Drawn here = drawFile("house_origin.xml", samples);
        CHECK(here.covered() > 30'000);
        CHECK(drawFile("house_utm.xml", samples).image.pixels == here.image.pixels);
    }
}

TEST_CASE("numbers: planes, spheres and nearly equal surfaces are those that rays meet") {
    struct Row {
        const char* file;
        int covered;  ///< at least so many pixels are
        /// Of pixels within 2 levels. An image of 128 px has outlines in 2 % of them, which may be
        /// 0.25 px off.
        double share = 0.999;
    };
    const Row row = GENERATE(values<Row>({{"ground.xml", 65536},
                                          {"ground_small.xml", 65536},
                                          {"ground_div2.xml", 65536},
                                          {"horizon.xml", 32000},
                                          {"horizon_small.xml", 32000},
                                          {"ix_ellipsoid2pc.xml", 50000},
                                          {"shellrot_1.001_128_3.xml", 4000, 0.998},
                                          {"sp_earth2m_tele.xml", 30000},
                                          {"spg_hz1e-06.xml", 30000},
                                          {"road.xml", 50000},
                                          {"tie_road2_0.xml", 50000},
                                          {"tie_road4_0.xml", 50000},
                                          {"near1e-10.xml", 1900},
                                          {"pl_att_q1e-37nears.xml", 30000}}));
    CAPTURE(row.file);
    const Drawn drawn = drawFile(row.file);
    CHECK(drawn.covered() >= static_cast<std::size_t>(row.covered));
    const farol::test::Mismatch mismatch = farol::test::mismatchOf(textOf(row.file), drawn.image);
    CAPTURE(mismatch.off, mismatch.insideOff, mismatch.worst, mismatch.worstX, mismatch.worstY);
    CHECK(mismatch.share() >= row.share);
    CHECK(mismatch.insideOff == 0);
}

TEST_CASE("numbers: the near plane's true bound is named") {
    const Drawn drawn = drawFile("near1e-10.xml");
    bool isNamed = false;
    for (const Diagnostic& one : drawn.picture.diagnostics) {
        UNSCOPED_INFO(one.code << ": " << one.message);
        isNamed = isNamed || one.message.find("1e-09") != std::string::npos;
    }
    CHECK(isNamed);
}

TEST_CASE("numbers: a light close above a plane gives no NaN") {
    // Its diffuse red and blue saturate: the attenuation is 2e-38 of a squared distance.
    for (const char* shading : {"phong", "gouraud", "flat"}) {
        CAPTURE(shading);
        render::Job job;
        job.xml = textOf("pl_att_q1e-37nears.xml");
        job.assets = folder();
        job.options.samples = 1;
        render::applyOption(job.options, "shading", shading);
        Drawn drawn;
        drawn.picture = render::Renderer().draw(job, drawn.image);
        CHECK(drawn.covered() > 30'000);
        std::size_t other = 0;
        for (std::size_t i = 0; i < drawn.pixels(); ++i)
            other += drawn.at(i) != glm::ivec3(0) &&
                             (drawn.at(i).r < 255 || drawn.at(i).g < 20 || drawn.at(i).b < 255)
                         ? 1
                         : 0;
        CHECK(other == 0);
    }
}

TEST_CASE("numbers: of faces in one plane the first of the document shows") {
    for (const char* file : {"road.xml", "tie_road2_0.xml", "tie_road4_0.xml"}) {
        CAPTURE(file);
        const Drawn both = draw(textOf(file), 1, render::Layer::id);
        // Where the first model is drawn alone it is drawn, with the same bytes.
        std::string first = textOf(file);
        const std::size_t end = first.find("</model>") + 8;
        first = first.substr(0, end) + "</models></group></world>";
        const Drawn alone = draw(first, 1, render::Layer::id);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < alone.pixels(); ++i)
            wrong += alone.at(i) != glm::ivec3(0) && both.at(i) != alone.at(i) ? 1 : 0;
        CHECK(wrong == 0);
        CHECK(alone.covered() > 5'000);
    }
}

TEST_CASE("numbers: texture coordinates near a million are those near 0, byte for byte") {
    std::string mesh = textOf("texoff1e+06.obj");
    for (std::size_t at = 0; (at = mesh.find("100000", at)) != std::string::npos;)
        mesh.erase(at, 6);  // 1000000 and 1000001 become 0 and 1
    render::Job job;
    job.xml = textOf("texoff1e+06.xml");
    job.assets = std::make_shared<scene::BundleAssets>(std::map<std::string, std::string>{
        {"texoff1e+06.obj", mesh}, {"texoff1e+06.png", textOf("texoff1e+06.png")}});
    job.options.samples = 1;
    image::Image near;
    render::Renderer().draw(job, near);
    const Drawn far = drawFile("texoff1e+06.xml");
    CHECK(far.image.pixels == near.pixels);
    CHECK(far.covered() > 50'000);
}

TEST_CASE("numbers: a texture wider than the GL takes is scaled down with a warning") {
    const Drawn drawn = drawFile("wide1.xml");
    CHECK(drawn.covered() > 20'000);
    CHECK(drawn.warns("image.scaled"));
}

TEST_CASE("numbers: crowds keep within the triangles of their pixels") {
    for (const char* file : {"t_scatter_close.xml", "t_teapots.xml", "t_spheres_near.xml"}) {
        CAPTURE(file);
        const Drawn drawn = drawFile(file);
        CHECK(drawn.covered() > 20'000);
        CHECK(drawn.picture.stats.triangles <= 1'000'000 + 8 * 512 * 512);
    }
}
