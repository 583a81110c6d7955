#pragma once

#include <memory>
#include <string>
#include <vector>

#include "interchange/material.h"
#include "render/plan/instances.h"
#include "render/prepare.h"
#include "render/renderer.h"

namespace farol::interchange {

/// The material of a part of a mesh.
struct Look {
    std::size_t first = 0, count = 0;         ///< of the mesh's indices
    PhongColors colors;                       ///< unlit: diffuse is the colour that shows
    const scene::Texture* texture = nullptr;  ///< null: none
    bool isColored = false;                   ///< the mesh's own colours modulate
    bool isTwoSided = false;
    std::string name;  ///< in its file; may be empty
};

/// A scene that is written for other programs, with the choices of a render of the same job. What
/// other models share with it is found once.
class Subject {
  public:
    /// Reads and places the scene. Throws Error as Renderer::render does where no GL is needed.
    explicit Subject(const render::Job& job);

    const scene::Scene& scene() const { return prepared_.scene; }
    const scene::Assets& assets() const { return *prepared_.assets; }
    Diagnostics& findings() { return prepared_.diagnostics; }
    const render::PictureOptions& options() const { return options_; }
    double timeS() const { return options_.timeS; }
    const scene::Camera& camera() const { return camera_; }
    const glm::ivec2& size() const { return size_; }
    scene::Shading shading() const { return shading_; }
    bool isLit() const { return isLit_; }
    /// All models at their places.
    const render::InstanceList& placed() const { return placed_.scene; }

    /// Returns the mesh of a model. Divisions that the scene leaves open err by at most
    /// kMeshError of the diagonal of its box. The same source gives the same mesh.
    std::shared_ptr<const render::MeshData> meshOf(const scene::Model& model);

    /// Returns the materials of the mesh's triangles, in their order. `in`: the scene or its
    /// entity.
    std::vector<Look> looksOf(const scene::Model& model, const render::MeshData& mesh,
                              const scene::Scene& in) const;

    static constexpr double kMeshError = 5e-4;

  private:
    PhongColors colorsOf(const scene::Material& material, const glm::vec3& ambient,
                         const scene::Scene& in) const;

    render::PictureOptions options_;
    render::Prepared prepared_;
    render::MeshLibrary meshes_;
    scene::Camera camera_;
    glm::ivec2 size_{1};
    render::Placed placed_;
    scene::Shading shading_ = scene::Shading::phong;
    bool isLit_ = true;
};

/// A mesh with texture coordinates for one texture: scaled, offset, or projected. Coordinates have
/// their origin at the image's bottom left.
struct MappedMesh {
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec2> uvs;  ///< empty: none
    std::vector<glm::u8vec4> colors;
    std::vector<std::uint32_t> indices;
    bool isSplit = false;  ///< vertices were added at the seam of a spherical projection
};

/// Coordinates in the viewer's space (texgen eye) depend on the view: they are left out.
MappedMesh mapped(const generator::Mesh& mesh, const scene::Texture* texture);

/// Returns the pairs of vertices of all edges of the triangles, each once.
std::vector<std::uint32_t> edgesOf(const std::vector<std::uint32_t>& indices);

/// An image file as other programs read it.
struct PortableImage {
    std::string bytes;
    std::string_view mime;    ///< image/png or image/jpeg
    std::string_view ending;  ///< png or jpg
};

/// Returns a texture's image: the file itself if it is an undamaged PNG or JPEG without
/// rotation, else as PNG. Throws Error asset.missing, image.*, limit.texture.
PortableImage imageOf(const scene::Texture& texture, const scene::Assets& assets);

}  // namespace farol::interchange
