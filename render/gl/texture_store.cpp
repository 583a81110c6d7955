#include "render/gl/texture_store.h"

#include <algorithm>

namespace farol::render::gl {
namespace {

// Of ARB_texture_filter_anisotropic, core since 4.6; the value is the extension's too.
constexpr GLenum kTextureAnisotropy = 0x84FE;
constexpr float kWantedAnisotropy = 16.0F;

std::string keyOf(const TextureRef& ref) {
    return (ref.cube ? "cube" : std::to_string(static_cast<int>(ref.filter))) +
           (ref.clamp ? "clamp" : "") + std::to_string(static_cast<int>(ref.alpha)) + '\n' +
           ref.key;
}

}  // namespace

const TextureStore::Entry* TextureStore::find(const TextureRef& ref) {
    return textures_.find(keyOf(ref));
}

TextureStore::Reserved TextureStore::reserve(const TextureRef& ref, int width, int height) {
    width = std::min(width, facts_.maxTextureSide);
    height = std::min(height, facts_.maxTextureSide);
    Reserved reserved{Texture(api_), width, height};
    api_.BindTexture(GL_TEXTURE_2D, reserved.texture.name());
    GLsizei levels = 1;
    if (mipmapped(ref.filter))
        for (int side = std::max(width, height); side > 1; side /= 2) ++levels;
    api_.TexStorage2D(GL_TEXTURE_2D, levels, GL_RGBA8, width, height);
    const GLint magnify = ref.filter == scene::Filter::nearest ? GL_NEAREST : GL_LINEAR;
    api_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, magnify);
    api_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER,
                       mipmapped(ref.filter) ? GL_LINEAR_MIPMAP_LINEAR : magnify);
    const GLint wrap = ref.clamp ? GL_CLAMP_TO_EDGE : GL_REPEAT;
    api_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap);
    api_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap);
    if (ref.filter == scene::Filter::anisotropic)
        api_.TexParameterf(GL_TEXTURE_2D, kTextureAnisotropy,
                           std::min(kWantedAnisotropy, facts_.maxAnisotropy));
    return reserved;
}

const TextureStore::Entry& TextureStore::put(const TextureRef& ref, Reserved reserved,
                                             TextureLevels levels, std::size_t keep) {
    std::size_t bytes = 0;
    for (const image::Image& image : levels.images) bytes += image.pixels.size();
    if (ref.cube) {
        reserved.texture = Texture(api_);
        uploadFaces(reserved.texture, levels);
    } else {
        const image::Image& base = levels.images.front();
        // A file's head may give another size than its pixels have.
        if (!reserved.texture || base.width != reserved.width || base.height != reserved.height)
            reserved = reserve(ref, base.width, base.height);
        api_.BindTexture(GL_TEXTURE_2D, reserved.texture.name());
        GLint level = 0;
        for (const image::Image& image : levels.images)
            api_.TexSubImage2D(GL_TEXTURE_2D, level++, 0, 0, image.width, image.height, GL_RGBA,
                               GL_UNSIGNED_BYTE, image.pixels.data());
    }
    throwOnError(api_, "uploading a texture");  // before it is kept for other jobs
    return textures_.put(keyOf(ref),
                         {std::move(reserved.texture), std::move(levels.notes), levels.alpha},
                         bytes, keep);
}

void TextureStore::uploadFaces(const Texture& texture, const TextureLevels& faces) {
    api_.BindTexture(GL_TEXTURE_CUBE_MAP, texture.name());
    GLenum face = GL_TEXTURE_CUBE_MAP_POSITIVE_X;
    for (const image::Image& image : faces.images)
        api_.TexImage2D(face++, 0, GL_RGBA8, image.width, image.height, 0, GL_RGBA,
                        GL_UNSIGNED_BYTE, image.pixels.data());
    api_.TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAX_LEVEL, 0);
    api_.TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    api_.TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
}

}  // namespace farol::render::gl
