#pragma once

#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "render/plan/mesh_library.h"
#include "render/prepare.h"

namespace farol::grade {

/// The objects of a scene as requirements see them: every copy of every model, with the groups
/// around it. Object k has the number k + 1 in a layer=id image.
class Inventory {
  public:
    /// A group, or a copy of a scattered one.
    struct Node {
        int parent;  ///< index, or -1
        int depth;   ///< groups down to it, 1 for a group of the scene
        const scene::Group* group;
        glm::dmat4 copy;  ///< of a scattered group: after its transforms
    };
    struct Object {
        const scene::Model* model;
        int node;    ///< the group that it stands in
        int number;  ///< of its element in document order, from 1
        std::shared_ptr<const render::MeshData> mesh;
    };
    struct Light {
        const scene::Light* light;
        int node;     ///< -1: of the scene
        int ordinal;  ///< of its element in the order of a walk
    };

    /// `prepared` outlives the inventory. Throws Error limit.instances/models, and as
    /// MeshLibrary::get does.
    Inventory(const render::Prepared& prepared, render::MeshLibrary& meshes);

    const std::vector<Node>& nodes() const { return nodes_; }
    const std::vector<Object>& objects() const { return objects_; }
    const std::vector<Light>& lights() const { return lights_; }
    const scene::Scene& scene() const { return prepared_.scene; }
    const scene::Assets& assets() const { return *prepared_.assets; }

    /// Returns ancestorFromNode at a time; -1: the world. Precondition: `ancestor` is above `node`,
    /// or is it.
    glm::dmat4 matrix(int node, int ancestor, double timeS) const;
    /// Returns whether `node` is `ancestor` or below it.
    bool isBelow(int node, int ancestor) const;
    /// Returns the lowest group around both nodes, or -1.
    int commonOf(int a, int b) const;
    /// Returns the middle of the object's bounds, in an ancestor's space.
    glm::dvec3 middle(std::size_t object, int ancestor, double timeS) const;
    /// Returns half of the largest extent, world units; of a sphere its radius.
    double radius(std::size_t object, double timeS) const;
    /// Returns the seconds of all transforms above the node that have a time, ascending.
    std::vector<double> periodsAbove(int node) const;

    /// Returns the shape's name, or "file". See formOf().
    const std::string& shapeOf(std::size_t object) const;
    /// Returns the digest of the image of the object's texture; empty where there is none, or none
    /// that can be read.
    const std::string& imageOf(std::size_t object) const;
    /// Returns the object's own material, or the dialect's.
    scene::Material materialOf(std::size_t object) const;
    /// Names the object as its author does: "\"Earth\"" or "model 3 (sphere)".
    Message nameOf(std::size_t object) const;

  private:
    void visit(const scene::Group& group, int parent, render::MeshLibrary& meshes);
    void fill(int node, render::MeshLibrary& meshes);

    const render::Prepared& prepared_;
    std::vector<Node> nodes_;
    std::vector<Object> objects_;
    std::vector<Light> lights_;
    std::map<const scene::Model*, int> numbers_;
    std::map<const scene::Light*, int> ordinals_;
    mutable std::map<const scene::Model*, std::string> shapes_;
    mutable std::map<std::string, std::string> images_;  ///< by path
};

}  // namespace farol::grade
