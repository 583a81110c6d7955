#include "render/plan/visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "render/plan/messages.h"
#include "scene/animation.h"

namespace farol::render {
namespace {

constexpr std::size_t kMaxExplained = 2'000;       // models that findHidden checks
constexpr std::size_t kMaxInsideTests = 64;        // rays through meshes in one call
constexpr std::size_t kMaxRayTriangles = 100'000;  // of a mesh that a ray is sent through
constexpr std::size_t kMaxLitSamples = 300;        // triangles of a mesh whose light is estimated
/// The default ambient light on the default material, of 255: as good as black.
constexpr int kDarkLevel = 10;
constexpr float kVisibleLevel = (kDarkLevel + 0.5F) / 255.0F;
/// Directions flatter than this (sine of the elevation) are no light from below.
constexpr double kClearlyBelow = 0.2;

/// Reasons why a model does not show, most basic first.
enum class Hidden {
    noExtent,
    behind,
    beforeNear,
    beyondFar,
    outside,
    tooSmall,
    cameraInside,
    facingAway,
    black,
    unlit
};

std::string shortNumber(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.4g", value == 0.0 ? 0.0 : value);
    return text.data();
}

std::string shortText(const glm::dvec3& v) {
    return shortNumber(v.x) + ' ' + shortNumber(v.y) + ' ' + shortNumber(v.z);
}

std::array<glm::dvec3, 8> cornersOf(const Box& box) {
    std::array<glm::dvec3, 8> corners;
    for (int i = 0; i < 8; ++i) corners[static_cast<std::size_t>(i)] = box.corner(i);
    return corners;
}

bool contains(const Box& box, const glm::dvec3& point) {
    return glm::all(glm::greaterThan(point, box.min)) && glm::all(glm::lessThan(point, box.max));
}

struct Triangle {
    std::array<glm::dvec3, 3> corners;
    std::size_t first;  ///< index of its first corner in Mesh::indices
};

Triangle triangleOf(const generator::Mesh& mesh, std::size_t index) {
    Triangle out{{}, 3 * index};
    for (std::size_t c = 0; c < 3; ++c)
        out.corners[c] = glm::dvec3(mesh.positions()[mesh.indices()[out.first + c]]);
    return out;
}

/// Whether a closed mesh holds the point (object space): a ray from it leaves through an odd number
/// of triangles. Both directions of the ray must agree, so that open meshes hold nothing.
bool holds(const generator::Mesh& mesh, const glm::dvec3& point) {
    if (mesh.triangles() > kMaxRayTriangles) return false;
    const glm::dvec3 ray = glm::normalize(glm::dvec3(0.5377, 0.6831, 0.4944));  // along no axis
    std::array<int, 2> crossings{0, 0};
    for (std::size_t i = 0; i < mesh.triangles(); ++i) {
        // Moeller and Trumbore 1997, "Fast, minimum storage ray-triangle intersection".
        const auto [p, first] = triangleOf(mesh, i);
        const glm::dvec3 a = p[1] - p[0], b = p[2] - p[0];
        const glm::dvec3 across = glm::cross(ray, b);
        const double determinant = glm::dot(a, across);
        if (determinant == 0.0) continue;
        const glm::dvec3 from = point - p[0];
        const double u = glm::dot(from, across) / determinant;
        const glm::dvec3 normal = glm::cross(from, a);
        const double v = glm::dot(ray, normal) / determinant;
        if (u < 0.0 || v < 0.0 || u + v > 1.0) continue;
        ++crossings[glm::dot(b, normal) / determinant > 0.0 ? 0 : 1];
    }
    return crossings[0] % 2 == 1 && crossings[1] % 2 == 1;
}

/// Whether the instance's closed mesh holds a point of world space.
bool holdsWorldPoint(const Instance& instance, const glm::dvec3& point) {
    if (glm::determinant(instance.worldFromObject) == 0.0) return false;
    const glm::dvec3 object(glm::inverse(instance.worldFromObject) * glm::dvec4(point, 1.0));
    return contains(instance.mesh->bounds, object) && holds(instance.mesh->mesh, object);
}

bool showsBackOnly(const Instance& instance, const glm::dvec3& eye) {
    const generator::Mesh& mesh = instance.mesh->mesh;
    if (instance.model->twoSided || mesh.triangles() > kMaxRayTriangles) return false;
    if (glm::determinant(instance.worldFromObject) == 0.0) return false;
    const glm::dvec3 object(glm::inverse(instance.worldFromObject) * glm::dvec4(eye, 1.0));
    for (std::size_t i = 0; i < mesh.triangles(); ++i) {
        const auto [p, first] = triangleOf(mesh, i);
        if (glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), object - p[0]) > 0.0) return false;
    }
    return true;
}

const scene::Material& materialOf(const scene::Model& model, const scene::Material& otherwise) {
    return model.material ? *model.material : otherwise;
}

float brightest(const glm::vec3& color) { return std::max({color.r, color.g, color.b}); }

/// Returns the most that one light adds to a diffuse or specular surface: attenuation, cone and the
/// cosine.
float lightAt(const PlacedLight& placed, const glm::dvec3& point, const glm::dvec3& normal) {
    const scene::Light& light = *placed.light;
    if (light.type == scene::LightType::directional)
        return static_cast<float>(
            std::max(0.0, glm::dot(normal, glm::normalize(placed.direction))));
    const glm::dvec3 to = placed.position - point;
    const double distance = glm::length(to);
    if (distance == 0.0) return 1.0F;
    double strength = std::max(0.0, glm::dot(normal, to / distance));
    if (light.type == scene::LightType::spot && light.cutoffDeg < 180.0) {
        const double cosine = glm::dot(-to / distance, glm::normalize(placed.direction));
        if (cosine < std::cos(glm::radians(light.cutoffDeg))) return 0.0F;
        strength *= std::pow(std::max(cosine, 0.0), light.exponent);
    }
    const double weakening =
        light.constant + distance * (light.linear + distance * light.quadratic);
    return static_cast<float>(weakening > 0.0 ? strength / weakening : strength);
}

/// Whether no sampled point of the model is brighter than black.
bool staysDark(const scene::Scene& scene, const InstanceList& list, const Instance& instance,
               const scene::Material& material, double timeS) {
    const auto level = [&](const scene::Color& color) {
        return color.cycles ? 1.0F : brightest(scene::colorAt(color, timeS));
    };
    const float steady =
        level(material.emissive) + level(material.ambient) * brightest(scene.globalAmbient);
    if (steady > kVisibleLevel) return false;
    const auto& set = list.lightSets[static_cast<std::size_t>(instance.lightSet)];
    const float reflected = std::max(level(material.diffuse), level(material.specular));
    const generator::Mesh& mesh = instance.mesh->mesh;
    const glm::dmat3 linear(instance.worldFromObject);
    const std::size_t step = mesh.triangles() / kMaxLitSamples + 1;
    for (const int index : set) {
        const PlacedLight& placed = list.lights[static_cast<std::size_t>(index)];
        const scene::Light& light = *placed.light;
        if (light.space == scene::LightSpace::camera) return false;  // its place is the viewer's
        if (level(light.ambient) * level(material.ambient) > kVisibleLevel) return false;
        const float strength = reflected * std::max(level(light.diffuse), level(light.specular));
        for (std::size_t i = 0; i < mesh.triangles(); i += step) {
            const auto [p, first] = triangleOf(mesh, i);
            glm::dvec3 normal = glm::cross(linear * (p[1] - p[0]), linear * (p[2] - p[0]));
            const double length = glm::length(normal);
            if (length == 0.0) continue;
            normal *= glm::determinant(linear) < 0.0 ? -1.0 / length : 1.0 / length;
            for (const glm::dvec3& corner : p) {
                const glm::dvec3 world(instance.worldFromObject * glm::dvec4(corner, 1.0));
                if (strength * lightAt(placed, world, normal) > kVisibleLevel) return false;
            }
        }
    }
    return true;
}

class Explainer {
  public:
    Explainer(const scene::Scene& scene, const InstanceList& list, const ViewTransform& view,
              bool lit, double timeS)
        : scene_(scene),
          list_(list),
          view_(view),
          lit_(lit),
          timeS_(timeS),
          otherwise_(scene::defaultMaterial(scene.dialect)) {}

    std::optional<Hidden> reasonOf(const Instance& instance) {
        const Box& box = instance.mesh->bounds;
        if (box.empty()) return Hidden::noExtent;
        std::array<glm::dvec3, 8> eye;
        Box world;
        const auto corners = cornersOf(box);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const glm::dvec3 at(instance.worldFromObject * glm::dvec4(corners[i], 1.0));
            world.add(at);
            eye[i] = view_.eyeFromWorld(at);
        }
        if (const auto place = placeOf(eye)) return place;
        const glm::dvec3 extent = world.max - world.min;
        const int flat = (extent.x == 0.0) + (extent.y == 0.0) + (extent.z == 0.0);
        if (flat > 1) return Hidden::noExtent;
        if (isTooSmall(eye)) return Hidden::tooSmall;
        if (rays_ < kMaxInsideTests) {
            ++rays_;
            if (holdsWorldPoint(instance, view_.eye)) return Hidden::cameraInside;
            if (showsBackOnly(instance, view_.eye)) return Hidden::facingAway;
        }
        return colorOf(instance);
    }

  private:
    std::optional<Hidden> placeOf(const std::array<glm::dvec3, 8>& eye) const {
        const auto all = [&](auto test) { return std::all_of(eye.begin(), eye.end(), test); };
        if (all([](const glm::dvec3& p) { return p.z >= 0.0; })) return Hidden::behind;
        if (all([&](const glm::dvec3& p) { return -p.z < view_.near; })) return Hidden::beforeNear;
        if (all([&](const glm::dvec3& p) { return -p.z > view_.far; })) return Hidden::beyondFar;
        for (int axis = 0; axis < 2; ++axis)
            for (const double side : {-1.0, 1.0})
                if (all([&](const glm::dvec3& p) {
                        return side * p[axis] > -p.z * view_.tanHalfFov[axis];
                    }))
                    return Hidden::outside;
        return std::nullopt;
    }

    bool isTooSmall(const std::array<glm::dvec3, 8>& eye) const {
        glm::dvec3 low(1e300), high(-1e300);
        for (const glm::dvec3& p : eye) {
            if (-p.z < view_.near) return false;
            const glm::dvec3 seen(p.x / -p.z, p.y / -p.z, 0.0);
            low = glm::min(low, seen);
            high = glm::max(high, seen);
        }
        return std::max(high.x - low.x, high.y - low.y) < view_.pixelAngle;
    }

    std::optional<Hidden> colorOf(const Instance& instance) const {
        const scene::Material& material = materialOf(*instance.model, otherwise_);
        const auto isBlack = [&](const scene::Color& color) {
            return !color.cycles && brightest(scene::colorAt(color, timeS_)) < kVisibleLevel;
        };
        if (!lit_)
            return isBlack(material.diffuse) && !instance.model->texture
                       ? std::optional(Hidden::black)
                       : std::nullopt;
        if (isBlack(material.diffuse) && isBlack(material.ambient) && isBlack(material.specular) &&
            isBlack(material.emissive))
            return Hidden::black;
        return staysDark(scene_, list_, instance, material, timeS_) ? std::optional(Hidden::unlit)
                                                                    : std::nullopt;
    }

    const scene::Scene& scene_;
    const InstanceList& list_;
    const ViewTransform& view_;
    bool lit_;
    double timeS_;
    scene::Material otherwise_;
    std::size_t rays_ = 0;
};

Message messageOf(Hidden reason, const Message& models, const InstanceList& list,
                  const ViewTransform& view) {
    const std::string middle =
        list.bounds.empty() ? "0 0 0" : shortText((list.bounds.min + list.bounds.max) * 0.5);
    const std::string eye = shortText(view.eye);
    const auto subject = "models"_arg = models;
    switch (reason) {
        case Hidden::noExtent:
            return message<"scene.blank/no-extent">(subject);
        case Hidden::behind:
            return message<"scene.blank/behind">(subject, "eye"_arg = eye, "middle"_arg = middle);
        case Hidden::beforeNear:
            return message<"scene.blank/before-near">(subject, "near"_arg = view.near);
        case Hidden::beyondFar:
            return message<"scene.blank/beyond-far">(subject, "far"_arg = view.far);
        case Hidden::outside:
            return message<"scene.blank/outside">(subject, "middle"_arg = middle);
        case Hidden::tooSmall:
            return message<"scene.blank/too-small">(subject, "eye"_arg = eye,
                                                    "middle"_arg = middle);
        case Hidden::cameraInside:
            return message<"scene.blank/camera-inside">(subject, "eye"_arg = eye);
        case Hidden::facingAway:
            return message<"scene.blank/facing-away">(subject);
        case Hidden::black:
            return message<"scene.blank/black">(subject);
        case Hidden::unlit:
            return message<"scene.blank/unlit">(subject);
    }
    return {};
}

bool isFromBelow(const PlacedLight& placed) {
    const double length = glm::length(placed.direction);
    return placed.light->type == scene::LightType::directional &&
           placed.light->space == scene::LightSpace::world && length > 0.0 &&
           placed.direction.y < -kClearlyBelow * length;
}

void warnIfUnused(const InstanceList& list, Diagnostics& out) {
    std::vector<bool> used(list.lights.size(), false);
    std::set<int> sets;
    for (const Instance& instance : list.instances) sets.insert(instance.lightSet);
    for (const int set : sets)
        for (const int light : list.lightSets[static_cast<std::size_t>(set)])
            used[static_cast<std::size_t>(light)] = true;
    for (std::size_t i = 0; i < used.size(); ++i)
        if (!used[i])
            out.push_back(diagnosticOf(Severity::warning, message<"scene.light-unused">(),
                                       list.lights[i].light->where));
}

void warnIfFromBelow(const InstanceList& list, Diagnostics& out) {
    if (list.lights.empty() || !std::all_of(list.lights.begin(), list.lights.end(), isFromBelow))
        return;
    const PlacedLight& first = list.lights.front();
    out.push_back(
        diagnosticOf(Severity::warning,
                     message<"scene.light-below">("vector"_arg = shortText(first.direction),
                                                  "suggestion"_arg = shortText(-first.direction)),
                     first.light->where));
}

void warnIfLitFromWithin(const InstanceList& list, double timeS, Diagnostics& out) {
    std::size_t rays = 0;
    std::set<const scene::Model*> known;
    for (const Instance& instance : list.instances) {
        const auto& set = list.lightSets[static_cast<std::size_t>(instance.lightSet)];
        const auto& material = instance.model->material;
        const bool glows =
            material && (material->emissive.cycles ||
                         brightest(scene::colorAt(material->emissive, timeS)) > kVisibleLevel);
        if (set.empty() || glows || instance.model->twoSided) continue;
        const PlacedLight* inside = nullptr;
        for (const int index : set) {
            const PlacedLight& placed = list.lights[static_cast<std::size_t>(index)];
            const bool isLocal = placed.light->type != scene::LightType::directional &&
                                 placed.light->space == scene::LightSpace::world;
            if (!isLocal || rays >= kMaxInsideTests) {
                inside = nullptr;
                break;
            }
            ++rays;
            if (!holdsWorldPoint(instance, placed.position)) {
                inside = nullptr;
                break;
            }
            inside = &placed;
        }
        if (inside == nullptr || !known.insert(instance.model).second) continue;
        out.push_back(
            diagnosticOf(Severity::warning,
                         message<"scene.light-inside">("line"_arg = inside->light->where.line),
                         instance.model->where));
    }
}

}  // namespace

bool isNearlyBlank(const image::Image& image) {
    const std::size_t pixels = image.pixels.size() / 4;
    if (pixels == 0) return true;
    const std::uint8_t* const first = image.pixels.data();
    const std::size_t most = pixels / 2'000;
    std::size_t different = 0;
    for (const std::uint8_t* p = first; p != first + 4 * pixels; p += 4) {
        const bool isBlack = std::max({p[0], p[1], p[2]}) <= kDarkLevel;
        if (isBlack || (p[0] == first[0] && p[1] == first[1] && p[2] == first[2])) continue;
        if (++different > most) return false;
    }
    return true;
}

Diagnostics checkLighting(const InstanceList& list, double timeS) {
    Diagnostics out;
    if (list.instances.empty()) return out;
    warnIfUnused(list, out);
    warnIfFromBelow(list, out);
    warnIfLitFromWithin(list, timeS, out);
    return out;
}

HiddenModels findHidden(const scene::Scene& scene, const InstanceList& list,
                        const ViewTransform& view, bool lit, double timeS) {
    Explainer explainer(scene, list, view, lit, timeS);
    struct Group {
        std::size_t models = 0;
        Location first;
    };
    std::map<Hidden, Group> groups;
    const std::size_t looked = std::min(list.instances.size(), kMaxExplained);
    for (std::size_t i = 0; i < looked; ++i) {
        const auto reason = explainer.reasonOf(list.instances[i]);
        if (!reason) continue;
        Group& group = groups[*reason];
        if (group.models++ == 0) group.first = list.instances[i].model->where;
    }
    HiddenModels out;
    std::size_t hidden = 0;
    for (const auto& [reason, group] : groups) {
        hidden += group.models;
        const Message models =
            group.models == 1 ? message<"part.models-one">()
            : group.models == looked
                ? message<"part.models-all">("count"_arg = looked)
                : message<"part.models-some">("count"_arg = group.models, "total"_arg = looked);
        out.findings.push_back(
            diagnosticOf(Severity::warning, messageOf(reason, models, list, view), group.first));
    }
    out.areAll = hidden > 0 && hidden == list.instances.size();
    return out;
}

}  // namespace farol::render
