#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "interchange/gltf/document.h"
#include "interchange/placement.h"
#include "interchange/subject.h"
#include "interchange/write.h"

namespace farol::interchange {

/// Writes one scene as binary glTF.
class GltfWriter {
  public:
    GltfWriter(const render::Job& job, std::size_t maxBytes);
    WrittenScene write();

  private:
    // writer.cpp: nodes.
    struct Parent {
        const scene::Scene* scene;
        nlohmann::json* children;  ///< indices of nodes
    };
    void addScene(const scene::Scene& scene, nlohmann::json& children);
    int addGroup(const scene::Group& group, const scene::Scene& in);
    int addChain(const std::vector<Placement>& chain, const std::string& name,
                 nlohmann::json content);
    nlohmann::json contentOf(const scene::Group& group, const scene::Scene& in);
    int addCamera();
    void addAnimation();
    void noteLosses(const scene::Scene& scene);
    void noteLosses(const scene::Group& group, bool& cycles, bool& texgen, const Location*& first);
    void leaveOut(Message feature, const Location& where);
    void approximate(Message feature, Message instead, const Location& where);

    // meshes.cpp
    std::optional<int> addModel(const scene::Model& model, const scene::Scene& in);
    int addMesh(const scene::Model& model, const render::MeshData& data,
                const std::vector<Look>& looks);
    nlohmann::json attributesOf(const render::MeshData& data, const Look& look, bool hasNormals);
    int addMaterial(const Look& look, bool hasLines);
    std::optional<int> addTexture(const scene::Texture& texture);

    // lights.cpp
    std::optional<int> addLight(const scene::Light& light);
    void addLights(const std::vector<scene::Light>& lights, nlohmann::json& children);

    /// Attributes and indices of a mesh for one projection of texture coordinates.
    struct Geometry {
        int positions = -1, normals = -1, uvs = -1, colors = -1;
        GltfDocument::IndexView indices;
        std::size_t indexCount = 0;
    };
    const Geometry& geometryOf(const render::MeshData& data, const scene::Texture* texture,
                               bool hasLines);

    struct MovingNode {
        int node;
        Placement placement;
    };

    Subject subject_;
    GltfDocument document_;
    WrittenScene written_;
    std::vector<MovingNode> moving_;
    nlohmann::json viewerNodes_ = nlohmann::json::array();  ///< children of the camera's node
    std::map<std::pair<std::uint64_t, std::string>, Geometry> geometries_;
    std::map<std::string, int> images_;  ///< by path and version, or chess board
    std::map<std::string, int> meshes_;  ///< by their primitives
};

}  // namespace farol::interchange
