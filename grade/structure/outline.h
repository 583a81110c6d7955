#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/plan/mesh_library.h"
#include "render/prepare.h"
#include "scene/scene.h"

namespace farol::grade {

/// One transform of a group. `id` is unique in its outline and survives every edit.
struct Link {
    scene::Transform transform;
    Location where;
    int id = 0;
};

/// A scene as flat lists, which repairs edit. Groups, models and lights keep their indices; a
/// removed one is only marked. Node 0 is the world, which holds the scene's own lights.
struct Outline {
    struct Node {
        int parent = -1;
        std::vector<Link> links;
        std::optional<scene::Scatter> scatter;
        std::string name;
        Location where;
        int number = 0;  ///< in document order, from 1; 0: added by a repair
        bool isGone = false;
    };
    /// A model element. Scattered copies of one element are one item.
    struct Item {
        int node = 0;
        scene::Model model;
        std::shared_ptr<const render::MeshData> mesh;
        scene::Material material;              ///< its own or the dialect's
        const scene::Model* origin = nullptr;  ///< in the scene that was read
        int number = 0;                        ///< in document order, from 1; 0: added by a repair
        bool isReversed = false;               ///< drawn clockwise, as its file has it
        bool lacksMesh = false;     ///< a placeholder stands for its mesh, which cannot be read
        bool lacksTexture = false;  ///< likewise
        bool isGone = false;
    };
    struct Lamp {
        int node = 0;
        scene::Light light;
        int number = 0;
        bool isGone = false;
    };

    std::vector<Node> nodes;
    std::vector<Item> items;
    std::vector<Lamp> lamps;
    scene::Scene rest;  ///< the scene without its groups and lights: camera, settings, background
    int nextLink = 1;

    /// Returns whether `node` is `ancestor` or stands below it.
    bool isBelow(int node, int ancestor) const;
    /// Returns the nodes from the world's child down to `node`.
    std::vector<int> pathTo(int node) const;
    /// Returns the place in Node::links of the link `id`, or -1.
    int placeOf(int node, int id) const;
};

/// Opacity of an item as it is drawn: its material's times its own.
inline float opacityOf(const Outline::Item& item) {
    return item.material.opacity * item.model.opacity;
}

/// Takes a scene apart; errors among its diagnostics name the files of placeholders. Throws Error
/// as MeshLibrary::get does.
Outline outlineOf(const render::Prepared& prepared, render::MeshLibrary& meshes);

/// Puts an outline together again; groups stand in the order of their indices.
scene::Scene sceneOf(const Outline& outline);

/// Where a scene of an outline finds meshes that are drawn clockwise, and the reference's own
/// files: below these folders.
inline constexpr const char* kReversedFolder = ".reversed/";
inline constexpr const char* kReferenceFolder = ".reference/";

/// World matrices of one instant of each node.
using Poses = std::vector<glm::dmat4>;
Poses posesOf(const Outline& outline, double timeS);

/// Returns the matrix of a list of links.
glm::dmat4 matrixOf(const std::vector<Link>& links, double timeS);

/// Returns the number of elements from the world to the node, as the author counts them.
int depthOf(const Outline& outline, int node);

}  // namespace farol::grade
