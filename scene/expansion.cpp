#include "scene/expansion.h"

#include <algorithm>
#include <limits>
#include <variant>

#include "scene/messages.h"

namespace farol::scene {
namespace {

constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();

std::uint64_t saturatedSum(std::uint64_t a, std::uint64_t b) {
    return a > kUnlimited - b ? kUnlimited : a + b;
}

std::uint64_t saturatedProduct(std::uint64_t a, std::uint64_t b) {
    return b != 0 && a > kUnlimited / b ? kUnlimited : a * b;
}

/// The models of a group with all its copies.
struct Expanded {
    std::uint64_t models = 0, placed = 0;

    void add(const Expanded& other) {
        models = saturatedSum(models, other.models);
        placed = saturatedSum(placed, other.placed);
    }
    bool isOver() const { return models > kMaxInstances || placed > kMaxPlaced; }
};

class Counter {
  public:
    explicit Counter(Findings& findings) : findings_(findings) {}

    Expanded count(const Group& group) {
        Expanded inner{group.models.size(), 1};
        for (const Transform& transform : group.transforms)
            if (const auto* curve = std::get_if<FollowCurve>(&transform))
                inner.placed = saturatedSum(inner.placed, curve->points.size());
        for (const Group& child : group.groups) inner.add(count(child));
        if (!group.scatter) return inner;
        const auto copies = static_cast<std::uint64_t>(std::max(group.scatter->count, 0));
        const Expanded all{saturatedProduct(inner.models, copies),
                           saturatedProduct(inner.placed, copies)};
        refuseIfOver(all, group.where);
        return all;
    }

    void refuseIfOver(const Expanded& all, const Location& where) {
        if (refused_ || !all.isOver()) return;
        refused_ = true;  // the groups round it are over for the same reason
        const bool models = all.models > kMaxInstances;
        const std::uint64_t number = models ? all.models : all.placed;
        const auto count = "count"_arg =
            number == kUnlimited ? "more than 1e19" : std::to_string(number);
        findings_.error(models ? message<"limit.instances/copies">(count, "max"_arg = kMaxInstances)
                               : message<"limit.instances/places">(count, "max"_arg = kMaxPlaced),
                        where);
    }

  private:
    Findings& findings_;
    bool refused_ = false;
};

}  // namespace

void checkExpansion(const Scene& scene, Findings& findings) {
    Counter counter(findings);
    Expanded all;
    Location first;
    for (const Group& group : scene.groups) {
        all.add(counter.count(group));
        if (first.line == 0) first = group.where;
    }
    counter.refuseIfOver(all, first);
    if (scene.entity) checkExpansion(*scene.entity, findings);
}

}  // namespace farol::scene
