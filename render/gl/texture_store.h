#pragma once

#include <functional>
#include <list>
#include <map>
#include <string>

#include "render/gl/objects.h"
#include "render/image.h"
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
    struct Entry {
        std::string key;
        Texture texture;
        std::size_t bytes;
    };
    GLuint keep(Entry entry);
    const Entry* find(const std::string& key);

    const Api& api_;
    std::size_t maxBytes_, bytes_ = 0;
    float maxAnisotropy_ = 1.0F;
    std::list<Entry> entries_;  ///< most recent first
    std::map<std::string, std::list<Entry>::iterator> byKey_;
};

}  // namespace farol::render::gl
