#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "render/renderer.h"
#include "scene/write/writer.h"

/// Scenes for other programs.
namespace farol::interchange {

/// Most bytes of a written model.
inline constexpr std::size_t kMaxModelBytes = std::size_t{256} << 20U;

/// A file beside a model's own: a material library, a texture.
struct SideFile {
    std::string name;
    std::string bytes;
};

/// A scene as a file of another program, and its content in numbers.
struct WrittenScene {
    std::string bytes;
    std::vector<SideFile> beside;
    Diagnostics diagnostics;  ///< of the scene, and what its format cannot express (convert.*)
    std::int64_t nodes = 0, meshes = 0, materials = 0, textures = 0, lights = 0;
    std::int64_t triangles = 0;   ///< of the meshes, each once
    std::int64_t animations = 0;  ///< channels
};

/// Binary glTF 2.0: one self-contained file. Groups become nodes and keep their names; models of
/// one source share a mesh. Motions are sampled over one loop (placement.h), materials become
/// physically based ones (material.h), lights KHR_lights_punctual. `maxBytes`: of the
/// file. Throws Error as Renderer::render does, and limit.model.
WrittenScene writeGlb(const render::Job& job, std::size_t maxBytes);

/// Wavefront OBJ with a material library and textures beside it, in world coordinates at the job's
/// time. `stem`: of their names. Throws Error as writeGlb does.
WrittenScene writeObj(const render::Job& job, const std::string& stem, std::size_t maxBytes);

/// A document in a dialect's own words, or canonical. File names stay relative to the scene's
/// folder. The numbers of WrittenScene are not counted. Throws Error as writeGlb does.
WrittenScene writeXml(const render::Job& job, scene::Form form);

}  // namespace farol::interchange
