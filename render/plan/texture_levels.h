#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "image/image.h"
#include "render/gl_facts.h"
#include "render/plan/skybox.h"
#include "render/plan/texture_ref.h"

namespace farol::render {

/// A warning about a texture's file without the file's name, which differs between scenes that
/// share the texture: "is 20000 x 2 px; ...".
struct TextureNote {
    const char* code;
    std::string text;
};

/// The note as a warning of the scene that samples the texture by `ref`.
Diagnostic warningOf(const TextureNote& note, const TextureRef& ref);

/// A texture as GL takes it: the levels from the largest down, bottom row first; of a cube map the
/// six faces, top row first.
struct TextureLevels {
    std::vector<image::Image> images;
    std::vector<TextureNote> notes;
};

/// True where the filter reads smaller levels.
bool mipmapped(scene::Filter filter);

/// A picture whose file is read: how large it claims to be, and how to get it. `decode` may be
/// called in any thread and may throw Error image.*.
struct UndecodedTexture {
    int width = 0, height = 0;  ///< 0: told by decode alone, and small
    /// Sets its argument as decodeImage sets `damage`.
    std::function<image::Image(std::string&)> decode;
};

/// Reads a picture's file and its head. May throw Error asset.*, image.*, limit.*.
using OpenTexture = std::function<UndecodedTexture(const TextureRef&)>;

/// What becomes of pictures that are loaded; all of it is called in the caller's thread.
struct TextureTaker {
    /// In their order, before they are decoded.
    std::function<void(const TextureRef&, const UndecodedTexture&)> expect = nullptr;
    /// Once, while the first of them are being decoded.
    std::function<void()> meanwhile = nullptr;
    /// In their order.
    std::function<void(const TextureRef&, const TextureLevels&)> take;
};

/// Decodes images, scales those down that the GL does not take as large, and makes their levels,
/// several at once. Of several faults the first in their order is thrown.
void loadTextures(const std::vector<const TextureRef*>& refs, const OpenTexture& open,
                  const TextureTaker& taker, const GlFacts& gl);

}  // namespace farol::render
