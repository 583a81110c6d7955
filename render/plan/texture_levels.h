#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "image/alpha.h"
#include "image/image.h"
#include "render/gl_facts.h"
#include "render/plan/skybox.h"
#include "render/plan/texture_ref.h"

namespace farol::render {

/// A finding about a texture's file without the file's name, which differs between scenes that
/// share the texture.
struct TextureNote {
    /// alphaIgnored: AlphaUse::ignored of one that is not opaque; alphaUnset: 0 everywhere.
    enum class Kind { scaled, damaged, noCross, alphaIgnored, alphaUnset };
    Kind kind = Kind::scaled;
    int width = 0, height = 0;  ///< of the file, px
    /// scaled: the size that is used instead, "16384 x 2 px"; damaged: as decodeImage sets it.
    std::string detail = {};
};

/// The note as a finding of the scene that samples the texture by `ref`: a warning, or an info of
/// its alpha.
Diagnostic findingOf(const TextureNote& note, const TextureRef& ref);

/// The findings that a file's size alone gives: noCross, scaled.
std::vector<TextureNote> sizeNotes(bool isCube, int width, int height, const GlFacts& gl);

/// A texture as GL takes it: the levels from the largest down, bottom row first; of a cube map the
/// six faces, top row first.
struct TextureLevels {
    std::vector<image::Image> images;
    std::vector<TextureNote> notes;
    image::Alpha alpha = image::Alpha::opaque;  ///< else the colours are premultiplied
};

/// True where the filter reads smaller levels.
bool mipmapped(scene::Filter filter);

/// An image whose file is read: the size that its head gives, and its decoder. `decode` may be
/// called in any thread and may throw Error image.*.
struct UndecodedTexture {
    int width = 0, height = 0;  ///< 0: known after decode alone, and small
    bool mayHaveAlpha = false;  ///< by its head
    /// Sets its argument as decodeImage sets `damage`.
    std::function<image::Image(std::string&)> decode;
};

/// Reads an image's file and its head. May throw Error asset.*, image.*, limit.*.
using OpenTexture = std::function<UndecodedTexture(const TextureRef&)>;

/// Of images that are decoded at once, with up to 14 bytes a pixel. A larger one is decoded alone.
inline constexpr std::int64_t kMaxPixelsAtOnce = 16 << 20;

/// Callbacks of loadTextures, called in the caller's thread.
struct TextureLoading {
    /// For each texture in their order, before it is decoded.
    std::function<void(const TextureRef&, const UndecodedTexture&)> onReserved = nullptr;
    /// Once, while the first of them are being decoded.
    std::function<void()> whileDecoding = nullptr;
    /// For each texture in their order.
    std::function<void(const TextureRef&, const TextureLevels&)> onDecoded;
};

/// Decodes images, scales those down that the GL does not take as large, and makes their levels,
/// several at once. Of several faults the first in their order is thrown.
void loadTextures(const std::vector<const TextureRef*>& refs, const OpenTexture& open,
                  const TextureLoading& callbacks, const GlFacts& gl);

}  // namespace farol::render
