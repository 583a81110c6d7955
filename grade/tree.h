#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <vector>

#include "render/instances.h"
#include "render/prepare.h"
#include "scene/scene.h"

namespace farol::grade {

/// One transform on the way from the world to a model.
struct Step {
    const scene::Transform* transform;
    int group;  ///< its group's number, from 1 in document order
    Location where;
};

/// A model at its place at the tree's time. Piece i is drawn with the number i + 1 in layer=id.
struct Piece {
    const scene::Model* model = nullptr;
    std::shared_ptr<const render::MeshData> mesh;
    glm::dmat4 worldFromObject{1.0};
    scene::Material material;  ///< its own or the dialect's
    int number = 0;            ///< of the model, from 1 in document order
    int group = 0;             ///< of the group it stands in
    int parent = 0;            ///< of the group around that one; 0: none
    std::vector<Step> steps;
};

/// A scene taken apart for comparison: every model at its place with all that led there.
struct Tree {
    std::shared_ptr<const render::Prepared> prepared;
    double timeS = 0.0;
    render::InstanceList list;  ///< lights, bounds
    std::vector<Piece> pieces;
    int groups = 0;

    const scene::Scene& scene() const { return prepared->scene; }
    const scene::Assets& assets() const { return *prepared->assets; }
};

/// Throws Error as render::collect does.
Tree growTree(std::shared_ptr<const render::Prepared> prepared, double timeS,
              render::MeshLibrary& meshes);

/// "model 3 (earth)", "model 3 (sphere 1 8 8)": as the author knows it.
std::string nameOf(const Piece& piece);
/// "sphere 1 8 8", or the file's name.
std::string meshNameOf(const scene::Model& model);

}  // namespace farol::grade
