#include "render/gl/mesh_store.h"

#include <vector>

namespace farol::render::gl {
namespace {

struct Vertex {
    glm::vec3 position{0.0F};
    glm::vec3 normal{0.0F};
    glm::vec2 uv{0.0F};
};
struct FlatVertex {
    Vertex vertex;
    glm::vec3 center{0.0F};
};

Vertex vertexOf(const generator::Mesh& mesh, std::uint32_t index) {
    Vertex vertex{mesh.positions()[index], glm::vec3(0.0F), glm::vec2(0.0F)};
    if (!mesh.normals().empty()) vertex.normal = mesh.normals()[index];
    if (!mesh.uvs().empty()) vertex.uv = mesh.uvs()[index];
    return vertex;
}

const void* offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

template <typename T>
void fill(const Api& api, const Buffer& buffer, GLenum target, const std::vector<T>& values) {
    api.BindBuffer(target, buffer.name());
    api.BufferData(target, static_cast<GLsizeiptr>(values.size() * sizeof(T)), values.data(),
                   GL_STATIC_DRAW);
}

void attribute(const Api& api, GLuint location, GLint size, std::size_t stride, std::size_t at) {
    api.EnableVertexAttribArray(location);
    api.VertexAttribPointer(location, size, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride),
                            offset(at));
}

/// The mesh's own colours, attribute 12, where it has any. Returns their bytes.
std::size_t addColors(const Api& api, GpuMesh& gpu, const generator::Mesh& mesh, bool flat) {
    if (mesh.colors().empty()) return 0;
    std::vector<glm::u8vec4> colors;
    if (flat)
        for (const std::uint32_t index : mesh.indices()) colors.push_back(mesh.colors()[index]);
    const std::vector<glm::u8vec4>& all = flat ? colors : mesh.colors();
    gpu.colors = Buffer(api);
    fill(api, gpu.colors, GL_ARRAY_BUFFER, all);
    constexpr GLuint kLocation = 12;
    api.EnableVertexAttribArray(kLocation);
    api.VertexAttribPointer(kLocation, 4, GL_UNSIGNED_BYTE, GL_TRUE, 0, nullptr);
    return all.size() * sizeof(glm::u8vec4);
}

/// The corners of each vertex's triangle, attributes 3 to 9 in place of an instance's. Returns
/// their bytes.
std::size_t addLitCorners(const Api& api, GpuMesh& gpu, const std::vector<LitCorners>& corners) {
    gpu.litCorners = Buffer(api);
    fill(api, gpu.litCorners, GL_ARRAY_BUFFER, corners);
    for (GLuint i = 0; i < 7; ++i)
        attribute(api, 3 + i, 3, sizeof(LitCorners), i * sizeof(glm::vec3));
    return corners.size() * sizeof(LitCorners);
}

/// Where vertices are for the viewer, attribute 13, where that was computed. Returns their bytes.
std::size_t addEyePositions(const Api& api, GpuMesh& gpu, const MeshData& data, bool flat) {
    if (data.eyePositions.empty()) return 0;
    std::vector<glm::vec3> corners;
    if (flat)
        for (const std::uint32_t index : data.mesh.indices())
            corners.push_back(data.eyePositions[index]);
    const std::vector<glm::vec3>& all = flat ? corners : data.eyePositions;
    gpu.eyePositions = Buffer(api);
    fill(api, gpu.eyePositions, GL_ARRAY_BUFFER, all);
    attribute(api, 13, 3, sizeof(glm::vec3), 0);
    return all.size() * sizeof(glm::vec3);
}

/// Three separate vertices for each triangle, with its normal and middle.
std::vector<FlatVertex> facesOf(const MeshData& data) {
    const generator::Mesh& mesh = data.mesh;
    const std::vector<std::uint32_t>& indices = mesh.indices();
    std::vector<FlatVertex> vertices;
    vertices.reserve(indices.size());
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        Vertex corners[3];
        for (std::size_t c = 0; c < 3; ++c) corners[c] = vertexOf(mesh, indices[i + c]);
        if (!data.faceCenters.empty()) {  // pieces of faces know theirs
            for (const Vertex& corner : corners)
                vertices.push_back({corner, data.faceCenters[indices[i]]});
            continue;
        }
        const glm::dvec3 a(corners[0].position), b(corners[1].position), c(corners[2].position);
        const glm::dvec3 cross = glm::cross(b - a, c - a);
        const double size = glm::length(cross);
        for (Vertex& corner : corners) {
            if (size > 0.0) corner.normal = glm::vec3(cross / size);
            vertices.push_back({corner, glm::vec3((a + b + c) / 3.0)});
        }
    }
    return vertices;
}

/// Read by the shader of instances alone.
void addPlaces(const Api& api, const Buffer& places) {
    api.BindBuffer(GL_ARRAY_BUFFER, places.name());
    for (GLuint i = 0; i < 8; ++i) {
        const GLuint location = 4 + i;
        const std::size_t at =
            i < 4   ? offsetof(PlaceVertex, viewFromObject) + i * sizeof(glm::vec4)
            : i < 7 ? offsetof(PlaceVertex, normalFromObject) + (i - 4) * sizeof(glm::vec3)
                    : offsetof(PlaceVertex, surfaceEye);
        attribute(api, location, i < 4 ? 4 : 3, sizeof(PlaceVertex), at);
        api.VertexAttribDivisor(location, 1);
    }
}

GpuMesh upload(const Api& api, const MeshData& data, bool flat, const Buffer& places) {
    const generator::Mesh& mesh = data.mesh;
    GpuMesh gpu;
    gpu.array = VertexArray(api);
    gpu.vertices = Buffer(api);
    gpu.count = static_cast<GLsizei>(mesh.indices().size());
    gpu.indexed = !flat;
    api.BindVertexArray(gpu.array.name());
    const std::size_t stride = flat ? sizeof(FlatVertex) : sizeof(Vertex);
    if (flat) {
        const std::vector<FlatVertex> vertices = facesOf(data);
        fill(api, gpu.vertices, GL_ARRAY_BUFFER, vertices);
        gpu.bytes = vertices.size() * stride;
        attribute(api, 3, 3, stride, offsetof(FlatVertex, center));
    } else {
        std::vector<Vertex> vertices;
        vertices.reserve(mesh.positions().size());
        for (std::uint32_t i = 0; i < mesh.positions().size(); ++i)
            vertices.push_back(vertexOf(mesh, i));
        fill(api, gpu.vertices, GL_ARRAY_BUFFER, vertices);
        gpu.indices = Buffer(api);
        fill(api, gpu.indices, GL_ELEMENT_ARRAY_BUFFER, mesh.indices());
        gpu.bytes = vertices.size() * stride + mesh.indices().size() * sizeof(std::uint32_t);
    }
    attribute(api, 0, 3, stride, offsetof(Vertex, position));
    attribute(api, 1, 3, stride, offsetof(Vertex, normal));
    attribute(api, 2, 2, stride, offsetof(Vertex, uv));
    gpu.bytes += addColors(api, gpu, mesh, flat);
    gpu.bytes += addEyePositions(api, gpu, data, flat);
    if (data.litCorners.empty())
        addPlaces(api, places);
    else
        gpu.bytes += addLitCorners(api, gpu, data.litCorners);
    return gpu;
}

}  // namespace

const GpuMesh& MeshStore::get(const MeshData& data, bool flat) {
    const Key key{data.id, flat};
    if (const GpuMesh* known = meshes_.find(key)) return *known;
    GpuMesh mesh = upload(api_, data, flat, places_);
    throwOnError(api_, "uploading a mesh");  // before it is kept for other jobs
    const std::size_t bytes = mesh.bytes;
    return meshes_.put(key, std::move(mesh), bytes);
}

}  // namespace farol::render::gl
