#include "render/plan/instances.h"

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>
#include <variant>

#include "render/plan/messages.h"
#include "render/plan/visibility.h"
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
        list_.tree = BoundsTree(boxes_);
        return std::move(list_);
    }

  private:
    int place(const scene::Light& light, const glm::dmat4& worldFromGroup) {
        if (list_.lights.size() >= kMaxLights)
            throw Error(message<"limit.lights/placed">("most"_arg = kMaxLights), light.where);
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
        const glm::dmat4 worldFromGroup = worldFromParent * matrixOf(group);
        if (!group.scatter) return fill(group, worldFromGroup, lightSet);
        ++scatters_;
        for (const glm::dmat4& groupFromCopy :
             scene::scatterMatrices(*group.scatter, group.scatter->seed))
            fill(group, worldFromGroup * groupFromCopy, lightSet);
        --scatters_;
    }

    /// The transforms of a group; those in scattered groups are computed once for all copies.
    glm::dmat4 matrixOf(const scene::Group& group) {
        if (scatters_ == 0) return scene::matrixAt(group.transforms, timeS_);
        const auto found = matrices_.find(&group);
        if (found != matrices_.end()) return found->second;
        return matrices_.emplace(&group, scene::matrixAt(group.transforms, timeS_)).first->second;
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
                throw Error(message<"limit.instances/models">("most"_arg = kMaxInstances),
                            model.where);
            const Known& known = know(model);
            const glm::dmat4 worldFromObject = placed(worldFromGroup, known.mesh->mesh.origin());
            const Box bounds = boundsOf(known.mesh->bounds, worldFromObject);
            if (!bounds.empty()) {
                list_.bounds.add(bounds.min);
                list_.bounds.add(bounds.max);
            }
            // Nothing to draw where a matrix of zeros leaves a point.
            const bool nothing =
                known.mesh->mesh.indices().empty() || glm::dmat3(worldFromGroup) == glm::dmat3(0.0);
            list_.anyOpen |= known.open;
            boxes_.push_back(nothing ? Box{} : bounds);
            list_.instances.push_back({&model, known.mesh, worldFromObject, known.open, lightSet,
                                       known.texture, known.surface, known.looks});
        }
        for (const scene::Group& child : group.groups) visit(child, worldFromGroup, lightSet);
    }

    /// The properties of a model that do not depend on its place, found once for all copies.
    struct Known {
        std::shared_ptr<const MeshData> mesh;
        bool open;
        int texture;
        int surface;
        int looks;
    };

    /// The matrix with the mesh's origin in it, in double.
    static glm::dmat4 placed(const glm::dmat4& worldFromGroup, const glm::dvec3& origin) {
        glm::dmat4 out = worldFromGroup;
        if (origin != glm::dvec3(0.0)) out[3] = worldFromGroup * glm::dvec4(origin, 1.0);
        return out;
    }

    const Known& know(const scene::Model& model) {
        const auto found = known_.find(&model);
        if (found != known_.end()) return found->second;
        Known known{meshes_.get(model, assets_), generator::isAdaptive(model), textureOf(model),
                    surfaceOf(model), -1};
        if (!model.material && !model.texture) {  // else the scene's own are drawn
            known.looks = looksOf(model, *known.mesh);
            list_.dressed |= known.looks >= 0 || !known.mesh->mesh.colors().empty();
        }
        if (!known.mesh->findings.empty() && told_.insert(known.mesh->id).second)
            list_.findings.insert(list_.findings.end(), known.mesh->findings.begin(),
                                  known.mesh->findings.end());
        return known_.emplace(&model, std::move(known)).first->second;
    }

    int surfaceOf(const scene::Model& model) {
        const std::optional<generator::Surface> surface = generator::surfaceOf(model);
        if (!surface) return -1;
        list_.surfaces.push_back(*surface);
        return static_cast<int>(list_.surfaces.size()) - 1;
    }

    /// Adds the looks of a mesh's parts. Returns the index of the first, or -1.
    int looksOf(const scene::Model& model, const MeshData& data) {
        const auto& materials = model.source.materials;
        if (data.mesh.parts().empty() || !materials) return -1;
        const auto first = static_cast<int>(list_.looks.size());
        for (const generator::MeshPart& part : data.mesh.parts()) {
            const auto found = std::find_if(
                materials->begin(), materials->end(),
                [&part](const scene::PartMaterial& one) { return one.name == part.material; });
            PartLook look{found == materials->end() ? nullptr : &*found, -1};
            if (look.material != nullptr && look.material->texture)
                look.texture = textureIndex(*look.material->texture);
            list_.looks.push_back(look);
        }
        return first;
    }

    int textureOf(const scene::Model& model) {
        return model.texture ? textureIndex(*model.texture) : -1;
    }

    int textureIndex(const scene::Texture& texture) {
        TextureRef ref = refOf(texture, assets_);
        const auto place = std::make_pair(ref.clamp ? "clamp\n" + ref.key : ref.key, ref.filter);
        const auto [at, added] = textures_.emplace(place, static_cast<int>(list_.textures.size()));
        if (added) list_.textures.push_back(std::move(ref));
        return at->second;
    }

    static Box boundsOf(const Box& box, const glm::dmat4& worldFromObject) {
        Box bounds;
        if (box.empty()) return bounds;
        for (int i = 0; i < 8; ++i)
            bounds.add(glm::dvec3(worldFromObject * glm::dvec4(box.corner(i), 1.0)));
        return bounds;
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
    std::vector<Box> boxes_;        ///< of the instances, world space
    std::set<std::uint64_t> told_;  ///< meshes whose findings are listed
    std::unordered_map<const scene::Model*, Known> known_;
    int scatters_ = 0;  ///< scattered groups round the one that is visited
    std::unordered_map<const scene::Group*, glm::dmat4> matrices_;
    std::map<std::pair<std::string, scene::Filter>, int> textures_;
};

}  // namespace

InstanceList collect(const scene::Scene& scene, double timeS, bool curves,
                     const scene::Assets& assets, MeshLibrary& meshes) {
    return Collector(timeS, curves, assets, meshes).run(scene);
}

Placed place(const scene::Scene& scene, double timeS, bool curves, const scene::Assets& assets,
             MeshLibrary& meshes) {
    Placed placed{collect(scene, timeS, curves, assets, meshes), std::nullopt};
    const Diagnostics lighting = checkLighting(placed.scene, timeS);
    placed.scene.findings.insert(placed.scene.findings.end(), lighting.begin(), lighting.end());
    if (scene.entity) placed.entity = collect(*scene.entity, timeS, false, assets, meshes);
    return placed;
}

std::size_t bytesOf(const Placed& placed) {
    // Besides itself an instance has its box, its place in the tree and a share of its nodes.
    constexpr std::size_t kOne = sizeof(Instance) + 2 * sizeof(Box) + 16;
    std::size_t bytes = 0;
    std::set<std::uint64_t> counted;
    const auto add = [&](const InstanceList& list) {
        bytes += list.surfaces.size() * sizeof(generator::Surface);
        bytes += list.looks.size() * sizeof(PartLook);
        for (const Instance& one : list.instances)
            bytes += kOne + (counted.insert(one.mesh->id).second ? bytesOf(*one.mesh) : 0);
    };
    add(placed.scene);
    if (placed.entity) add(*placed.entity);
    return bytes;
}

}  // namespace farol::render
