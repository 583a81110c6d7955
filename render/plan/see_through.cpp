#include "render/plan/see_through.h"

#include <algorithm>
#include <array>

#include "render/plan/transparency.h"

namespace farol::render {

void SeeThroughSurfaces::add(const std::optional<PixelRect>& rect, double surfaces) {
    const double covered = coveredArea(rect, size_);
    if (covered <= 0.0) return;
    area_ += surfaces * covered;
    const glm::dvec2 size(size_);
    const PixelRect whole{glm::dvec2(0.0), size};
    PixelRect kept = rect.value_or(whole);
    kept.min = glm::clamp(kept.min, glm::dvec2(0.0), size);
    kept.max = glm::clamp(kept.max, glm::dvec2(0.0), size);
    surfaces_.push_back({kept, surfaces});
}

double SeeThroughSurfaces::deepest() const {
    constexpr std::size_t kMaxTests = 4'000'000;  // about 10 ms
    if (surfaces_.empty()) return 0.0;
    const std::size_t points =
        std::clamp<std::size_t>(kMaxTests / (5 * surfaces_.size()), 1, surfaces_.size());
    double most = 0.0;
    for (std::size_t i = 0; i < points; ++i) {
        const PixelRect& rect = surfaces_[i * surfaces_.size() / points].rect;
        const std::array<glm::dvec2, 5> places{rect.min,
                                               {rect.max.x, rect.min.y},
                                               rect.max,
                                               {rect.min.x, rect.max.y},
                                               0.5 * (rect.min + rect.max)};
        for (const glm::dvec2& at : places) {
            double over = 0.0;
            for (const Surface& surface : surfaces_)
                if (glm::all(glm::greaterThanEqual(at, surface.rect.min)) &&
                    glm::all(glm::lessThanEqual(at, surface.rect.max)))
                    over += surface.count;
            most = std::max(most, over);
        }
    }
    return most;
}

void addSeeThrough(const InstanceList& list, const ViewTransform& view,
                   SeeThroughSurfaces& surfaces) {
    for (const Instance& instance : list.instances) {
        const scene::Model& model = *instance.model;
        const float opacity = model.opacity * (model.material ? model.material->opacity : 1.0F);
        if (opacity >= 1.0F) continue;
        const bool hasInner =
            model.twoSided || (!model.source.isSheet && !isFlat(instance.mesh->bounds));
        glm::dmat4 viewFromObject = glm::dmat4(view.rotation) * instance.worldFromObject;
        viewFromObject[3] =
            glm::dvec4(view.eyeFromWorld(glm::dvec3(instance.worldFromObject[3])), 1.0);
        surfaces.add(pixelRect(instance.mesh->bounds, viewFromObject, view), hasInner ? 2.0 : 1.0);
    }
}

double peelsOf(double deepest) {
    return std::min(deepest, static_cast<double>(kMaxPeeledLayers)) + 1.0;
}

}  // namespace farol::render
