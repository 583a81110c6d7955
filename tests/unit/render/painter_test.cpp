#include "render/gl/painter.h"

#include <catch2/catch.hpp>
#include <cmath>

// Frames planned by hand, drawn by GL, and held against the shading model evaluated here in
// double precision (OpenGL 2.1 specification, section 2.14.1).
using namespace farol;
using render::DrawItem;
using render::EyeLight;
using render::FramePlan;
using render::Image;

namespace {

constexpr int kSide = 64;
constexpr double kDistance = 5.0;

/// A square of half-size 4 at z = -5 that faces the viewer and fills the window, in one or many
/// quads.
std::shared_ptr<render::MeshData> wall(int divisions = 1) {
    static std::uint64_t id = 1'000'000;
    auto data = std::make_shared<render::MeshData>();
    data->id = ++id;
    generator::Mesh& mesh = data->mesh;
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
    return data;
}

FramePlan frame(const std::vector<EyeLight>& lights, scene::Shading shading, int divisions = 1) {
    FramePlan plan;
    plan.width = plan.height = kSide;
    plan.shading = shading;
    plan.camera.fovDeg = 60.0;
    plan.camera.near = 1.0;
    plan.camera.far = 100.0;
    plan.lightSets = {lights};
    plan.globalAmbient = glm::vec3(0.5F);
    DrawItem item;
    item.mesh = wall(divisions);
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

Image draw(render::gl::Painter& painter, const FramePlan& plan) {
    int calls = 0;
    render::gl::Painter::Timings timings;
    Image image;
    painter.draw(
        plan,
        [](const render::TextureRef&) -> render::UndecodedTexture {
            throw std::logic_error("no texture");
        },
        image, calls, timings);
    return image;
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
    render::gl::Painter painter;
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
    render::gl::Painter painter;
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
    render::gl::Painter painter;
    const FramePlan coarse = frame({light({0.5F, 0.0F, -4.0F, 1.0F})}, scene::Shading::gouraud, 1);
    const FramePlan fine = frame({light({0.5F, 0.0F, -4.0F, 1.0F})}, scene::Shading::gouraud, 64);
    // A fine mesh comes close to per-pixel shading, a coarse one misses the light in the middle.
    CHECK(worst(fine, draw(painter, fine)) < 2.0);
    CHECK(worst(coarse, draw(painter, coarse)) > 50.0);
}

TEST_CASE("flat shading gives every face one colour, that of its middle") {
    render::gl::Painter painter;
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
    render::gl::Painter painter;
    FramePlan plan = frame({}, scene::Shading::phong);
    plan.items[0].viewFromObject[0].x = -1.0F;  // mirrored: clockwise now
    CHECK(draw(painter, plan).pixels[0] == 0);
    plan.items[0].mirrored = true;
    CHECK(draw(painter, plan).pixels[0] == 26);  // 0.2 * 0.5
}

TEST_CASE("more samples leave inner pixels alone and soften edges") {
    render::gl::Painter painter;
    FramePlan plan = frame({}, scene::Shading::phong);
    plan.items[0].viewFromObject[3].x = 4.0F + 0.03F;  // the left edge within a pixel column
    for (const int samples : {1, 2, 4, 8, 16}) {
        CAPTURE(samples);
        plan.samples = samples;
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
    render::gl::Painter painter;
    FramePlan plan = frame({}, scene::Shading::phong);
    plan.background = glm::vec4(0.0F);
    plan.samples = 4;
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
    render::gl::Painter first;
    render::gl::Painter second;
    FramePlan plan = frame({light({1.0F, 0.5F, -3.0F, 1.0F})}, scene::Shading::phong, 7);
    plan.samples = 8;
    const Image image = draw(first, plan);
    CHECK(draw(first, plan) == image);
    CHECK(draw(second, plan) == image);
}

TEST_CASE("the id layer tells items apart") {
    render::gl::Painter painter;
    FramePlan plan = frame({}, scene::Shading::phong);
    plan.layer = render::Layer::id;
    plan.items[0].id = 0x010203;
    const Image image = draw(painter, plan);
    CHECK(image.pixels[0] == 1);
    CHECK(image.pixels[1] == 2);
    CHECK(image.pixels[2] == 3);
}

TEST_CASE("the normal layer shows world normals, the depth layer near over distance") {
    render::gl::Painter painter;
    FramePlan plan = frame({}, scene::Shading::phong);
    plan.layer = render::Layer::normal;
    const Image normals = draw(painter, plan);
    CHECK(normals.pixels[2] == 255);
    CHECK(std::abs(normals.pixels[0] - 128) <= 1);
    plan.layer = render::Layer::depth;
    CHECK(draw(painter, plan).pixels[0] == 51);  // 1 / 5
}
