#include "render/gl/texture_store.h"

#include <algorithm>

namespace farol::render::gl {
namespace {

// Of ARB_texture_filter_anisotropic, core since 4.6; the value is the extension's too.
constexpr GLenum kMaxAnisotropy = 0x84FF;
constexpr GLenum kTextureAnisotropy = 0x84FE;
constexpr float kWantedAnisotropy = 16.0F;

void uploadLevel(const Api& api, GLenum target, GLint level, const Image& image) {
    api.TexImage2D(target, level, GL_RGBA8, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                   image.pixels.data());
}

std::string keyOf(const TextureRef& ref) {
    return (ref.cube ? "cube" : std::to_string(static_cast<int>(ref.filter))) + '\n' + ref.key;
}

}  // namespace

TextureStore::TextureStore(const Api& api, std::size_t maxBytes) : api_(api), textures_(maxBytes) {
    api_.GetFloatv(kMaxAnisotropy, &maxAnisotropy_);
    if (api_.GetError() != GL_NO_ERROR) maxAnisotropy_ = 1.0F;
}

GLuint TextureStore::find(const TextureRef& ref) {
    const Texture* known = textures_.find(keyOf(ref));
    return known ? known->name() : 0;
}

GLuint TextureStore::put(const TextureRef& ref, const TextureLevels& levels, std::size_t keep) {
    Texture texture(api_);
    std::size_t bytes = 0;
    for (const Image& image : levels.images) bytes += image.pixels.size();
    if (ref.cube)
        uploadFaces(texture, levels);
    else
        uploadLevels(texture, ref.filter, levels);
    return textures_.put(keyOf(ref), std::move(texture), bytes, keep).name();
}

void TextureStore::uploadLevels(const Texture& texture, scene::Filter filter,
                                const TextureLevels& levels) {
    api_.BindTexture(GL_TEXTURE_2D, texture.name());
    GLint level = 0;
    for (const Image& image : levels.images) uploadLevel(api_, GL_TEXTURE_2D, level++, image);
    api_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, level - 1);
    const GLint magnify = filter == scene::Filter::nearest ? GL_NEAREST : GL_LINEAR;
    api_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, magnify);
    api_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER,
                       mipmapped(filter) ? GL_LINEAR_MIPMAP_LINEAR : magnify);
    api_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    api_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
    if (filter == scene::Filter::anisotropic)
        api_.TexParameterf(GL_TEXTURE_2D, kTextureAnisotropy,
                           std::min(kWantedAnisotropy, maxAnisotropy_));
}

void TextureStore::uploadFaces(const Texture& texture, const TextureLevels& faces) {
    api_.BindTexture(GL_TEXTURE_CUBE_MAP, texture.name());
    GLenum face = GL_TEXTURE_CUBE_MAP_POSITIVE_X;
    for (const Image& image : faces.images) uploadLevel(api_, face++, 0, image);
    api_.TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAX_LEVEL, 0);
    api_.TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    api_.TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
}

}  // namespace farol::render::gl
