#include "render/instances.h"

#include <set>
#include <variant>

#include "scene/animation.h"

namespace farol::render {
namespace {

class Collector {
  public:
    Collector(double timeS, bool curves, const scene::Assets& assets, MeshLibrary& meshes)
        : timeS_(timeS), curves_(curves), assets_(assets), meshes_(meshes) {}

    InstanceList run(const scene::Scene& scene) {
        list_.lightSets.emplace_back();
        for (const scene::Light& light : scene.lights)
            list_.lightSets[0].push_back(place(light, glm::dmat4(1.0)));
        for (const scene::Group& group : scene.groups) visit(group, glm::dmat4(1.0), 0);
        return std::move(list_);
    }

  private:
    int place(const scene::Light& light, const glm::dmat4& worldFromGroup) {
        if (list_.lights.size() >= kMaxLights)
            throw Error("limit.lights",
                        "the scene has more than " + std::to_string(kMaxLights) + " lights",
                        light.where);
        PlacedLight placed{&light, light.position, light.direction};
        if (light.space == scene::LightSpace::world) {
            placed.position = glm::dvec3(worldFromGroup * glm::dvec4(light.position, 1.0));
            placed.direction = glm::dmat3(worldFromGroup) * light.direction;
        }
        list_.lights.push_back(placed);
        return static_cast<int>(list_.lights.size()) - 1;
    }

    void visit(const scene::Group& group, const glm::dmat4& worldFromParent, int lightSet) {
        if (curves_) addCurves(group, worldFromParent);
        const glm::dmat4 worldFromGroup =
            worldFromParent * scene::matrixAt(group.transforms, timeS_);
        if (!group.scatter) return fill(group, worldFromGroup, lightSet);
        for (const glm::dmat4& groupFromCopy :
             scene::scatterMatrices(*group.scatter, group.scatter->seed))
            fill(group, worldFromGroup * groupFromCopy, lightSet);
    }

    void fill(const scene::Group& group, const glm::dmat4& worldFromGroup, int lightSet) {
        if (!group.lights.empty()) {
            std::vector<int> set = list_.lightSets[static_cast<std::size_t>(lightSet)];
            for (const scene::Light& light : group.lights)
                set.push_back(place(light, worldFromGroup));
            lightSet = static_cast<int>(list_.lightSets.size());
            list_.lightSets.push_back(std::move(set));
        }
        for (const scene::Model& model : group.models) {
            if (list_.instances.size() >= kMaxInstances)
                throw Error("limit.instances",
                            "the scene has more than " + std::to_string(kMaxInstances) + " models",
                            model.where);
            Instance instance{&model, meshes_.get(model, assets_), worldFromGroup,
                              generator::isOpen(model), lightSet};
            if (!instance.mesh->findings.empty() && told_.insert(instance.mesh->id).second)
                list_.findings.insert(list_.findings.end(), instance.mesh->findings.begin(),
                                      instance.mesh->findings.end());
            const Box& box = instance.mesh->bounds;
            if (!box.empty())
                for (int corner = 0; corner < 8; ++corner)
                    list_.bounds.add(glm::dvec3(
                        worldFromGroup * glm::dvec4(corner & 1 ? box.max.x : box.min.x,
                                                    corner & 2 ? box.max.y : box.min.y,
                                                    corner & 4 ? box.max.z : box.min.z, 1.0)));
            list_.instances.push_back(std::move(instance));
        }
        for (const scene::Group& child : group.groups) visit(child, worldFromGroup, lightSet);
    }

    void addCurves(const scene::Group& group, glm::dmat4 worldFromLocal) {
        for (const scene::Transform& transform : group.transforms) {
            if (const auto* curve = std::get_if<scene::FollowCurve>(&transform)) {
                PlacedCurve placed;
                const std::size_t steps = curve->points.size() * kCurveSteps;
                for (std::size_t i = 0; i < steps; ++i) {
                    const double lap = static_cast<double>(i) / static_cast<double>(steps);
                    placed.points.emplace_back(
                        worldFromLocal *
                        glm::dvec4(scene::catmullRom(curve->points, lap).position, 1.0));
                }
                list_.curves.push_back(std::move(placed));
            }
            worldFromLocal = worldFromLocal * scene::matrixAt(transform, timeS_);
        }
    }

    static constexpr std::size_t kCurveSteps =
        5;  ///< segments between two points, as the course draws them

    double timeS_;
    bool curves_;
    const scene::Assets& assets_;
    MeshLibrary& meshes_;
    InstanceList list_;
    std::set<std::uint64_t> told_;  ///< meshes whose findings are listed
};

}  // namespace

InstanceList collect(const scene::Scene& scene, double timeS, bool curves,
                     const scene::Assets& assets, MeshLibrary& meshes) {
    return Collector(timeS, curves, assets, meshes).run(scene);
}

}  // namespace farol::render
