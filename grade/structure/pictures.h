#pragma once

#include <map>
#include <memory>
#include <string>

#include "image/image.h"
#include "scene/files/assets.h"
#include "scene/scene.h"

namespace farol::grade {

/// How an image has to be flipped to equal another.
enum class Turn { none, upsideDown, mirrored, both, other };

/// Two textures: the turn by which their colours are equal where they are not transparent, and
/// their alphas in that turn.
struct TextureMatch {
    Turn turn = Turn::none;
    bool isAlphaSame = true;
    bool hasAlpha = false, expectsAlpha = false;  ///< of the submission's, of the reference's
};

/// Compares textures by their pixels, not by name or format.
class Pictures {
  public:
    Pictures(const scene::Assets& theirs, const scene::Assets& mine)
        : theirs_(theirs), mine_(mine) {}
    /// Throws Error image.* if the files differ and one cannot be decoded.
    TextureMatch compare(const scene::Texture& theirs, const scene::Texture& mine);
    /// Whether the reference's texture has transparent parts. Throws Error image.*.
    bool hasAlpha(const scene::Texture& theirs) const;
    /// The same of files that a background or skybox names.
    bool isSameFile(const std::string& theirs, const std::string& mine) const;

  private:
    const scene::Assets &theirs_, &mine_;
    std::map<std::pair<std::string, std::string>, TextureMatch> known_;
};

}  // namespace farol::grade
