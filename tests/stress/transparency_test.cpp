#include <algorithm>
#include <catch2/catch.hpp>

#include "image/format.h"
#include "tests/stress/draw.h"

// Rows of the stress list about what is seen through. tests/accuracy compares such scenes with the
// ray caster.
using namespace farol;
using namespace farol::stress;
using scene::Transparency;

namespace {

struct Drawn {
    image::Image image;
    render::Picture picture;

    bool has(const std::string& code) const {
        return std::any_of(picture.diagnostics.begin(), picture.diagnostics.end(),
                           [&](const Diagnostic& one) { return one.code == code; });
    }
};

std::string plain(const glm::ivec4& color, int side = 4) {
    image::Image image{side, side, {}};
    for (int i = 0; i < side * side; ++i)
        for (int c = 0; c < 4; ++c) image.pixels.push_back(static_cast<std::uint8_t>(color[c]));
    return image::encodePng(image);
}

Drawn drawScene(const std::string& xml, const std::map<std::string, std::string>& files = {},
                render::PictureOptions options = {}) {
    render::Job job;
    job.xml = xml;
    job.assets = std::make_shared<scene::BundleAssets>(files);
    job.options = options;
    job.options.width = job.options.height = 64;
    if (!job.options.samples) job.options.samples = 1;
    Drawn drawn;
    drawn.picture = render::Renderer().draw(job, drawn.image);
    return drawn;
}

/// A pane across the view at z, seen from z = 3, that shines in one colour.
std::string pane(double z, const std::string& color, double opacity) {
    return "<group><transform><translate z=\"" + std::to_string(z) +
           "\"/></transform><group><transform><rotate angle=\"90\" x=\"1\"/></transform><models>"
           "<model command=\"plane 4\" opacity=\"" +
           std::to_string(opacity) +
           "\"><color><diffuse R=\"0\" G=\"0\" B=\"0\"/><ambient R=\"0\" "
           "G=\"0\" B=\"0\"/><emissive " +
           color + "/></color></model></models></group></group>";
}

std::string seenFrom3(const std::string& content) {
    return "<world><camera><position x=\"0\" y=\"0\" z=\"3\"/><lookAt x=\"0\" y=\"0\" z=\"0\"/>"
           "<projection fov=\"40\" near=\"0.1\" far=\"50\"/></camera>" +
           std::string(kSun) + content + "</world>";
}

constexpr const char* kWhite = R"(R="255" G="255" B="255")";
constexpr const char* kRed = R"(R="255" G="0" B="0")";
constexpr const char* kBlue = R"(R="0" G="0" B="255")";

bool isNear(const glm::ivec3& a, const glm::ivec3& b) {
    const glm::ivec3 off = glm::abs(a - b);
    return std::max({off.r, off.g, off.b}) <= 1;
}

const Transparency kDrawn[] = {Transparency::on, Transparency::exact};

render::PictureOptions with(Transparency transparency, int samples = 1) {
    render::PictureOptions options;
    options.transparency = transparency;
    options.samples = samples;
    return options;
}

}  // namespace

TEST_CASE("a pane lets a skybox, a picture and a clear background through") {
    for (const Transparency mode : kDrawn)
        for (const int samples : {1, 4, 8}) {
            CAPTURE(samples);
            image::Image cross{32, 24, {}};
            for (int i = 0; i < 32 * 24; ++i)
                for (const int value : {40, 90, 200, 255})
                    cross.pixels.push_back(static_cast<std::uint8_t>(value));
            const Drawn sky =
                drawScene(seenFrom3(pane(0, kWhite, 0.4) + R"(<skybox texture="sky.png"/>)"),
                          {{"sky.png", image::encodePng(cross)}}, with(mode, samples));
            CHECK(isNear(pixel(sky.image, 32, 32), {126, 156, 222}));
            const Drawn picture =
                drawScene(seenFrom3(pane(0, kWhite, 0.4) + R"(<background texture="b.png"/>)"),
                          {{"b.png", plain({40, 90, 200, 255})}}, with(mode, samples));
            CHECK(isNear(pixel(picture.image, 32, 32), {126, 156, 222}));
            render::PictureOptions clear = with(mode, samples);
            clear.background = "transparent";
            const Drawn nothing = drawScene(seenFrom3(pane(0, kRed, 0.4)), {}, clear);
            const std::size_t middle = 4 * (32 * 64 + 32);
            CHECK(isNear(pixel(nothing.image, 32, 32), {255, 0, 0}));
            CHECK(std::abs(int{nothing.image.pixels[middle + 3]} - 102) <= 1);
        }
}

TEST_CASE(
    "of coplanar panes the first of the document is in front, whatever their order in depth") {
    for (const Transparency mode : kDrawn)
        for (const int samples : {1, 4}) {
            const Drawn same = drawScene(seenFrom3(pane(0, kRed, 0.5) + pane(0, kBlue, 0.5)), {},
                                         with(mode, samples));
            CHECK(isNear(pixel(same.image, 32, 32), {128, 0, 64}));
            const Drawn apart = drawScene(seenFrom3(pane(0, kRed, 0.5) + pane(1, kBlue, 0.5)), {},
                                          with(mode, samples));
            CHECK(isNear(pixel(apart.image, 32, 32), {64, 0, 128}));
        }
}

TEST_CASE("an opaque model hides the panes behind it and shows through those before it") {
    for (const Transparency mode : kDrawn)
        for (const int samples : {1, 4}) {
            const Drawn drawn = drawScene(
                seenFrom3(pane(0.5, kRed, 0.5) + pane(0, kBlue, 1.0) + pane(-0.5, kWhite, 0.9)), {},
                with(mode, samples));
            CHECK(isNear(pixel(drawn.image, 32, 32), {128, 0, 128}));
            CHECK(drawn.picture.stats.blended == 2);
            CHECK(drawn.picture.stats.peeledLayers == (mode == Transparency::exact ? 1 : 0));
        }
}

TEST_CASE("layers show the nearest surface that is at least half opaque") {
    const std::string panes = pane(1, kWhite, 0.3) + pane(0, kRed, 0.7) + pane(-1, kBlue, 1.0);
    for (const Transparency mode : kDrawn) {
        render::PictureOptions options = with(mode);
        options.layer = render::Layer::id;
        CHECK(pixel(drawScene(seenFrom3(panes), {}, options).image, 32, 32) == glm::ivec3(0, 0, 2));
        options.layer = render::Layer::depth;
        const int depth = pixel(drawScene(seenFrom3(panes), {}, options).image, 32, 32).r;
        CHECK(depth ==
              pixel(drawScene(seenFrom3(pane(0, kRed, 1.0)), {}, options).image, 32, 32).r);
    }
    render::PictureOptions off = with(Transparency::off);
    off.layer = render::Layer::id;
    CHECK(pixel(drawScene(seenFrom3(panes), {}, off).image, 32, 32) == glm::ivec3(0, 0, 1));
    // A card with a clear left half.
    image::Image card{16, 16, {}};
    for (int i = 0; i < 256; ++i)
        for (const int value : {255, 255, 255, i % 16 < 8 ? 0 : 255})
            card.pixels.push_back(static_cast<std::uint8_t>(value));
    const std::string model =
        R"(<group><transform><rotate angle="90" x="1"/></transform><models><model command="plane 4">
           <texture file="card.png"/></model></models></group>)" +
        pane(-1, kBlue, 1.0);
    for (const render::Layer layer : {render::Layer::id, render::Layer::color}) {
        render::PictureOptions options = with(Transparency::on);
        options.layer = layer;
        const Drawn drawn =
            drawScene(seenFrom3(model), {{"card.png", image::encodePng(card)}}, options);
        CHECK(pixel(drawn.image, 16, 32) ==
              (layer == render::Layer::id ? glm::ivec3(0, 0, 2) : glm::ivec3(0, 0, 255)));
        CHECK(pixel(drawn.image, 48, 32) != pixel(drawn.image, 16, 32));
        CHECK(drawn.picture.stats.cutOut == 1);
    }
}

TEST_CASE("a hundred panes are added up; of sorted surfaces the nearest 64, with a warning") {
    std::string panes;
    for (int i = 0; i < 100; ++i) panes += pane(-0.05 * i, i % 2 ? kRed : kBlue, 0.02);
    const Drawn sorted = drawScene(seenFrom3(panes), {}, with(Transparency::on));
    CHECK_FALSE(sorted.has("limit.layers"));
    const Drawn peeled = drawScene(seenFrom3(panes), {}, with(Transparency::exact));
    REQUIRE(peeled.has("limit.layers"));
    CHECK_THAT(peeled.picture.diagnostics.back().message,
               Catch::Contains("about 100") && Catch::Contains("nearest 64") &&
                   Catch::Contains("transparency=\"on\""));
    CHECK(peeled.picture.stats.peeledLayers == 64);
    // The sum of a geometric series, of 64 panes.
    double red = 0.0, blue = 0.0, left = 1.0;
    for (int i = 0; i < 64; ++i, left *= 0.98) (i % 2 ? red : blue) += 255.0 * 0.02 * left;
    CHECK(isNear(pixel(peeled.image, 32, 32), glm::ivec3(glm::round(glm::dvec3(red, 0, blue)))));
}

TEST_CASE("switched off, what is seen through is opaque, with an info") {
    const std::string two =
        R"(<model command="plane 2"><texture file="red.png"/></model>
           <model command="plane 2"><texture file="blue.png"/></model>)";
    const auto drawn = [&](int alpha, Transparency mode) {
        return drawScene(
            world(two),
            {{"red.png", plain({255, 0, 0, alpha})}, {"blue.png", plain({0, 0, 255, alpha})}},
            with(mode, 4));
    };
    const Drawn opaque = drawn(255, Transparency::on);
    CHECK(pixel(opaque.image, 32, 40).r > 50);
    CHECK_FALSE(opaque.has("image.alpha"));
    for (std::size_t i = 2; i < opaque.image.pixels.size(); i += 4)
        CHECK_FALSE(opaque.image.pixels[i] > 0);
    CHECK(drawn(127, Transparency::off).image.pixels == opaque.image.pixels);
    CHECK(drawn(127, Transparency::off).has("image.alpha"));
    CHECK(drawn(127, Transparency::on).image.pixels != opaque.image.pixels);
    // An alpha of 0 everywhere was left unset by its writer.
    CHECK(drawn(0, Transparency::on).image.pixels == opaque.image.pixels);
    CHECK(drawn(0, Transparency::on).has("image.alpha"));
    const std::string glass = pane(0, kRed, 0.5);
    CHECK(drawScene(seenFrom3(glass), {}, with(Transparency::off)).has("scene.opacity"));
    CHECK(isNear(pixel(drawScene(seenFrom3(glass), {}, with(Transparency::off)).image, 32, 32),
                 {255, 0, 0}));
}

TEST_CASE("a scene without opacity and alpha has the same bytes on, off and exact") {
    for (const int samples : {1, 4, 8}) {
        const Drawn on = drawScene(still(0.0), {}, with(Transparency::on, samples));
        CHECK(covered(on.image) > 500);
        CHECK(drawScene(still(0.0), {}, with(Transparency::off, samples)).image == on.image);
        CHECK(drawScene(still(0.0), {}, with(Transparency::exact, samples)).image == on.image);
    }
}

TEST_CASE("what is seen through does not depend on how it is batched") {
    std::string panes;
    for (int i = 0; i < 30; ++i) panes += pane(0.03 * ((7 * i) % 30), kRed, 0.1);
    for (const Transparency mode : kDrawn) {
        render::Job job;
        job.xml = seenFrom3(panes);
        job.assets = std::make_shared<scene::BundleAssets>();
        job.options = with(mode, 4);
        job.options.width = job.options.height = 64;
        image::Image merged, apart;
        render::Renderer renderer;
        renderer.draw(job, merged);
        job.drawUnseen = true;
        renderer.draw(job, apart);
        CHECK(merged == apart);
    }
}
