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

TextureStore::TextureStore(const Api& api, std::size_t maxBytes) : api_(api), maxBytes_(maxBytes) {
    api_.GetFloatv(kMaxAnisotropy, &maxAnisotropy_);
    if (api_.GetError() != GL_NO_ERROR) maxAnisotropy_ = 1.0F;
}

const TextureStore::Entry* TextureStore::find(const std::string& key) {
    const auto found = byKey_.find(key);
    if (found == byKey_.end()) return nullptr;
    entries_.splice(entries_.begin(), entries_, found->second);
    return &entries_.front();
}

GLuint TextureStore::keep(Entry entry) {
    bytes_ += entry.bytes;
    entries_.push_front(std::move(entry));
    byKey_[entries_.front().key] = entries_.begin();
    while (bytes_ > maxBytes_ && entries_.size() > 1) {
        bytes_ -= entries_.back().bytes;
        byKey_.erase(entries_.back().key);
        entries_.pop_back();
    }
    return entries_.front().texture.name();
}

GLuint TextureStore::get(const std::string& key, scene::Filter filter,
                         const std::function<Image()>& decode) {
    const std::string full = std::to_string(static_cast<int>(filter)) + '\n' + key;
    if (const Entry* entry = find(full)) return entry->texture.name();
    const Image image = decode();
    Entry entry{full, Texture(api_), image.pixels.size()};
    api_.BindTexture(GL_TEXTURE_2D, entry.texture.name());
    uploadLevel(api_, GL_TEXTURE_2D, 0, image, true);
    const bool mipmaps = filter == scene::Filter::mipmap || filter == scene::Filter::anisotropic;
    GLint level = 0;
    if (mipmaps)
        for (const Image& smaller : buildMipmaps(image)) {
            uploadLevel(api_, GL_TEXTURE_2D, ++level, smaller, true);
            entry.bytes += smaller.pixels.size();
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
    return keep(std::move(entry));
}

GLuint TextureStore::getCube(const std::string& key, const std::function<Image()>& decode) {
    const std::string full = "cube\n" + key;
    if (const Entry* entry = find(full)) return entry->texture.name();
    const std::array<Image, 6> faces = cutCross(decode());
    Entry entry{full, Texture(api_), 0};
    api_.BindTexture(GL_TEXTURE_CUBE_MAP, entry.texture.name());
    for (GLenum face = 0; face < 6; ++face) {
        uploadLevel(api_, GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, faces[face], false);
        entry.bytes += faces[face].pixels.size();
    }
    api_.TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAX_LEVEL, 0);
    api_.TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    api_.TexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    return keep(std::move(entry));
}

}  // namespace farol::render::gl
