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

/// Compares textures by their pixels, not by name or format.
class Pictures {
  public:
    Pictures(const scene::Assets& theirs, const scene::Assets& mine)
        : theirs_(theirs), mine_(mine) {}
    /// Throws Error image.* if the files differ and one cannot be decoded.
    Turn compare(const scene::Texture& theirs, const scene::Texture& mine);
    /// The same of files that a background or skybox names.
    bool isSameFile(const std::string& theirs, const std::string& mine) const;

  private:
    const scene::Assets &theirs_, &mine_;
    std::map<std::pair<std::string, std::string>, Turn> known_;
};

}  // namespace farol::grade
