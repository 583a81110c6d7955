#include "render/plan/shadow_casters.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "render/plan/shadow_cut.h"
#include "render/plan/transparency.h"

namespace farol::render {
namespace {

/// Bounds of a mesh's error: texels of its map, less than the filter blurs; share of its size.
constexpr double kMaxErrorTexels = 0.125, kMinError = 1e-4;

/// Maps with more triangles are planned again, with four times the error.
constexpr std::int64_t kMaxTriangles = 2'000'000;

/// Distance from a light to a box in world space, at which a mesh has to be fine; 1 of a
/// directional light.
double distanceOf(const Box& box, const LightView& light) {
    if (!light.isPerspective) return 1.0;
    const glm::dvec3 outside =
        glm::max(glm::max(box.min - light.origin, light.origin - box.max), 0.0);
    // A lamp within a body, or beside it, needs no finer one than its size asks for.
    return std::max(0.25 * glm::length(box.max - box.min), glm::length(outside));
}

class CasterMaker {
  public:
    CasterMaker(const PlannedShadowMap& map, const ViewTransform& view, const CasterSource& source)
        : map_(map), view_(view), source_(source) {}

    std::vector<DrawItem> run() {
        for (const std::size_t i : map_.casters) add(source_.list.instances[i]);
        // Equal models in a row are one draw call.
        const auto key = [](const DrawItem& item) {
            return std::tuple(item.mesh->id, item.firstIndex, item.mirrored, item.texture);
        };
        std::stable_sort(items_.begin(), items_.end(),
                         [&](const DrawItem& a, const DrawItem& b) { return key(a) < key(b); });
        return std::move(items_);
    }

  private:
    void add(const Instance& instance) {
        const scene::Model& model = *instance.model;
        const LightView& light = map_.light;
        DrawItem item;
        item.mesh = instance.open ? refined(instance) : instance.mesh;
        const glm::dmat3 linear = light.rotation * glm::dmat3(instance.worldFromObject);
        glm::dmat4 lightFromObject(linear);
        lightFromObject[3] = glm::dvec4(
            light.rotation * (glm::dvec3(instance.worldFromObject[3]) - light.origin), 1.0);
        item.viewFromObject = glm::mat4(lightFromObject);
        item.mirrored = glm::determinant(linear) < 0.0;
        item.indices = item.mesh->mesh.indices().size();
        // Bodies stop light that meets their outsides, so that a lamp within one shines.
        const bool isSheet =
            model.twoSided || model.source.isSheet || isFlat(instance.mesh->bounds);
        if (instance.looks >= 0) {
            const std::vector<generator::MeshPart>& parts = item.mesh->mesh.parts();
            for (std::size_t i = 0; i < parts.size(); ++i) {
                const PartLook& look =
                    source_.list.looks[static_cast<std::size_t>(instance.looks) + i];
                if (source_.isTransparent && look.material != nullptr &&
                    look.material->material.opacity < 1.0F)
                    continue;
                item.firstIndex = parts[i].first;
                item.indices = parts[i].count;
                item.texture = -1;
                if (look.texture >= 0) dress(item, *look.material->texture, look.texture);
                push(item, isSheet);
            }
            return;
        }
        if (model.texture) dress(item, *model.texture, instance.texture);
        if (item.texture < 0) cut(item, lightFromObject);
        push(item, isSheet);
    }

    void cut(DrawItem& item, const glm::dmat4& lightFromObject) {
        std::shared_ptr<const MeshData> part = cutToMap(*item.mesh, lightFromObject, map_.light);
        if (!part) return;
        item.mesh = std::move(part);
        item.indices = item.mesh->mesh.indices().size();
        item.viewFromObject = glm::mat4(1.0F);
    }

    void push(const DrawItem& item, bool isSheet) {
        if (item.indices == 0) return;
        items_.push_back(item);
        if (!isSheet) return;
        items_.push_back(item);
        items_.back().mirrored = !item.mirrored;
    }

    /// The mesh of an open shape, as fine as the map's texels ask for.
    std::shared_ptr<const MeshData> refined(const Instance& instance) {
        const glm::dmat3 linear(instance.worldFromObject);
        const double largest =
            std::sqrt(glm::dot(linear[0], linear[0]) + glm::dot(linear[1], linear[1]) +
                      glm::dot(linear[2], linear[2]));
        const Box& box = instance.mesh->bounds;
        Box world;
        for (int i = 0; i < 8; ++i)
            world.add(glm::dvec3(instance.worldFromObject * glm::dvec4(box.corner(i), 1.0)));
        const double error =
            std::max(kMinError * glm::length(box.max - box.min),
                     kMaxErrorTexels * source_.coarsening * map_.light.texel *
                         distanceOf(world, map_.light) / std::max(1e-300, largest));
        generator::Fineness fine{};
        fine.error = std::exp2(std::floor(4.0 * std::log2(std::max(1e-300, error))) / 4.0);
        fine.fullTurn = 8.0;
        return source_.meshes.get(*instance.mesh, *instance.model, source_.assets, fine);
    }

    /// Its texture may have holes.
    void dress(DrawItem& item, const scene::Texture& from, int texture) {
        if (!source_.isTransparent || from.chess) return;
        const generator::Mesh& mesh = item.mesh->mesh;
        if (from.mapping == scene::Mapping::mesh && mesh.uvs().empty()) return;
        item.mapping = from.mapping;
        const bool isObject = item.mapping == scene::Mapping::texgenObject;
        const glm::dvec3 origin = isObject ? mesh.origin() : glm::dvec3(0.0);
        item.planeS = texgenPlane(from.planeS, origin, from.clamp);
        item.planeT = texgenPlane(from.planeT, origin, from.clamp);
        if (item.mapping == scene::Mapping::texgenEye) {
            // The planes are the camera's, places the light's.
            const glm::dmat3 turn = view_.rotation * glm::transpose(map_.light.rotation);
            glm::dmat4 eyeFromLight(turn);
            eyeFromLight[3] = glm::dvec4(view_.eyeFromWorld(map_.light.origin), 1.0);
            const glm::mat4 across(glm::transpose(eyeFromLight));
            item.planeS = across * item.planeS;
            item.planeT = across * item.planeT;
        }
        item.uvFrom = uvPlacement(from, mesh.uvOrigin());
        item.texture = source_.textureIndex(static_cast<std::size_t>(texture));
    }

    const PlannedShadowMap& map_;
    const ViewTransform& view_;
    const CasterSource& source_;
    std::vector<DrawItem> items_;
};

void addCasters(FramePlan& plan, const PlannedShadows& shadows, const CasterSource& source) {
    for (const PlannedShadowMap& planned : shadows.maps) {
        ShadowMap map;
        map.clip = planned.light.clip();
        map.casters = CasterMaker(planned, plan.view, source).run();
        for (const DrawItem& item : map.casters)
            plan.stats.shadowTriangles += static_cast<std::int64_t>(item.indices / 3);
        plan.shadowMaps.push_back(std::move(map));
    }
}

}  // namespace

glm::vec3 shadowOffsetOf(const DrawItem& item, const Instance& instance, double error) {
    const glm::dvec3 size = item.mesh->bounds.max - item.mesh->bounds.min;
    const auto triangles = static_cast<double>(item.mesh->mesh.triangles());
    const glm::dmat3 linear(instance.worldFromObject);
    const double scale =
        (glm::length(linear[0]) + glm::length(linear[1]) + glm::length(linear[2])) / 3.0;
    // A quad's share of the box's faces, about.
    const double area = 4.0 * (size.x * size.y + size.y * size.z + size.z * size.x) / triangles;
    const double face = 0.5 * std::sqrt(area) * scale;
    // Shapes without curved parts have the same faces at any fineness.
    if (!instance.open || (instance.surface < 0 && !instance.mesh->flats.empty()))
        return {0.0, 0.0, face};
    const bool isExact = item.surface && (item.isOnSurface || item.surface->kind->raySteps > 0);
    return {0.5, isExact ? 0.0 : error, face};
}

void addShadowMaps(FramePlan& plan, const PlannedShadows& shadows, const CasterSource& source) {
    plan.shadowSide = shadows.side;
    addCasters(plan, shadows, source);
    CasterSource coarser = source;
    std::int64_t before = 0;  // written divisions stay
    while (plan.stats.shadowTriangles > kMaxTriangles && plan.stats.shadowTriangles != before) {
        before = plan.stats.shadowTriangles;
        coarser.coarsening *= 4.0;
        plan.shadowMaps.clear();
        plan.stats.shadowTriangles = 0;
        addCasters(plan, shadows, coarser);
    }
    for (const PlannedShadowLight& light : shadows.lights)
        plan.shadowLights.push_back(eyeShadowLight(shadows, light, plan.view));
    plan.stats.shadowMaps += static_cast<int>(shadows.maps.size());
}

}  // namespace farol::render
