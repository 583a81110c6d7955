#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "render/image.h"
#include "render/texture_ref.h"

namespace farol::render {

/// A texture as GL takes it: the levels from the largest down, bottom row first; of a cube map the
/// six faces, top row first.
struct TextureLevels {
    std::vector<Image> images;
};

/// True where the filter reads smaller levels.
bool mipmapped(scene::Filter filter);

/// A picture whose file is read: how large it claims to be, and how to get it. `decode` may be
/// called in any thread and may throw Error image.*.
struct UndecodedTexture {
    int width = 0, height = 0;  ///< 0: told by decode alone, and small
    std::function<Image()> decode;
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

/// Decodes pictures and makes their levels, several at once. Of several faults the first in their
/// order is thrown.
void loadTextures(const std::vector<const TextureRef*>& refs, const OpenTexture& open,
                  const TextureTaker& taker);

}  // namespace farol::render
