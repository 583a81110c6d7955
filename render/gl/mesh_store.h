#pragma once

#include <cstdint>

#include "core/lru_cache.h"
#include "render/gl/objects.h"
#include "render/plan/mesh_library.h"

namespace farol::render::gl {

/// A mesh in GL memory. flat: three separate vertices for each triangle, with the face's normal and
/// middle (attribute 3), drawn without indices.
struct GpuMesh {
    VertexArray array;
    Buffer vertices, indices, colors, eyePositions, litCorners;
    GLsizei count = 0;
    bool indexed = true;
    std::size_t bytes = 0;
};

/// Where an instance stands: attributes 4 to 11 of the model's shader, one for all of its vertices.
struct PlaceVertex {
    glm::mat4 viewFromObject;
    glm::mat3 normalFromObject;
    glm::vec3 surfaceEye;
};

/// Meshes by MeshData::id, kept within a bound of bytes, least recently used first out.
class MeshStore {
  public:
    /// `places`: of instances (PlaceVertex), which every mesh's array reads beside its vertices.
    MeshStore(const Api& api, const Buffer& places, std::size_t maxBytes)
        : api_(api), places_(places), meshes_(maxBytes) {}
    /// Valid until the next call.
    const GpuMesh& get(const MeshData& data, bool flat);

  private:
    struct Key {
        std::uint64_t id;
        bool flat;
        auto operator<=>(const Key&) const = default;
    };
    const Api& api_;
    const Buffer& places_;
    LruCache<Key, GpuMesh> meshes_;
};

}  // namespace farol::render::gl
