#pragma once

#include <functional>
#include <string>

#include "render/gl/objects.h"
#include "render/image.h"
#include "render/lru.h"
#include "scene/scene.h"

namespace farol::render::gl {

/// Textures by content and filter, kept within a bound of bytes, least recently used first out.
/// The first row of an Image is the top of the picture; texture coordinates start bottom left.
class TextureStore {
  public:
    TextureStore(const Api& api, std::size_t maxBytes);
    /// The texture's name; `decode` is called when it is not here yet. Repeats in u and v.
    GLuint get(const std::string& key, scene::Filter filter, const std::function<Image()>& decode);
    /// The six faces of a cube map, cut from a 4x3 cross (see skybox.h); clamped and seamless.
    GLuint getCube(const std::string& key, const std::function<Image()>& decode);

  private:
    const Api& api_;
    float maxAnisotropy_ = 1.0F;
    LruCache<std::string, Texture> textures_;
};

}  // namespace farol::render::gl
