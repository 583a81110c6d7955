// The scene reader and the resolver of models: any bytes give a scene or an Error, as they promise.
#include <cmath>
#include <optional>

#include "generator/registry.h"
#include "scene/animation.h"
#include "scene/read/reader.h"
#include "tests/fuzz/checks.h"
#include "tests/fuzz/scene_words.h"
#include "tests/fuzz/target.h"

namespace farol::fuzz {
namespace {

void checkNumber(double value) { require(std::isfinite(value), "a number that is not finite"); }
template <class Vector>
void checkVector(const Vector& v) {
    for (int i = 0; i < Vector::length(); ++i) checkNumber(static_cast<double>(v[i]));
}
void checkColor(const scene::Color& color) {
    checkVector(color.rgb);
    for (int i = 0; i < 3; ++i) require(color.rgb[i] >= 0.0F, "a negative colour");
}

void checkLight(const scene::Light& light) {
    checkVector(light.position);
    checkVector(light.direction);
    for (const double one :
         {light.cutoffDeg, light.exponent, light.constant, light.linear, light.quadratic})
        checkNumber(one);
    require((light.cutoffDeg >= 0 && light.cutoffDeg <= 90) || light.cutoffDeg == 180,
            "a cutoff that is none");
    for (const auto& color : {light.diffuse, light.ambient, light.specular}) checkColor(color);
}

void checkTransform(const scene::Transform& transform) {
    if (const auto* curve = std::get_if<scene::FollowCurve>(&transform)) {
        require(curve->seconds > 0 && !curve->points.empty(), "a curve without time or points");
        for (const glm::dvec3& point : curve->points) checkVector(point);
    }
    if (const auto* spin = std::get_if<scene::Spin>(&transform))
        require(spin->seconds != 0, "a turn in no time");
    for (const double time : {0.0, 1.25, 1e6}) {
        const glm::dmat4 matrix = scene::matrixAt(transform, time);
        for (int column = 0; column < 4; ++column) checkVector(matrix[column]);
    }
}

void checkGroup(const scene::Group& group, int depth) {
    require(depth < 600, "groups nested without bound");
    for (const scene::Transform& transform : group.transforms) checkTransform(transform);
    for (const scene::Light& light : group.lights) checkLight(light);
    for (const scene::Model& model : group.models) {
        if (model.material) {
            const scene::Material& material = *model.material;
            for (const auto& color :
                 {material.diffuse, material.ambient, material.specular, material.emissive})
                checkColor(color);
            checkNumber(static_cast<double>(material.shininess));
        }
        if (!model.texture) continue;
        checkVector(model.texture->planeS);
        checkVector(model.texture->planeT);
        const auto& chess = model.texture->chess;
        require(!chess || (chess->columns > 0 && chess->rows > 0), "a chess board without fields");
    }
    if (group.scatter) {
        require(group.scatter->count >= 0, "a negative count");
        checkNumber(group.scatter->radiusMin + group.scatter->radiusMax);
        checkNumber(group.scatter->yMin + group.scatter->yMax);
    }
    for (const scene::Group& child : group.groups) checkGroup(child, depth + 1);
}

void checkScene(const scene::Scene& scene) {
    if (scene.camera) {
        const scene::Camera& camera = *scene.camera;
        for (const glm::dvec3& v : {camera.eye, camera.target, camera.up}) checkVector(v);
        require(camera.fovDeg > 0 && camera.fovDeg < 180, "no field of view");
        require(camera.near > 0 && camera.far > camera.near, "no depth of view");
    }
    if (scene.window)
        require(scene.window->width > 0 && scene.window->height > 0 &&
                    scene.window->width <= 4096 && scene.window->height <= 4096,
                "a window out of range");
    for (const scene::Light& light : scene.lights) checkLight(light);
    for (const scene::Group& group : scene.groups) checkGroup(group, 0);
    if (scene.entity) checkScene(*scene.entity);
}

std::optional<scene::ReadResult> tryRead(std::string_view xml, bool strict,
                                         const scene::Assets& assets) {
    scene::ReadOptions options;
    options.name = kSceneName;
    options.strict = strict;
    // So many findings are shown, notes among them.
    const auto most = static_cast<std::size_t>(options.limits.diagnostics) + 1;
    try {
        scene::ReadResult result = scene::read(xml, options, assets);
        require(result.diagnostics.size() <= most, "more findings than are shown");
        checkDiagnostics(result.diagnostics, kSceneName, xml);
        for (const Diagnostic& one : result.diagnostics)
            require(one.severity != Severity::error, "an error that was not thrown: " + one.code);
        checkScene(result.scene);
        return result;
    } catch (const Error& error) {
        require(error.diagnostics().size() <= most, "more findings than are shown");
        checkError(error, kSceneName, xml);
        return std::nullopt;
    }
}

}  // namespace

const Target& target() {
    static const Target made{{"xml"}, sceneTokens(), 512};
    return made;
}

}  // namespace farol::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace farol;
    using namespace farol::fuzz;
    const std::string_view xml(reinterpret_cast<const char*>(data), std::min(size, kMaxInput));
    const scene::BundleAssets assets = sceneBundle(xml);
    auto lenient = tryRead(xml, false, assets);
    const auto strict = tryRead(xml, true, assets);
    require(lenient || !strict, "strict takes what lenient refuses");
    if (!lenient) return 0;
    Diagnostics found;
    generator::resolve(lenient->scene, assets, found);
    checkDiagnostics(found, kSceneName, xml);
    return 0;
}
