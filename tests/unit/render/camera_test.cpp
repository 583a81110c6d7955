#include "render/plan/camera.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace farol;
using render::Box;
using render::PictureOptions;

namespace {

scene::Scene sceneWith(const glm::dvec3& eye, const glm::dvec3& target) {
    scene::Scene scene;
    scene.camera = scene::Camera{};
    scene.camera->eye = eye;
    scene.camera->target = target;
    return scene;
}

double depthAt(const scene::Camera& camera, double distance) {
    const glm::dvec4 clip =
        render::viewOf(camera, glm::ivec2(64)).clip * glm::dvec4(0, 0, -distance, 1);
    return clip.z / clip.w;
}

}  // namespace

TEST_CASE("depth runs from 1 at near to 0 at far") {
    scene::Camera camera;
    camera.near = 0.5;
    camera.far = 2000.0;
    CHECK(depthAt(camera, 0.5) == Approx(1.0));
    CHECK(depthAt(camera, 2000.0) == Approx(0.0).margin(1e-12));
    CHECK(depthAt(camera, 10.0) > depthAt(camera, 11.0));
}

TEST_CASE("the view rotation is orthonormal and looks along -Z, also straight up and down") {
    const glm::dvec3 target =
        GENERATE(glm::dvec3(0, 0, -1), glm::dvec3(3, 2, 1), glm::dvec3(0, 1, 0),
                 glm::dvec3(0, -1, 0), glm::dvec3(1e-7, 1, 0));
    scene::Camera camera;
    camera.eye = glm::dvec3(0.0);
    camera.target = target;
    const glm::dmat3 view = render::viewOf(camera, glm::ivec2(64)).rotation;
    const glm::dmat3 product = view * glm::transpose(view);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            CHECK(product[i][j] == Approx(i == j ? 1.0 : 0.0).margin(1e-12));
    CHECK(glm::determinant(view) == Approx(1.0));
    const glm::dvec3 forward = view * glm::normalize(target);
    CHECK(forward.z == Approx(-1.0));
}

TEST_CASE("azimuth and elevation orbit about the target, what is left out stays") {
    const scene::Scene scene = sceneWith({0, 0, 10}, {0, 0, 0});
    PictureOptions options;
    options.orbit.azimuthDeg = 90.0;
    scene::Camera camera = render::chooseCamera(scene, options, Box{}, 1.0);
    CHECK(camera.eye.x == Approx(10.0));
    CHECK(camera.eye.z == Approx(0.0).margin(1e-9));
    options.orbit.elevationDeg = 30.0;
    options.orbit.distance = 4.0;
    camera = render::chooseCamera(scene, options, Box{}, 1.0);
    CHECK(camera.eye.y == Approx(2.0));
    CHECK(glm::length(camera.eye) == Approx(4.0));
    // The same numbers read off a camera give the camera back.
    const scene::Scene oblique = sceneWith({3, 4, 5}, {1, 1, 1});
    PictureOptions same;
    same.orbit.distance = glm::length(glm::dvec3(2, 3, 4));
    camera = render::chooseCamera(oblique, same, Box{}, 1.0);
    CHECK(glm::length(camera.eye - glm::dvec3(3, 4, 5)) < 1e-12);
}

TEST_CASE("a scene without a camera is framed: all corners are inside the view") {
    const glm::ivec2 size = GENERATE(glm::ivec2(16, 64), glm::ivec2(64), glm::ivec2(256, 64));
    const double aspect = static_cast<double>(size.x) / size.y;
    const glm::dvec3 center = GENERATE(glm::dvec3(0), glm::dvec3(1e6, -50, 3));
    Box box;
    box.add(center - glm::dvec3(3, 1, 0.5));
    box.add(center + glm::dvec3(3, 1, 0.5));
    const scene::Camera camera =
        render::chooseCamera(scene::Scene{}, PictureOptions{}, box, aspect);
    const render::ViewTransform view = render::viewOf(camera, size);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 point(corner & 1 ? box.max.x : box.min.x,
                               corner & 2 ? box.max.y : box.min.y,
                               corner & 4 ? box.max.z : box.min.z);
        const glm::dvec4 p = view.clip * glm::dvec4(view.eyeFromWorld(point), 1.0);
        CHECK(std::abs(p.x) < p.w);
        CHECK(std::abs(p.y) < p.w);
        CHECK(p.z > 0.0);
        CHECK(p.z < p.w);
    }
}

TEST_CASE("a camera that sees nothing is refused by name") {
    PictureOptions options;
    options.eye = glm::dvec3(1, 2, 3);
    options.target = glm::dvec3(1, 2, 3);
    try {
        render::chooseCamera(scene::Scene{}, options, Box{}, 1.0);
        FAIL("was accepted");
    } catch (const Error& error) {
        CHECK(error.code() == "option.camera");
        CHECK(error.primary().field == "eye");
    }
    PictureOptions far;
    far.near = 10.0;
    far.far = 5.0;
    CHECK_THROWS_AS(render::chooseCamera(scene::Scene{}, far, Box{}, 1.0), Error);
}

TEST_CASE("where a scene has no camera, near and far follow the eye that is asked for") {
    Box box;
    box.add(glm::dvec3(-1e7, 0, -1e7));
    box.add(glm::dvec3(1e7, 0, 1e7));
    PictureOptions options;
    options.eye = glm::dvec3(0, 10, 1);
    options.target = glm::dvec3(0);
    options.far = 1000.0;
    const scene::Camera camera = render::chooseCamera(scene::Scene{}, options, box, 1.0);
    CHECK(camera.near < 10.0);
    CHECK(camera.far == 1000.0);
    // As close as one likes to something small.
    Box small;
    small.add(glm::dvec3(-1));
    small.add(glm::dvec3(1));
    options.far.reset();
    options.eye = glm::dvec3(0, 0, 1.8);
    const scene::Camera near = render::chooseCamera(scene::Scene{}, options, small, 1.0);
    CHECK(near.near < 0.8);
    CHECK(near.far > 2.8);
}

TEST_CASE("a view says what a pixel spans, and moves by parts of a pixel") {
    scene::Camera camera;
    camera.fovDeg = 90.0;
    const render::ViewTransform view = render::viewOf(camera, {200, 100});
    CHECK(view.tanHalfFov.y == Approx(1.0));
    CHECK(view.tanHalfFov.x == Approx(2.0));
    CHECK(view.pixelAngle == Approx(0.02));
    // A point in the middle of a pixel moves a quarter of it to the right and an eighth up.
    const auto pixelAt = [&](const glm::dmat4& clip) {
        const glm::dvec4 p = clip * glm::dvec4(0.31, -0.23, -7.0, 1.0);
        return (glm::dvec2(p) / p.w + 1.0) * 0.5 * glm::dvec2(view.size);
    };
    const glm::dvec2 moved = pixelAt(render::movedClip(view, {0.25, 0.125})) - pixelAt(view.clip);
    CHECK(std::abs(moved.x) == Approx(0.25));
    CHECK(std::abs(moved.y) == Approx(0.125));
}

TEST_CASE("a scene without camera is framed, and orbited on demand; engine is the 2017 start") {
    scene::Scene scene;
    scene.dialect = scene::Dialect::engine2017;
    scene.where = {"scene.xml", 1, 1};
    Box bounds;
    bounds.add({-1, -1, -1});
    bounds.add({1, 1, 1});
    PictureOptions options;
    const scene::Camera framed = render::chooseCamera(scene, options, bounds, 1.0);
    CHECK(framed.target == glm::dvec3(0.0));
    CHECK(glm::length(framed.eye) > 1.8);
    CHECK(render::noteCameraStart(scene, options)->message.find("frames all models") !=
          std::string::npos);
    options.orbit.azimuthDeg = 180.0;
    CHECK(render::chooseCamera(scene, options, bounds, 1.0).eye.z ==
          Approx(-std::hypot(framed.eye.x, framed.eye.z)));
    options = {};
    options.camera = render::CameraStart::engine;
    const scene::Camera engine = render::chooseCamera(scene, options, bounds, 1.0);
    CHECK(engine.eye == glm::dvec3(0.0));
    CHECK(engine.target == glm::dvec3(0, 0, 1));
    CHECK(engine.fovDeg == 45.0);
    CHECK(engine.near == 1.0);
    CHECK(engine.far == 1000.0);
    CHECK(render::noteCameraStart(scene, options)->message.find("2017") != std::string::npos);
    scene.camera = engine;
    CHECK_FALSE(render::noteCameraStart(scene, {}));
    options.camera = render::CameraStart::framed;
    CHECK(render::chooseCamera(scene, options, bounds, 1.0).eye == framed.eye);
}
