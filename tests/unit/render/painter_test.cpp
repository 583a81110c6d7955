#include "render/gl/painter.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "render/plan/passes.h"
#include "tests/support/lesser_context.h"
#include "tests/support/plan_scene.h"

// Frames planned by hand, drawn by GL, and held against the shading model evaluated here in
// double precision (OpenGL 2.1 specification, section 2.14.1).
using namespace farol;
using image::Image;
using render::DrawItem;
using render::EyeLight;
using render::FramePlan;
using render::gl::createContext;
using render::gl::Painter;
using support::LesserContext;

namespace {

constexpr int kSide = 64;
constexpr double kDistance = 5.0;

/// A square of half-size 4 at z = -5 that faces the viewer and fills the window, in one or many
/// quads.
std::shared_ptr<render::MeshData> wall(int divisions = 1) {
    static std::uint64_t id = 1'000'000;
    auto data = std::make_shared<render::MeshData>();
    data->id = ++id;
    generator::MeshArrays mesh;
    const auto n = static_cast<std::uint32_t>(divisions);
    for (std::uint32_t j = 0; j <= n; ++j)
        for (std::uint32_t i = 0; i <= n; ++i) {
            const glm::vec2 uv(static_cast<float>(i) / static_cast<float>(n),
                               static_cast<float>(j) / static_cast<float>(n));
            mesh.positions.emplace_back((uv * 2.0F - 1.0F) * 4.0F, 0.0F);
            mesh.normals.emplace_back(0.0F, 0.0F, 1.0F);
            mesh.uvs.push_back(uv);
        }
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t a = j * (n + 1) + i;
            for (const std::uint32_t index : {a, a + 1, a + n + 1, a + 1, a + n + 2, a + n + 1})
                mesh.indices.push_back(index);
        }
    data->mesh = generator::Mesh(std::move(mesh));
    return data;
}

FramePlan frame(const std::vector<EyeLight>& lights, scene::Shading shading, int divisions = 1) {
    FramePlan plan;
    plan.style.shading = shading;
    plan.camera.fovDeg = 60.0;
    plan.camera.near = 1.0;
    plan.camera.far = 100.0;
    plan.view = render::viewOf(plan.camera, glm::ivec2(kSide));
    plan.lightSets = {lights};
    plan.globalAmbient = glm::vec3(0.5F);
    DrawItem item;
    item.mesh = wall(divisions);
    item.indices = item.mesh->mesh.indices().size();
    item.viewFromObject[3] = glm::vec4(0.0F, 0.0F, -kDistance, 1.0F);
    item.diffuse = glm::vec3(0.8F, 0.4F, 0.2F);
    item.ambient = glm::vec3(0.2F, 0.1F, 0.05F);
    item.specular = glm::vec3(0.0F);
    item.id = 1;
    plan.items.push_back(item);
    return plan;
}

EyeLight light(const glm::vec4& position) {
    EyeLight one{};
    one.position = position;
    one.spot = glm::vec4(0, 0, -1, -2);
    one.attenuation = glm::vec4(1, 0, 0, 0);
    one.diffuse = one.specular = glm::vec4(1.0F);
    return one;
}

/// Draws a plan's own passes.
Image drawPasses(Painter& painter, FramePlan plan) {
    Painter::Timings timings;
    Image image;
    Diagnostics warnings;
    painter.draw(
        plan,
        [](const render::TextureRef&) -> render::UndecodedTexture {
            throw std::logic_error("no texture");
        },
        image, timings, warnings);
    return image;
}

/// Draws a plan by the passes that its style asks for.
Image draw(Painter& painter, FramePlan plan) {
    render::composePasses(plan, painter.facts());
    return drawPasses(painter, plan);
}

/// Where the ray of a pixel's centre meets the wall.
glm::dvec3 pointAt(int x, int y) {
    const double t = std::tan(glm::radians(30.0));
    return {((x + 0.5) / kSide * 2.0 - 1.0) * t * kDistance,
            (1.0 - (y + 0.5) / kSide * 2.0) * t * kDistance, -kDistance};
}

/// The model of section 2.14.1, infinite viewer, for a normal of +Z.
glm::dvec3 expected(const FramePlan& plan, const glm::dvec3& point) {
    const DrawItem& item = plan.items[0];
    glm::dvec3 sum =
        glm::dvec3(item.emissive) + glm::dvec3(item.ambient) * glm::dvec3(plan.globalAmbient);
    for (const EyeLight& one : plan.lightSets[0]) {
        glm::dvec3 to(one.position);
        double strength = 1.0;
        if (one.position.w != 0.0F) {
            to -= point;
            const double d = glm::length(to);
            to /= d;
            strength =
                1.0 / (one.attenuation.x + one.attenuation.y * d + one.attenuation.z * d * d);
            if (one.spot.w > -2.0F) {
                const double cosine = -glm::dot(to, glm::dvec3(one.spot));
                strength *= cosine < one.spot.w ? 0.0 : std::pow(cosine, one.attenuation.w);
            }
        }
        const double lambert = std::max(to.z, 0.0);
        sum += strength * (glm::dvec3(item.ambient) * glm::dvec3(one.ambient) +
                           lambert * glm::dvec3(item.diffuse) * glm::dvec3(one.diffuse));
        if (lambert > 0.0) {
            const glm::dvec3 half = glm::normalize(to + glm::dvec3(0, 0, 1));
            sum += strength * std::pow(std::max(half.z, 0.0), double{item.shininess}) *
                   glm::dvec3(item.specular) * glm::dvec3(one.specular);
        }
    }
    return glm::clamp(sum, 0.0, 1.0);
}

double worst(const FramePlan& plan, const Image& image, double edge = 0.0) {
    double most = 0.0;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const glm::dvec3 point = pointAt(x, y);
            if (edge > 0.0) {  // a spot's rim falls between pixels
                const EyeLight& spot = plan.lightSets[0][0];
                const glm::dvec3 to = glm::normalize(glm::dvec3(spot.position) - point);
                if (std::abs(-glm::dot(to, glm::dvec3(spot.spot)) - spot.spot.w) < edge) continue;
            }
            const glm::dvec3 want = expected(plan, point) * 255.0;
            const std::size_t at = static_cast<std::size_t>(y * kSide + x) * 4;
            for (int c = 0; c < 3; ++c)
                most = std::max(most,
                                std::abs(want[c] - image.pixels[at + static_cast<std::size_t>(c)]));
        }
    return most;
}

}  // namespace

TEST_CASE("phong shading is the specification's, pixel by pixel") {
    Painter painter(createContext(render::GlSource::automatic));
    FramePlan plan;
    SECTION("no light: emission and global ambient") {
        plan = frame({}, scene::Shading::phong);
        plan.items[0].emissive = glm::vec3(0.1F, 0.0F, 0.3F);
    }
    SECTION("directional, oblique") {
        plan = frame({light({0.6F, 0.0F, 0.8F, 0.0F})}, scene::Shading::phong);
    }
    SECTION("directional from behind lights nothing") {
        plan = frame({light({0.0F, 0.6F, -0.8F, 0.0F})}, scene::Shading::phong);
        plan.items[0].specular = glm::vec3(1.0F);
    }
    SECTION("point with attenuation and ambient") {
        EyeLight one = light({1.0F, 0.5F, -3.0F, 1.0F});
        one.attenuation = glm::vec4(0.5F, 0.2F, 0.1F, 0.0F);
        one.ambient = glm::vec4(0.3F);
        plan = frame({one}, scene::Shading::phong);
    }
    SECTION("specular, infinite viewer, shininess above GL's 128 too") {
        const float shininess = GENERATE(0.0F, 1.0F, 30.0F, 300.0F);
        plan = frame({light({1.0F, 0.0F, -2.0F, 1.0F})}, scene::Shading::phong);
        plan.items[0].specular = glm::vec3(0.4F, 0.3F, 0.2F);
        plan.items[0].shininess = shininess;
    }
    SECTION("three lights add up and are clamped") {
        plan = frame({light({0, 0, 1, 0}), light({0.8F, 0, 0.6F, 0}), light({0, 1, -4, 1})},
                     scene::Shading::phong);
    }
    // Rounding to eight bits, and float against double: less than one level.
    CHECK(worst(plan, draw(painter, plan)) < 0.75);
}

TEST_CASE("a spot lights its cone and falls off within it") {
    Painter painter(createContext(render::GlSource::automatic));
    const float exponent = GENERATE(0.0F, 8.0F);
    EyeLight one = light({0.0F, 0.0F, -2.0F, 1.0F});
    one.spot = glm::vec4(0.0F, 0.0F, -1.0F, std::cos(glm::radians(25.0F)));
    one.attenuation.w = exponent;
    const FramePlan plan = frame({one}, scene::Shading::phong);
    const Image image = draw(painter, plan);
    CHECK(worst(plan, image, 1e-4) < 0.75);
    CHECK(image.pixels[(32 * kSide + 32) * 4] > image.pixels[4]);  // middle against corner
}

TEST_CASE("gouraud is exact at vertices and linear between them") {
    Painter painter(createContext(render::GlSource::automatic));
    const FramePlan coarse = frame({light({0.5F, 0.0F, -4.0F, 1.0F})}, scene::Shading::gouraud, 1);
    const FramePlan fine = frame({light({0.5F, 0.0F, -4.0F, 1.0F})}, scene::Shading::gouraud, 64);
    // A fine mesh comes close to per-pixel shading, a coarse one misses the light in the middle.
    CHECK(worst(fine, draw(painter, fine)) < 2.0);
    CHECK(worst(coarse, draw(painter, coarse)) > 50.0);
}

TEST_CASE("flat shading gives every face one colour, that of its middle") {
    Painter painter(createContext(render::GlSource::automatic));
    const FramePlan plan = frame({light({0.5F, 0.0F, -4.0F, 1.0F})}, scene::Shading::flat, 1);
    const Image image = draw(painter, plan);
    // Two triangles: lower left and upper right of the diagonal from top left to bottom right.
    for (const auto& [x, y, centroid] :
         {std::tuple{8, 40, glm::dvec3(-4.0 / 3, -4.0 / 3, -kDistance)},
          std::tuple{56, 24, glm::dvec3(4.0 / 3, 4.0 / 3, -kDistance)}}) {
        const glm::dvec3 want = expected(plan, centroid) * 255.0;
        for (int c = 0; c < 3; ++c)
            CHECK(image.pixels[static_cast<std::size_t>((y * kSide + x) * 4 + c)] ==
                  Approx(want[c]).margin(0.75));
    }
}

TEST_CASE("faces seen from behind are culled, mirrored objects are not") {
    Painter painter(createContext(render::GlSource::automatic));
    FramePlan plan = frame({}, scene::Shading::phong);
    plan.items[0].viewFromObject[0].x = -1.0F;  // mirrored: clockwise now
    CHECK(draw(painter, plan).pixels[0] == 0);
    plan.items[0].mirrored = true;
    CHECK(draw(painter, plan).pixels[0] == 26);  // 0.2 * 0.5
}

TEST_CASE("more samples leave inner pixels alone and soften edges") {
    Painter painter(createContext(render::GlSource::automatic));
    FramePlan plan = frame({}, scene::Shading::phong);
    plan.items[0].viewFromObject[3].x = 4.0F + 0.03F;  // the left edge within a pixel column
    for (const int samples : {1, 2, 4, 8, 16}) {
        CAPTURE(samples);
        plan.style.samples = samples;
        const Image image = draw(painter, plan);
        CHECK(image.pixels[(10 * kSide + 60) * 4] == 26);
        CHECK(image.pixels[(10 * kSide + 5) * 4] == 0);
        const int edge = image.pixels[(10 * kSide + 32) * 4];
        if (samples == 1)
            CHECK((edge == 0 || edge == 26));
        else
            CHECK((edge > 4 && edge < 24));
    }
}

TEST_CASE("a transparent background keeps straight alpha") {
    Painter painter(createContext(render::GlSource::automatic));
    FramePlan plan = frame({}, scene::Shading::phong);
    plan.style.background = glm::vec4(0.0F);
    plan.style.samples = 4;
    plan.items[0].viewFromObject[3].x = 4.0F + 0.03F;
    const Image image = draw(painter, plan);
    CHECK(image.pixels[(10 * kSide + 5) * 4 + 3] == 0);
    CHECK(image.pixels[(10 * kSide + 60) * 4 + 3] == 255);
    const std::size_t edge = (10 * kSide + 32) * 4;
    REQUIRE(image.pixels[edge + 3] > 0);
    REQUIRE(image.pixels[edge + 3] < 255);
    CHECK(std::abs(image.pixels[edge] - 26) <= 1);  // the colour itself is not darkened
}

TEST_CASE("the same plan gives the same bytes, in one painter and in two") {
    Painter first(createContext(render::GlSource::automatic));
    Painter second(createContext(render::GlSource::automatic));
    FramePlan plan = frame({light({1.0F, 0.5F, -3.0F, 1.0F})}, scene::Shading::phong, 7);
    plan.style.samples = 8;
    const Image image = draw(first, plan);
    CHECK(draw(first, plan) == image);
    CHECK(draw(second, plan) == image);
}

TEST_CASE("the id layer tells items apart") {
    Painter painter(createContext(render::GlSource::automatic));
    FramePlan plan = frame({}, scene::Shading::phong);
    plan.style.layer = render::Layer::id;
    plan.items[0].id = 0x010203;
    const Image image = draw(painter, plan);
    CHECK(image.pixels[0] == 1);
    CHECK(image.pixels[1] == 2);
    CHECK(image.pixels[2] == 3);
}

TEST_CASE("the normal layer shows world normals, the depth layer near over distance") {
    Painter painter(createContext(render::GlSource::automatic));
    FramePlan plan = frame({}, scene::Shading::phong);
    plan.style.layer = render::Layer::normal;
    const Image normals = draw(painter, plan);
    CHECK(normals.pixels[2] == 255);
    CHECK(std::abs(normals.pixels[0] - 128) <= 1);
    plan.style.layer = render::Layer::depth;
    CHECK(draw(painter, plan).pixels[0] == 51);  // 1 / 5
}

TEST_CASE("passes are drawn in their order, each by its own state and features") {
    Painter painter(createContext(render::GlSource::automatic));
    FramePlan plan = frame({}, scene::Shading::phong);
    plan.items[0].viewFromObject[3].x = 4.0F;  // the right half
    plan.items.push_back(plan.items[0]);
    plan.items[1].viewFromObject[3] = glm::vec4(0.0F, 4.0F, -2.0F * kDistance, 1.0F);  // behind
    plan.items[1].id = 0x0000FF;
    render::composePasses(plan, painter.facts());
    REQUIRE(plan.passes.size() == 1);
    REQUIRE(plan.passes[0].items.size() == 1);
    REQUIRE(plan.batches.batches.size() == 2);
    const auto at = [](const Image& image, int x, int y) {
        const std::uint8_t* pixel = &image.pixels[static_cast<std::size_t>(y * kSide + x) * 4];
        return glm::ivec3(pixel[0], pixel[1], pixel[2]);
    };
    const Image both = drawPasses(painter, plan);
    const glm::ivec3 lit = at(both, 60, 60);
    CHECK(lit == glm::ivec3(26, 13, 6));  // ambient times 0.5

    // The second model apart, over everything, in another colour.
    render::Pass over = plan.passes[0];
    plan.passes[0].items[0].count = 1;
    plan.passes[0].target.output = render::PassOutput::none;
    over.target.clearColor.reset();
    over.target.clearDepth = false;
    over.state.depthTest = false;
    over.items[0].first = 1;
    over.items[0].count = 1;
    over.features = {render::Feature::lightCount, render::Feature::layerId};
    over.itemFeatures = {};
    plan.batches.batches[1].plainColor = glm::vec3(0.0F, 0.0F, 1.0F);
    plan.passes.push_back(over);
    const Image two = drawPasses(painter, plan);
    CHECK(at(two, 60, 60) == lit);                    // the first pass's pixels stay
    CHECK(at(two, 44, 10) == glm::ivec3(0, 0, 255));  // before the first model, though behind it
    CHECK(at(both, 44, 10) == lit);
    CHECK(at(two, 4, 60) == glm::ivec3(0));
}

TEST_CASE("a pass that fills the depth alone hides what is behind it from the next") {
    Painter painter(createContext(render::GlSource::automatic));
    FramePlan plan = frame({light({1.0F, 0.5F, -3.0F, 1.0F})}, scene::Shading::phong, 7);
    plan.style.samples = 4;
    render::composePasses(plan, painter.facts());
    const Image image = drawPasses(painter, plan);
    // It hides everything behind it, and shows nothing itself: a wall before the right half.
    plan.items.push_back(plan.items[0]);
    plan.items[1].viewFromObject[3] = glm::vec4(4.0F, 0.0F, -2.5F, 1.0F);
    render::composePasses(plan, painter.facts());
    REQUIRE(plan.batches.batches.size() == 2);
    plan.passes.insert(plan.passes.begin(), plan.passes[0]);
    plan.passes[0].items[0] = {render::PassItem::Kind::models, 1, 1, -1};
    plan.passes[0].features = {render::Feature::lightCount, render::Feature::layerId};
    plan.passes[0].itemFeatures = {};
    plan.passes[0].target.output = render::PassOutput::none;
    plan.passes[1].items[0] = {render::PassItem::Kind::models, 0, 1, -1};
    plan.passes[1].target.clearDepth = false;  // its colour is cleared
    const Image hidden = drawPasses(painter, plan);
    for (int y = 0; y < kSide; y += 9) {
        const std::size_t left = static_cast<std::size_t>(y * kSide + 2) * 4;
        const std::size_t right = static_cast<std::size_t>(y * kSide + kSide - 3) * 4;
        CHECK(hidden.pixels[left] == image.pixels[left]);
        CHECK(hidden.pixels[right] == 0);
        CHECK(image.pixels[right] > 0);
    }
}

TEST_CASE("a backend that is not there is named, the one that is says what it can do") {
    if (access("/dev/dri", F_OK) != 0)
        CHECK_THROWS_WITH(createContext(render::GlSource::eglGpu), Catch::Contains("egl:gpu"));
    const auto context = createContext(render::GlSource::automatic);
    const render::GlFacts& gl = context->facts();
    // Tests plan with the limits of this GL.
    const render::GlFacts usual = support::fourSamples();
    CHECK(gl.samplePatterns == usual.samplePatterns);
    CHECK(gl.snapPx == usual.snapPx);
    CHECK(gl.maxTargetSide >= render::kMaxSide);
    CHECK(gl.maxTextureSide >= render::kMaxSide);
    CHECK(gl.maxFaceSide >= render::kMaxFaceSide);
    CHECK(gl.maxAnisotropy >= 2.0F);
    CHECK(gl.version.find("4.5") == 0);
    CHECK(gl.description() == gl.renderer + ", " + gl.version);
}

TEST_CASE("without an extension for it, rows are turned over after reading") {
    Painter painter(createContext(render::GlSource::automatic));
    Painter plain(
        std::make_unique<LesserContext>([](render::GlFacts& gl) { gl.packInvert = false; }));
    REQUIRE(painter.facts().packInvert);
    FramePlan plan = frame({light({1.0F, 0.5F, -3.0F, 1.0F})}, scene::Shading::phong, 7);
    for (const int samples : {1, 4, 8}) {
        plan.style.samples = samples;
        CHECK(draw(plain, plan) == draw(painter, plan));
    }
}

TEST_CASE("without multisampling targets are larger, and the picture about the same") {
    Painter painter(createContext(render::GlSource::automatic));
    Painter single(
        std::make_unique<LesserContext>([](render::GlFacts& gl) { gl.samplePatterns.clear(); }));
    FramePlan plan = frame({}, scene::Shading::phong);
    plan.items[0].viewFromObject[3].x = 4.0F + 0.03F;
    plan.style.samples = 16;
    render::composePasses(plan, single.facts());
    CHECK(plan.passes.size() == 2);
    CHECK(drawPasses(single, plan) == draw(painter, plan));
    plan.style.samples = 4;
    render::composePasses(plan, single.facts());
    CHECK(plan.passes.at(0).target.scale == 2);
    const Image four = drawPasses(single, plan), usual = draw(painter, plan);
    for (std::size_t i = 0; i < usual.pixels.size(); ++i)
        REQUIRE(std::abs(usual.pixels[i] - four.pixels[i]) <= 64);
}

TEST_CASE("a planted NaN or infinity is magenta where it is asked for, and nothing else is") {
    Painter painter(createContext(render::GlSource::automatic));
    const scene::Shading shading =
        GENERATE(scene::Shading::phong, scene::Shading::gouraud, scene::Shading::flat);
    FramePlan plan = frame({light({0.6F, 0.0F, 0.8F, 0.0F})}, shading);
    plan.style.marksNotFinite = true;
    plan.items[0].specular = glm::vec3(0.1F);
    const auto marked = [&] {
        const Image image = draw(painter, plan);
        std::size_t count = 0;
        for (std::size_t i = 0; i < image.pixels.size(); i += 4)
            count +=
                image.pixels[i] == 255 && image.pixels[i + 1] == 0 && image.pixels[i + 2] == 255
                    ? 1
                    : 0;
        return count;
    };
    CHECK(marked() == 0);
    const float value =
        GENERATE(std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity());
    SECTION("of the material's light") { plan.items[0].emissive.g = value; }
    SECTION("of its reflection") { plan.items[0].diffuse.r = value; }
    SECTION("of its highlight") { plan.items[0].specular.b = value; }
    SECTION("of a light") { plan.lightSets[0][0].diffuse.b = value; }
    CHECK(marked() == static_cast<std::size_t>(kSide) * kSide);
    plan.style.marksNotFinite = false;
    CHECK(marked() == 0);
}
