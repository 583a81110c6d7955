#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "grade/requirements/inventory.h"
#include "grade/requirements/requirement.h"
#include "grade/rubric/views.h"
#include "image/image.h"
#include "render/renderer.h"

namespace farol::grade {

/// What renders show of a scene's objects. Nothing is rendered before it is asked for.
class SeenFacts {
  public:
    /// `shots`: each at one of the rubric's times. All outlive the facts.
    SeenFacts(render::Renderer& renderer, std::shared_ptr<const render::Prepared> prepared,
              const Inventory& inventory, std::vector<Shot> shots);

    /// Returns the times of the shots, each once.
    const std::vector<double>& timesS() const { return timesS_; }
    /// Returns the pixels of an object by time: the most of the shots of that time.
    std::vector<int> pixelsOf(std::size_t object);
    /// Returns whether a twentieth of the object's pixels, in a shot, changes by 8 levels or more
    /// where `effect` is left out of the image. False where it has none.
    bool matters(std::size_t object, Effect effect);
    /// The same for a light; nothing where the object is not visible (fewer than 16 px).
    std::optional<bool> isLitBy(std::size_t object, int light);

  private:
    struct Frame {
        std::vector<std::uint32_t> ids;
        std::vector<int> pixels;  ///< by object
    };
    const Frame& frame(std::size_t shot);
    const image::Image& plain(std::size_t shot);
    image::Image draw(const std::shared_ptr<const render::Prepared>& prepared, std::size_t shot,
                      render::Layer layer);
    /// Shares of the pixels of each object that differ from the plain image, by shot.
    std::vector<double> changes(const std::shared_ptr<const render::Prepared>& without,
                                std::size_t shot);
    const std::vector<std::vector<double>>& changesWithout(
        int key, const std::function<std::shared_ptr<const render::Prepared>()>& make);

    render::Renderer& renderer_;
    std::shared_ptr<const render::Prepared> prepared_;
    const Inventory& inventory_;
    std::vector<Shot> shots_;
    std::vector<double> timesS_;
    std::map<std::size_t, Frame> frames_;
    std::map<std::size_t, image::Image> plain_;
    std::map<int, std::vector<std::vector<double>>> changes_;  ///< by effect or light, then shot
};

/// Returns the scene with an effect left out: lights black, no textures, one normal for all.
std::shared_ptr<const render::Prepared> without(const render::Prepared& prepared,
                                                const Inventory& inventory, Effect effect);
/// Returns the scene with one light black: the number of its element in the order of a walk.
std::shared_ptr<const render::Prepared> withoutLight(const render::Prepared& prepared, int light);

}  // namespace farol::grade
