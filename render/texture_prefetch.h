#pragma once

#include <future>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "render/plan/texture_levels.h"

namespace farol::render {

/// Decodes the first images of a scene while the GL's libraries are loaded, which no plan can
/// precede: an image that the plan then leaves out was decoded in vain. One per processor, within
/// the bound of loadTextures on pixels at once.
class TexturePrefetch {
  public:
    /// `refs` outlive it.
    TexturePrefetch(const std::vector<TextureRef>& refs, OpenTexture open);

    /// As the OpenTexture that was given, with the image where it has been decoded. Each image is
    /// given once.
    UndecodedTexture open(const TextureRef& ref);

  private:
    struct Decoded {
        image::Image image;
        std::string damage;
    };
    struct Started {
        int width, height;
        bool mayHaveAlpha;
        std::shared_ptr<std::future<Decoded>> image;  ///< its destructor waits
    };

    OpenTexture open_;
    std::map<std::string, Started> started_;  ///< by TextureRef::key
};

}  // namespace farol::render
