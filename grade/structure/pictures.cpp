#include "grade/structure/pictures.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "image/alpha.h"
#include "image/image_file.h"

namespace farol::grade {
namespace {

constexpr int kSameTexelLevels = 12;  // of 255: JPEG and other formats of the same picture

constexpr int kSameAlphaLevels = 3;  // of 255: formats keep it

/// An image that shows its alpha: none is one that is 255 or unset everywhere.
struct Texels {
    image::Image image;
    bool hasAlpha;
};

Texels decoded(const std::string& bytes, const scene::Texture& texture) {
    std::string damage;  // drawing the scene warns of it
    Texels texels{image::decodeImage(bytes, texture.path, texture.where, &damage), false};
    texels.hasAlpha = image::classifyAlpha(texels.image) != image::Alpha::opaque;
    if (!texels.hasAlpha)
        for (std::size_t i = 3; i < texels.image.pixels.size(); i += 4)
            texels.image.pixels[i] = 255;
    return texels;
}

/// Mean differences of levels, where the texels are compared; of nothing: 255.
struct Difference {
    double colors = 255.0, alpha = 255.0;
};

/// Differences to `mine`, mirrored by the flags; samples some rows and columns. Colours count as
/// much as both are opaque: those of transparent texels are not seen.
Difference differenceOf(const image::Image& theirs, const image::Image& mine, bool flipX,
                        bool flipY) {
    double colors = 0.0, alpha = 0.0, weights = 0.0;
    std::size_t count = 0;
    const int stepX = std::max(1, mine.width / 128), stepY = std::max(1, mine.height / 128);
    const auto at = [&](const image::Image& image, int u, int v) {
        return &image.pixels[4 *
                             (static_cast<std::size_t>(v) * static_cast<std::size_t>(image.width) +
                              static_cast<std::size_t>(u))];
    };
    for (int y = 0; y < mine.height; y += stepY)
        for (int x = 0; x < mine.width; x += stepX, ++count) {
            const std::uint8_t* a = at(theirs, x, y);
            const std::uint8_t* b =
                at(mine, flipX ? mine.width - 1 - x : x, flipY ? mine.height - 1 - y : y);
            const double weight = std::min(a[3], b[3]);
            int apart = 0;
            for (int c = 0; c < 3; ++c) apart += std::abs(a[c] - b[c]);
            colors += weight * apart / 3.0;
            weights += weight;
            alpha += std::abs(a[3] - b[3]);
        }
    Difference found;
    if (weights > 0.0) found.colors = colors / weights;
    if (count > 0) found.alpha = alpha / static_cast<double>(count);
    return found;
}

TextureMatch matchOf(const Texels& theirs, const Texels& mine) {
    TextureMatch match{Turn::other, true, mine.hasAlpha, theirs.hasAlpha};
    if (theirs.image.width != mine.image.width || theirs.image.height != mine.image.height)
        return match;
    constexpr std::array<Turn, 4> kTurns{Turn::none, Turn::mirrored, Turn::upsideDown, Turn::both};
    // Where both have an alpha, it is part of the picture.
    const bool areCut = theirs.hasAlpha && mine.hasAlpha;
    double least = 1e9, alpha = 0.0;
    for (std::size_t i = 0; i < kTurns.size(); ++i) {
        const Difference found = differenceOf(theirs.image, mine.image, (i & 1) != 0, (i & 2) != 0);
        const double sum = found.colors + (areCut ? found.alpha : 0.0);
        if (found.colors > kSameTexelLevels || sum >= least) continue;
        least = sum;
        alpha = found.alpha;
        match.turn = kTurns[i];
    }
    if (match.turn != Turn::other) match.isAlphaSame = alpha <= kSameAlphaLevels;
    return match;
}

}  // namespace

TextureMatch Pictures::compare(const scene::Texture& theirs, const scene::Texture& mine) {
    if (theirs.chess || mine.chess) return {theirs.chess == mine.chess ? Turn::none : Turn::other};
    const auto key = std::make_pair(theirs.path, mine.path);
    const auto found = known_.find(key);
    if (found != known_.end()) return found->second;
    TextureMatch match;
    const auto bytesA = theirs_.read(theirs.path), bytesB = mine_.read(mine.path);
    if (bytesA != bytesB) {
        if (bytesA && bytesB)
            match = matchOf(decoded(*bytesA, theirs), decoded(*bytesB, mine));
        else
            match.turn = Turn::other;
    }
    return known_.emplace(key, match).first->second;
}

bool Pictures::hasAlpha(const scene::Texture& theirs) const {
    if (theirs.chess) return false;
    const auto bytes = theirs_.read(theirs.path);
    return bytes && decoded(*bytes, theirs).hasAlpha;
}

bool Pictures::isSameFile(const std::string& theirs, const std::string& mine) const {
    return theirs_.read(theirs) == mine_.read(mine);
}

}  // namespace farol::grade
