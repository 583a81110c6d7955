#pragma once

#include <string>

#include "render/gl/objects.h"
#include "render/lru.h"
#include "render/texture_levels.h"

namespace farol::render::gl {

/// Textures by content and filter, kept within a bound of bytes, least recently used first out.
/// 2D textures repeat in u and v, cube maps are clamped and seamless.
class TextureStore {
  public:
    TextureStore(const Api& api, std::size_t maxBytes);
    /// The texture's name, or 0 where it is not here.
    GLuint find(const TextureRef& ref);
    struct Reserved {
        Texture texture;
        int width = 0, height = 0;
    };
    /// Memory and filters for one that is not here and no cube map, before its texels are known.
    Reserved reserve(const TextureRef& ref, int width, int height);
    /// Uploads one that is not here into what was reserved for it, if it was; its name. The `keep`
    /// used last stay, whatever they take.
    GLuint put(const TextureRef& ref, Reserved reserved, const TextureLevels& levels,
               std::size_t keep);

  private:
    void uploadFaces(const Texture& texture, const TextureLevels& faces);

    const Api& api_;
    float maxAnisotropy_ = 1.0F;
    LruCache<std::string, Texture> textures_;
};

}  // namespace farol::render::gl
