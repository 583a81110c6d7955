#pragma once

#include <atomic>
#include <future>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/workers.h"
#include "render/plan/texture_levels.h"

namespace farol::render {

/// Decodes the first images of a scene while the GL's libraries are loaded and its context is made,
/// which no plan can precede, within the bound of loadTextures on pixels at once.
class TexturePrefetch {
  public:
    /// By `workers`, which outlive it, as do `refs`. The threads have to be there before libraries
    /// are loaded: the C library makes none meanwhile.
    TexturePrefetch(const std::vector<TextureRef>& refs, OpenTexture open, Workers& workers);
    ~TexturePrefetch();
    TexturePrefetch(const TexturePrefetch&) = delete;
    TexturePrefetch& operator=(const TexturePrefetch&) = delete;

    /// Leaves out images that are none of these and are not being decoded yet.
    void keepOnly(const std::vector<TextureRef>& refs);

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
        std::shared_ptr<std::future<Decoded>> image;
        std::shared_ptr<std::atomic<bool>> isWanted;
    };

    OpenTexture open_;
    std::vector<std::shared_ptr<std::future<Decoded>>> images_;  ///< all of them
    std::map<std::string, Started> started_;                     ///< by TextureRef::key
};

}  // namespace farol::render
