#pragma once

#include <memory>
#include <vector>

#include "render/gl/objects.h"
#include "render/plan/frame_plan.h"

namespace farol::render::gl {

/// The shadow maps of a painter: layers of one array of depths, kept for the next frame.
class ShadowStore {
  public:
    explicit ShadowStore(const Api& api) : api_(api) {}

    /// Binds the array for the plan's maps. Drops what it has where
    /// the maps' size or number is another. Throws as throwOnError when GL refuses, and has no maps
    /// then.
    void bind(const FramePlan& plan);
    /// True if the layer has the depths of the plan's map already.
    bool has(const FramePlan& plan, std::size_t map) const;
    /// Binds an empty layer as the target of draws.
    void begin(std::size_t map);
    /// Remembers what was drawn.
    void keep(const FramePlan& plan, std::size_t map);

  private:
    struct Layer {
        std::shared_ptr<const FramePlan> frame;
        std::vector<std::string> textures;  ///< keys, of the items that have one
    };

    const Api& api_;
    Texture depths_;
    Framebuffer framebuffer_;
    int side_ = 0;
    std::vector<Layer> layers_;
};

}  // namespace farol::render::gl
