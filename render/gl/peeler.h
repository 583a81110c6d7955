#pragma once

#include <array>

#include "render/gl/objects.h"
#include "render/gl/program.h"
#include "render/gl/target.h"
#include "render/plan/transparency.h"

namespace farol::render::gl {

/// Targets of depth peeling (Everitt, "Interactive Order-Independent Transparency", 2001): each
/// layer holds the nearest see-through surface of every sample that is behind the layer before and
/// in front of what is opaque; layers are added up from the nearest on.
class Peeler {
  public:
    /// `of`: the format of the target with what is opaque.
    Peeler(const Api& api, const Target::Format& of, bool packInvert);

    /// Empties the sum.
    void begin(const glm::ivec4& viewport) const;
    /// Binds layer `index`, empty, for draws that count its samples, and the depths that bound it.
    void beginLayer(int index, const Target& opaque, const glm::ivec4& viewport) const;
    /// Returns whether the layer has any sample.
    bool endLayer() const;
    const Target& layer(int index) const { return layers_[static_cast<std::size_t>(index % 2)]; }
    const Target& sum() const { return sum_; }

  private:
    const Api& api_;
    std::array<Target, 2> layers_;
    Target sum_;
    Query any_;
};

}  // namespace farol::render::gl
