#include "render/plan/close_surfaces.h"

#include <algorithm>
#include <cmath>

namespace farol::render {
namespace {

constexpr std::size_t kMaxSurfaces = 256;
constexpr std::size_t kPoints = 64;  // most samples of a mesh
constexpr double kAlike = 0.1, kClose = 0.03, kSame = 1e-7;

struct Seen {
    std::size_t instance;
    glm::dvec3 center;
    double size;  ///< half the diagonal of its box
};

Seen seenOf(const InstanceList& list, std::size_t index) {
    const Instance& one = list.instances[index];
    const Box& box = one.mesh->bounds;
    const glm::dvec3 half = (box.max - box.min) * 0.5;
    const glm::dmat3 linear(one.worldFromObject);
    return {index, glm::dvec3(one.worldFromObject * glm::dvec4((box.min + box.max) * 0.5, 1.0)),
            glm::length(glm::dvec3(glm::length(linear[0]) * half.x, glm::length(linear[1]) * half.y,
                                   glm::length(linear[2]) * half.z))};
}

/// Distances of points of a surface from another, world units, about, in ascending order; empty
/// where they are not known.
std::vector<double> gapsBetween(const InstanceList& list, const Instance& from,
                                const Instance& to) {
    const generator::Surface& surface = list.surfaces[static_cast<std::size_t>(to.surface)];
    if (surface.kind->distance == nullptr) return {};
    glm::dmat4 worldFromUnit = to.worldFromObject;
    double smallest = 1e300;
    for (int i = 0; i < 3; ++i) {
        worldFromUnit[i] *= surface.lengths[i];
        smallest = std::min(smallest, glm::length(glm::dvec3(worldFromUnit[i])));
    }
    if (!(std::abs(glm::determinant(worldFromUnit)) > 0.0)) return {};
    const glm::dmat4 unitFromObject = glm::inverse(worldFromUnit) * from.worldFromObject;
    const std::vector<glm::vec3>& positions = from.mesh->mesh.positions();
    const std::size_t step = std::max<std::size_t>(1, positions.size() / kPoints);
    std::vector<double> gaps;
    for (std::size_t i = 0; i < positions.size(); i += step) {
        const glm::dvec3 at(unitFromObject * glm::dvec4(glm::dvec3(positions[i]), 1.0));
        gaps.push_back(smallest * surface.kind->distance(surface, at));
    }
    std::sort(gaps.begin(), gaps.end());
    return gaps;
}

}  // namespace

std::vector<Closeness> closeSurfaces(const InstanceList& list) {
    if (list.surfaces.empty()) return {};
    std::vector<Seen> seen;
    for (std::size_t i = 0; i < list.instances.size(); ++i) {
        const Instance& one = list.instances[i];
        if (!one.open || one.surface < 0) continue;
        if (seen.size() == kMaxSurfaces) return {};
        seen.push_back(seenOf(list, i));
    }
    std::vector<Closeness> all;
    for (std::size_t i = 0; i < seen.size(); ++i)
        for (std::size_t j = i + 1; j < seen.size(); ++j) {
            const Seen &a = seen[i], &b = seen[j];
            const double size = std::max(a.size, b.size);
            if (glm::length(a.center - b.center) > kAlike * size ||
                std::abs(a.size - b.size) > kAlike * size)
                continue;
            const std::vector<double> gaps =
                gapsBetween(list, list.instances[a.instance], list.instances[b.instance]);
            if (gaps.empty()) continue;
            const double median = gaps[gaps.size() / 2] / size;
            if (median > kClose || median < kSame) continue;
            all.resize(list.instances.size());
            for (const Seen& one : {a, b}) {
                Closeness& close = all[one.instance];
                const double gap = gaps.front() / 8.0;
                close.gap = close.share < 1.0 ? std::min(close.gap, gap) : gap;
                close.share = std::min(close.share, median);
            }
        }
    return all;
}

bool makeFiner(generator::Fineness& fine, const Closeness& close, const glm::dmat3& linear) {
    const double scale =
        std::max({glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2])});
    const double wanted = std::max(fine.error * close.share, close.gap / std::max(1e-300, scale));
    if (wanted >= fine.error) return false;
    fine.error = std::exp2(std::floor(4.0 * std::log2(wanted)) / 4.0);
    return true;
}

}  // namespace farol::render
