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
    std::int64_t pixels = 0;
    std::function<Image()> decode;
};

/// Reads a picture's file and its head. May throw Error asset.*, image.*, limit.*.
using OpenTexture = std::function<UndecodedTexture(const TextureRef&)>;

/// Decodes pictures and makes their levels, several at once; `take` gets them in their order, in
/// the caller's thread. Of several faults the first in that order is thrown.
void loadTextures(const std::vector<const TextureRef*>& refs, const OpenTexture& open,
                  const std::function<void(const TextureRef&, const TextureLevels&)>& take);

}  // namespace farol::render
