#pragma once

#include <string>

#include "core/lru_cache.h"
#include "render/gl/objects.h"
#include "render/gl_facts.h"
#include "render/plan/texture_levels.h"

namespace farol::render::gl {

/// Textures by content and filter, kept within a bound of bytes, least recently used first out.
/// 2D textures repeat in u and v unless they are clamped, cube maps are clamped and seamless.
class TextureStore {
  public:
    /// `facts` outlives the store.
    TextureStore(const Api& api, const GlFacts& facts, std::size_t maxBytes)
        : api_(api), facts_(facts), textures_(maxBytes) {}
    struct Entry {
        Texture texture;
        std::vector<TextureNote> notes;
        image::Alpha alpha = image::Alpha::opaque;
    };
    /// Null where it is not here. Valid until the next put().
    const Entry* find(const TextureRef& ref);
    struct Reserved {
        Texture texture;
        int width = 0, height = 0;
    };
    /// Memory and filters for one that is not here and no cube map, before its texels are known;
    /// for the size that is left of `width` x `height` within the GL's.
    Reserved reserve(const TextureRef& ref, int width, int height);
    /// Uploads a texture that is not in the store, into `reserved` if that holds one. Never
    /// evicts the `keep` used last, even over the bound of bytes. Throws std::bad_alloc or
    /// std::runtime_error where the GL refuses it.
    const Entry& put(const TextureRef& ref, Reserved reserved, TextureLevels levels,
                     std::size_t keep);

  private:
    void uploadFaces(const Texture& texture, const TextureLevels& faces);

    const Api& api_;
    const GlFacts& facts_;
    LruCache<std::string, Entry> textures_;
};

}  // namespace farol::render::gl
