#include "render/plan/plan.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "render/plan/crowd.h"
#include "tests/support/plan_scene.h"

using namespace farol;
using render::FramePlan;
using render::PictureOptions;

namespace {

scene::Model sphere() {
    scene::Model model;
    model.source.kind = scene::ModelSource::Kind::shape;
    model.source.shape = generator::parseCall({"sphere", "1", "8", "8"});
    return model;
}

scene::Scene sceneAt(const std::vector<glm::dvec3>& places) {
    scene::Scene scene;
    scene.camera = scene::Camera{};
    scene.camera->eye = glm::dvec3(0, 0, 10);
    for (const glm::dvec3& place : places) {
        scene::Group& group = scene.groups.emplace_back();
        group.transforms.push_back(scene::Translate{place});
        group.models.push_back(sphere());
    }
    return scene;
}

FramePlan planOf(const scene::Scene& scene, const PictureOptions& options = {}) {
    render::MeshLibrary meshes(1 << 20);
    return support::planScene(scene, options, scene::BundleAssets(), meshes);
}

}  // namespace

TEST_CASE("what is outside the view is not drawn, what straddles its border is") {
    // At distance 10 and 60 degrees the half width of the view is 5.77.
    const FramePlan plan = planOf(sceneAt({{0, 0, 0},
                                           {6.5, 0, 0},     // straddles
                                           {20, 0, 0},      // right of it
                                           {0, -20, 0},     // below
                                           {0, 0, 12},      // behind the eye
                                           {0, 0, -995},    // beyond far
                                           {0, 0, -989.5},  // straddles far
                                           {0, 0, 9}}));    // straddles near
    CHECK(plan.items.size() == 4);
    CHECK(plan.stats.culled == 4);
    CHECK(plan.stats.instances == 8);
}

TEST_CASE("culling never drops a model of which a point is in view") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-30.0, 30.0);
    std::uniform_real_distribution<double> size(0.01, 20.0);
    int inView = 0;
    for (int i = 0; i < 2000; ++i) {
        scene::Scene scene = sceneAt({{place(random), place(random), place(random)}});
        scene.groups[0].transforms.push_back(
            scene::Scale{{size(random), size(random), size(random)}});
        const FramePlan plan = planOf(scene);
        // Every vertex of the mesh, put through the camera in double.
        bool visible = false;
        const auto* move = std::get_if<scene::Translate>(&scene.groups[0].transforms[0]);
        const auto* scale = std::get_if<scene::Scale>(&scene.groups[0].transforms[1]);
        render::MeshLibrary meshes(1 << 20);
        for (const glm::vec3& vertex :
             meshes.get(sphere(), scene::BundleAssets())->mesh.positions()) {
            const glm::dvec3 p =
                glm::dvec3(vertex) * scale->factors + move->offset - scene.camera->eye;
            const double reach = -p.z * std::tan(glm::radians(30.0));
            visible |=
                -p.z > 1.0 && -p.z < 1000.0 && std::abs(p.x) < reach && std::abs(p.y) < reach;
        }
        inView += visible ? 1 : 0;
        if (visible) REQUIRE(plan.items.size() == 1);
    }
    CHECK(inView > 200);  // the test has something to say
}

TEST_CASE("the error asked for chooses the samples, unless they are asked for") {
    const scene::Scene scene = sceneAt({{0, 0, 0}});
    PictureOptions options;
    CHECK(planOf(scene, options).style.samples == 4);
    for (const auto& [errorPx, samples] :
         {std::pair{4.0, 1}, {2.0, 4}, {0.5, 4}, {0.1, 8}, {0.05, 16}, {0.01, 16}}) {
        options.errorPx = errorPx;
        CHECK(planOf(scene, options).style.samples == samples);
    }
    options.samples = 2;
    CHECK(planOf(scene, options).style.samples == 2);
}

TEST_CASE("shading is chosen by what the scene holds") {
    scene::Scene scene = sceneAt({{0, 0, 0}});
    CHECK(planOf(scene).style.shading == scene::Shading::wireframe);
    scene.groups[0].models[0].material = scene::Material{};
    CHECK(planOf(scene).style.shading == scene::Shading::solid);
    scene.lights.emplace_back();
    CHECK(planOf(scene).style.shading == scene::Shading::phong);
    CHECK(planOf(scene).style.lit);
    scene.settings.shading = scene::Shading::flat;
    CHECK(planOf(scene).style.shading == scene::Shading::flat);
    PictureOptions options;
    options.shading = scene::Shading::gouraud;
    CHECK(planOf(scene, options).style.shading == scene::Shading::gouraud);
}

TEST_CASE("normals stay perpendicular under any scale, also mirrored and flattened") {
    const glm::dvec3 factors =
        GENERATE(glm::dvec3(1, 2, 3), glm::dvec3(-1, 1, 1), glm::dvec3(-2, -3, 1),
                 glm::dvec3(-1, -1, -1), glm::dvec3(1, 0, 1), glm::dvec3(1e-9, 1, 1e9));
    scene::Scene scene = sceneAt({{0, 0, 0}});
    scene.groups[0].transforms.push_back(scene::Scale{factors});
    const FramePlan plan = planOf(scene);
    REQUIRE(plan.items.size() == 1);
    const render::DrawItem& item = plan.items[0];
    CHECK(item.mirrored == (factors.x * factors.y * factors.z < 0));
    const glm::mat3 linear(item.viewFromObject);
    // Two tangents and their normal, at a point of a sphere.
    const glm::vec3 n = glm::normalize(glm::vec3(1, 2, 3));
    const glm::vec3 t = glm::normalize(glm::cross(n, glm::vec3(0, 1, 0)));
    const glm::vec3 normal = item.normalFromObject * n;
    REQUIRE(std::isfinite(normal.x + normal.y + normal.z));
    REQUIRE(glm::length(normal) > 0.0F);
    const glm::vec3 tangent = linear * t;
    CHECK(std::abs(glm::dot(glm::normalize(normal), glm::normalize(tangent))) < 1e-4F);
    // Outward: on the side the scaled point lies on, as the sphere's centre is inside.
    if (factors.y != 0.0) CHECK(glm::dot(normal, linear * n) > 0.0F);
}

TEST_CASE("an object scaled to nothing is skipped") {
    scene::Scene scene = sceneAt({{0, 0, 0}});
    scene.groups[0].transforms.push_back(scene::Scale{glm::dvec3(0.0)});
    CHECK(planOf(scene).items.empty());
}

TEST_CASE("group lights light their group only, camera lights stay with the viewer") {
    scene::Scene scene = sceneAt({{0, 0, 0}, {1, 0, 0}});
    scene::Light light;
    light.type = scene::LightType::point;
    light.position = glm::dvec3(0, 5, 0);
    scene.groups[1].lights.push_back(light);
    scene::Light fixed;
    fixed.type = scene::LightType::directional;
    fixed.space = scene::LightSpace::camera;
    fixed.direction = glm::dvec3(0, 0, 2);
    scene.lights.push_back(fixed);
    scene.camera->eye = glm::dvec3(10, 0, 0);
    const FramePlan plan = planOf(scene);
    REQUIRE(plan.items.size() == 2);
    const auto& first = plan.lightSets[static_cast<std::size_t>(plan.items[0].lightSet)];
    const auto& second = plan.lightSets[static_cast<std::size_t>(plan.items[1].lightSet)];
    REQUIRE(first.size() == 1);
    REQUIRE(second.size() == 2);
    CHECK(first[0].position == glm::vec4(0, 0, 1, 0));  // for any camera
    CHECK(second[1].position.w == 1.0F);
    CHECK(second[1].position.y == Approx(5.0F));
    CHECK(second[1].position.z == Approx(-9.0F));  // at x = 1: nine before the eye
}

TEST_CASE("a scene far from the origin is drawn relative to the eye") {
    const double far = 1e7;
    scene::Scene near = sceneAt({{0.25, 0, 0}});
    scene::Scene moved = sceneAt({{far + 0.25, far, far}});
    moved.camera->eye += glm::dvec3(far);
    moved.camera->target += glm::dvec3(far);
    const glm::mat4 a = planOf(near).items.at(0).viewFromObject;
    const glm::mat4 b = planOf(moved).items.at(0).viewFromObject;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) CHECK(a[i][j] == Approx(b[i][j]).margin(1e-8));
}

TEST_CASE("a picture that only a model outside the view shows is not asked for") {
    scene::Scene scene = sceneAt({{0, 0, 0}, {50, 0, 0}});
    for (std::size_t i = 0; i < 2; ++i) {
        scene::Texture texture;
        texture.chess = scene::Chess{};
        texture.chess->columns = static_cast<int>(2 + i);
        scene.groups[i].models[0].texture = texture;
    }
    scene.lights.emplace_back();
    const FramePlan plan = planOf(scene);
    REQUIRE(plan.textures.size() == 1);
    CHECK(plan.textures[0].chess->columns == 2);
    CHECK(plan.stats.texturesSkipped == 1);
    render::MeshLibrary meshes(1 << 20);
    const FramePlan whole = support::planScene(scene, PictureOptions(), scene::BundleAssets(),
                                               meshes, render::Skipping{false, false, false});
    CHECK(whole.textures.size() == 2);
    CHECK(whole.stats.texturesSkipped == 0);
}

TEST_CASE("tessellation on demand is bounded over all copies, not for each alone") {
    scene::Scene scene = sceneAt({{0, 0, 8.5}});
    scene.groups[0].models[0].source.shape = generator::parseCall({"sphere", "1"});
    PictureOptions fine;
    fine.width = fine.height = 4096;
    fine.errorPx = 0.01;
    const std::int64_t alone = planOf(scene, fine).stats.triangles;
    const std::int64_t bound = render::triangleBudget({4096, 4096});
    constexpr int kCopies = 3000;
    REQUIRE(alone * kCopies > 2 * bound);
    scene::Scatter heap;
    heap.count = kCopies;
    scene.groups[0].scatter = heap;
    const FramePlan plan = planOf(scene, fine);
    CHECK(plan.items.size() == kCopies);
    CHECK(plan.stats.triangles <= bound);
    CHECK(plan.stats.triangles > bound / 32);  // coarsened by no more than needed, in steps of four
    CHECK(plan.stats.coarsening > 1.0);
    CHECK(plan.stats.coarsened == kCopies);
}
