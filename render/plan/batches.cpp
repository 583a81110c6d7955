#include "render/plan/batches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "render/plan/frustum.h"

namespace farol::render {
namespace {

bool sameSurface(const DrawItem& a, const DrawItem& b) {
    if (!a.surface || !b.surface) return !a.surface && !b.surface;
    return *a.surface == *b.surface && a.unitFromObject == b.unitFromObject &&
           a.hasExactDepth == b.hasExactDepth;
}

bool sameButPlace(const DrawItem& a, const DrawItem& b) {
    return a.mesh->id == b.mesh->id && a.firstIndex == b.firstIndex && a.inside == b.inside &&
           a.mirrored == b.mirrored && a.lightSet == b.lightSet && a.depthRank == b.depthRank &&
           sameSurface(a, b) && sameMaterial(a, b);
}

/// Where a model can be seen: pixels, and distance along the view. None where it reaches the
/// viewer.
struct Extent {
    PixelRect rect;
    double nearest = 0.0, farthest = 0.0;

    bool meets(const Extent& other) const {
        return rect.min.x <= other.rect.max.x && other.rect.min.x <= rect.max.x &&
               rect.min.y <= other.rect.max.y && other.rect.min.y <= rect.max.y &&
               nearest <= other.farthest && other.nearest <= farthest;
    }
};

class Arranger {
  public:
    Arranger(const std::vector<DrawItem>& items, const ViewTransform& view, bool merge,
             std::size_t blendedFrom)
        : items_(items), view_(view), merge_(merge), blendedFrom_(blendedFrom) {}

    Batches run() {
        const std::size_t count = blendedFrom_;
        batchOf_.resize(count);
        extents_.resize(count);
        const bool apart = !merge_ || count < kMinInstances;
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::size_t like = apart ? members_.size() : findLike(i);
            if (like == members_.size()) members_.emplace_back();
            members_[like].push_back(i);
            batchOf_[i] = like;
        }
        const std::size_t opaque = members_.size();
        addBlended();
        Batches all;
        all.firstBlended = opaque;
        all.order.reserve(items_.size());
        for (const std::vector<std::uint32_t>& members : members_) {
            Batch batch;
            batch.first = all.order.size();
            batch.count = members.size();
            batch.instanced = members.size() >= kMinInstances;
            all.batches.push_back(batch);
            all.order.insert(all.order.end(), members.begin(), members.end());
        }
        return all;
    }

  private:
    static constexpr int kTiles = 32;  ///< a side of the picture
    static constexpr std::size_t kBatchesBack = 24;
    static constexpr int kMaxTiles = 64;   ///< of one model; larger ones let nothing past
    static constexpr int kMaxLooks = 256;  ///< at models in the same tiles

    /// Batches of blended items, whose order is kept: likes in a row are one.
    void addBlended() {
        for (std::size_t i = blendedFrom_; i < items_.size(); ++i) {
            const bool joins = merge_ && i > blendedFrom_ && sameButPlace(items_[i - 1], items_[i]);
            if (!joins) members_.emplace_back();
            members_.back().push_back(static_cast<std::uint32_t>(i));
        }
    }

    /// The batch that the item joins, or the number of batches.
    std::size_t findLike(std::uint32_t item) {
        const std::size_t none = members_.size();
        const bool known = findExtent(item);
        std::size_t like = none;
        const std::size_t back = none - barrier_ > kBatchesBack ? none - kBatchesBack : barrier_;
        for (std::size_t b = none; b-- > back && like == none;)
            if (sameButPlace(items_[members_[b].front()], items_[item])) like = b;
        if (!known) {
            // It may join the last batch, but nothing moves past it.
            const std::size_t chosen = like + 1 == none ? like : none;
            for (std::vector<std::uint32_t>& tile : tiles_) tile.clear();
            barrier_ = chosen;
            return chosen;
        }
        if (like != none && like + 1 != none && meetsLater(item, like)) like = none;
        forTiles(extents_[item].rect, [&](std::vector<std::uint32_t>& tile) {
            tile.push_back(item);
            return true;
        });
        return like;
    }

    /// Margins: two pixels for snapped vertices, passes, points and lines; a quarter of its depth
    /// for the error of a narrow triangle's plane between its corners.
    bool findExtent(std::uint32_t index) {
        const DrawItem& item = items_[index];
        const glm::dmat4 viewFromObject(item.viewFromObject);
        const Box& box = item.mesh->bounds;
        if (box.empty()) return false;
        const std::optional<PixelRect> rect = pixelRect(box, viewFromObject, view_);
        if (!rect) return false;
        Extent& extent = extents_[index];
        constexpr double kMarginPx = 2.0;
        extent.rect = {rect->min - kMarginPx, rect->max + kMarginPx};
        const glm::dvec3 half = (box.max - box.min) / 2.0;
        const double reach = std::abs(viewFromObject[0].z) * half.x +
                             std::abs(viewFromObject[1].z) * half.y +
                             std::abs(viewFromObject[2].z) * half.z;
        const double middle = -(viewFromObject * glm::dvec4((box.min + box.max) / 2.0, 1.0)).z;
        const double margin = 0.5 * reach + 1e-4 * (std::abs(middle) + reach);
        extent.nearest = middle - reach - margin;
        extent.farthest = middle + reach + margin;
        const glm::ivec4 span = tilesOf(extent.rect);
        return (span.z - span.x + 1) * (span.w - span.y + 1) <= kMaxTiles;
    }

    /// First and last column and row.
    glm::ivec4 tilesOf(const PixelRect& rect) const {
        const auto at = [](double px, int size) {
            return static_cast<int>(std::clamp(px * kTiles / size, 0.0, kTiles - 1.0));
        };
        return {at(rect.min.x, view_.size.x), at(rect.min.y, view_.size.y),
                at(rect.max.x, view_.size.x), at(rect.max.y, view_.size.y)};
    }

    /// Calls `visit` until it returns false.
    template <typename Visit>
    void forTiles(const PixelRect& rect, const Visit& visit) {
        const glm::ivec4 span = tilesOf(rect);
        for (int y = span.y; y <= span.w; ++y)
            for (int x = span.x; x <= span.z; ++x)
                if (!visit(tiles_[static_cast<std::size_t>(y * kTiles + x)])) return;
    }

    /// True where the item may meet a model of a batch behind `like`.
    bool meetsLater(std::uint32_t item, std::size_t like) {
        bool met = false;
        int looks = 0;
        forTiles(extents_[item].rect, [&](const std::vector<std::uint32_t>& tile) {
            for (const std::uint32_t other : tile) {
                met = ++looks > kMaxLooks ||
                      (batchOf_[other] > like && extents_[other].meets(extents_[item]));
                if (met) return false;
            }
            return true;
        });
        return met;
    }

    const std::vector<DrawItem>& items_;
    const ViewTransform& view_;
    bool merge_;
    std::size_t blendedFrom_;
    std::vector<std::vector<std::uint32_t>> members_;  ///< of the batches
    std::vector<std::size_t> batchOf_;                 ///< of the items
    std::vector<Extent> extents_;
    std::array<std::vector<std::uint32_t>, std::size_t{kTiles} * kTiles> tiles_;
    std::size_t barrier_ = 0;  ///< the first batch that may still be joined
};

}  // namespace

bool sameMaterial(const DrawItem& a, const DrawItem& b) {
    return a.diffuse == b.diffuse && a.ambient == b.ambient && a.specular == b.specular &&
           a.emissive == b.emissive && a.shininess == b.shininess && a.opacity == b.opacity &&
           a.texture == b.texture && a.mapping == b.mapping && a.planeS == b.planeS &&
           a.planeT == b.planeT && a.uvFrom == b.uvFrom && a.colored == b.colored;
}

Batches batchesOf(const std::vector<DrawItem>& items, const ViewTransform& view, bool merge,
                  std::size_t blendedFrom) {
    return Arranger(items, view, merge, blendedFrom).run();
}

}  // namespace farol::render
