#pragma once

#include <cstdint>

#include "render/gl/objects.h"
#include "render/lru.h"
#include "render/mesh_library.h"

namespace farol::render::gl {

/// A mesh in GL memory. flat: three vertices of its own a triangle, with the face's normal and
/// middle (attribute 3), drawn without indices.
struct GpuMesh {
    VertexArray array;
    Buffer vertices, indices;
    GLsizei count = 0;
    bool indexed = true;
    std::size_t bytes = 0;
};

/// Meshes by MeshData::id, kept within a bound of bytes, least recently used first out.
class MeshStore {
  public:
    MeshStore(const Api& api, std::size_t maxBytes) : api_(api), meshes_(maxBytes) {}
    /// Valid until the next call.
    const GpuMesh& get(const MeshData& data, bool flat);

  private:
    struct Key {
        std::uint64_t id;
        bool flat;
        auto operator<=>(const Key&) const = default;
    };
    const Api& api_;
    LruCache<Key, GpuMesh> meshes_;
};

}  // namespace farol::render::gl
