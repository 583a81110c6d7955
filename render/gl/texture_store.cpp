#include "render/gl/texture_store.h"

#include <algorithm>
#include <vector>

#include "render/skybox.h"

namespace farol::render::gl {
namespace {

// Of ARB_texture_filter_anisotropic, core since 4.6; the value is the extension's too.
constexpr GLenum kMaxAnisotropy = 0x84FF;
constexpr GLenum kTextureAnisotropy = 0x84FE;
constexpr float kWantedAnisotropy = 16.0F;

void uploadLevel(const Api& api, GLenum target, GLint level, const Image& image, bool flip) {
    const std::uint8_t* pixels = image.pixels.data();
    std::vector<std::uint8_t> flipped;
    if (flip) {
        const std::size_t stride = static_cast<std::size_t>(image.width) * 4;
        flipped.resize(image.pixels.size());
        for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y)
            std::copy_n(&image.pixels[y * stride], stride,
                        &flipped[flipped.size() - (y + 1) * stride]);
        pixels = flipped.data();
    }
    api.TexImage2D(target, level, GL_RGBA8, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                   pixels);
}

}  // namespace

TextureStore::TextureStore(const Api& api, std::size_t maxBytes) : api_(api), textures_(maxBytes) {
    api_.GetFloatv(kMaxAnisotropy, &maxAnisotropy_);
    if (api_.GetError() != GL_NO_ERROR) maxAnisotropy_ = 1.0F;
}

GLuint TextureStore::get(const std::string& key, scene::Filter filter,
                         const std::function<Image()>& decode) {
    const std::string full = std::to_string(static_cast<int>(filter)) + '\n' + key;
    if (const Texture* known = textures_.find(full)) return known->name();
    const Image image = decode();
    Texture texture(api_);
    std::size_t bytes = image.pixels.size();
    api_.BindTexture(GL_TEXTURE_2D, texture.name());
    uploadLevel(api_, GL_TEXTURE_2D, 0, image, true);
    const bool mipmaps = filter == scene::Filter::mipmap || filter == scene::Filter::anisotropic;
    GLint level = 0;
    if (mipmaps)
        for (const Image& smaller : buildMipmaps(image)) {
            uploadLevel(api_, GL_TEXTURE_2D, ++level, smaller, true);
            bytes += smaller.pixels.size();
        }
    api_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, level);
    const GLint magnify = filter == scene::Filter::nearest ? GL_NEAREST : GL_LINEAR;
    api_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, magnify);
    api_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER,
                       mipmaps ? GL_LINEAR_MIPMAP_LINEAR : magnify);
    api_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    api_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
    if (filter == scene::Filter::anisotropic)
        api_.TexParameterf(GL_TEXTURE_2D, kTextureAnisotropy,
                           std::min(kWantedAnisotropy, maxAnisotropy_));
    return textures_.put(full, std::move(texture), bytes).name();
}

GLuint TextureStore::getCube(const std::string& key, const std::function<Image()>& decode) {
    const std::string full = "cube\n" + key;
    if (const Texture* known = textures_.find(full)) return known->name();
    const std::array<Image, 6> faces = cutCross(decode());
    Texture texture(api_);
    std::size_t bytes = 0;
    api_.BindTexture(GL_TEXTURE_CUBE_MAP, texture.name());
    for (GLenum face = 0; face < 6; ++face) {
        uploadLevel(api_, GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, faces[face], false);
        bytes += faces[face].pixels.size();
    }
    api_.TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAX_LEVEL, 0);
    api_.TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    api_.TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    return textures_.put(full, std::move(texture), bytes).name();
}

}  // namespace farol::render::gl
