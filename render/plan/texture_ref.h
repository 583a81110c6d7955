#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "scene/files/assets.h"
#include "scene/scene.h"

namespace farol::render {

/// Handling of a picture's alpha: not used; left out, with a note where it is not opaque; or kept,
/// with premultiplied colours.
enum class AlphaUse { none, ignored, kept };

/// A picture that draws sample: an asset or a chess board. `key` names its content.
struct TextureRef {
    std::string key, path;
    std::optional<scene::Chess> chess;
    bool cube = false;   ///< a skybox's cross
    bool clamp = false;  ///< its edge goes on beyond it
    scene::Filter filter = scene::Filter::mipmap;
    AlphaUse alpha = AlphaUse::none;
    Location where;
};

/// The picture of a model's texture, with the filter it asks for itself.
TextureRef refOf(const scene::Texture& texture, const scene::Assets& assets);
/// The picture in a file of the assets.
TextureRef refOf(const std::string& path, const scene::Assets& assets);

/// A texgen plane for places relative to `origin` (the space of the plane), for GL. Where the
/// texture repeats, whole turns of a far offset are left out: a float would lose the rest.
glm::vec4 texgenPlane(glm::dvec4 plane, const glm::dvec3& origin, bool clamp);
/// Scale and offset of mesh coordinates that `uvOrigin` was subtracted from; turns likewise.
glm::vec4 uvPlacement(const scene::Texture& texture, const glm::dvec2& uvOrigin);

}  // namespace farol::render
