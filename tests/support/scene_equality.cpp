#include "tests/support/scene_equality.h"

#include <algorithm>
#include <tuple>

namespace farol::scene {
namespace {

auto fields(const Light& a) {
    return std::tie(a.type, a.space, a.position, a.direction, a.cutoffDeg, a.exponent, a.constant,
                    a.linear, a.quadratic, a.diffuse, a.ambient, a.specular);
}
auto fields(const Translate& a) { return std::tie(a.offset); }
auto fields(const FollowCurve& a) { return std::tie(a.seconds, a.align, a.points); }
auto fields(const Rotate& a) { return std::tie(a.angleDeg, a.axis); }
auto fields(const Spin& a) { return std::tie(a.seconds, a.axis); }
auto fields(const Scale& a) { return std::tie(a.factors); }
auto fields(const Texture& a) {
    return std::tie(a.file, a.path, a.chess, a.mapping, a.planeS, a.planeT, a.filter);
}
auto fields(const Scatter& a) {
    return std::tie(a.count, a.radiusMin, a.radiusMax, a.yMin, a.yMax, a.seed);
}
auto fields(const Camera& a) { return std::tie(a.eye, a.target, a.up, a.fovDeg, a.near, a.far); }
auto fields(const Window& a) { return std::tie(a.width, a.height); }
auto fields(const Skybox& a) { return std::tie(a.file, a.path, a.width); }
auto fields(const Background& a) { return std::tie(a.color, a.file, a.path); }

template <class T>
bool same(const T& a, const T& b) {
    return fields(a) == fields(b);
}
template <class T>
bool same(const std::optional<T>& a, const std::optional<T>& b) {
    return a.has_value() == b.has_value() && (!a || same(*a, *b));
}
bool same(const Transform& a, const Transform& b) {
    if (a.index() != b.index()) return false;
    return std::visit(
        [&b](const auto& t) { return same(t, std::get<std::decay_t<decltype(t)>>(b)); }, a);
}
bool same(const Model& a, const Model& b) {
    return std::tie(a.file, a.command, a.revolve, a.uv, a.source, a.material, a.opacity, a.twoSided,
                    a.autoLod, a.id, a.name) == std::tie(b.file, b.command, b.revolve, b.uv,
                                                         b.source, b.material, b.opacity,
                                                         b.twoSided, b.autoLod, b.id, b.name) &&
           same(a.texture, b.texture);
}
bool same(const Group& a, const Group& b);
template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const T& x, const T& y) { return same(x, y); });
}
bool same(const Group& a, const Group& b) {
    return same(a.transforms, b.transforms) && same(a.lights, b.lights) &&
           same(a.models, b.models) && same(a.groups, b.groups) && same(a.scatter, b.scatter) &&
           a.name == b.name;
}

}  // namespace

bool equal(const Scene& a, const Scene& b) {
    const bool entities = (a.entity == nullptr) == (b.entity == nullptr) &&
                          (!a.entity || equal(*a.entity, *b.entity));
    return std::tie(a.dialect, a.title, a.description, a.globalAmbient, a.entityFile,
                    a.generatorComments, a.settings) == std::tie(b.dialect, b.title, b.description,
                                                                 b.globalAmbient, b.entityFile,
                                                                 b.generatorComments, b.settings) &&
           same(a.window, b.window) && same(a.camera, b.camera) && same(a.lights, b.lights) &&
           same(a.groups, b.groups) && same(a.background, b.background) &&
           same(a.skybox, b.skybox) && entities;
}

}  // namespace farol::scene
