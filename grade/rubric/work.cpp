#include "grade/rubric/work.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace farol::grade {

Work workOf(const Outline& outline, const render::InstanceList& list,
            std::vector<std::vector<std::uint32_t>> numbers) {
    Work out;
    std::map<const scene::Model*, std::uint32_t> itemOf;
    for (std::size_t i = 0; i < outline.items.size(); ++i)
        itemOf[outline.items[i].origin] = static_cast<std::uint32_t>(i) + 1;
    std::vector<std::uint32_t> to(list.instances.size() + 1, 0);
    for (std::size_t k = 0; k < list.instances.size(); ++k)
        if (const auto found = itemOf.find(list.instances[k].model); found != itemOf.end())
            to[k + 1] = found->second;
    std::vector<double> areas(outline.items.size(), 0.0);
    for (std::vector<std::uint32_t>& view : numbers) {
        for (std::uint32_t& number : view) {
            number = number < to.size() ? to[number] : 0;
            if (number > 0) areas[number - 1] += 1.0;
        }
        out.items.push_back(std::move(view));
    }
    const std::size_t count = outline.items.size();
    if (count == 0) return out;
    for (double& area : areas) area = std::sqrt(area);
    const double all = std::accumulate(areas.begin(), areas.end(), 0.0);
    for (const double area : areas) {
        const double equal = 1.0 / static_cast<double>(count);
        out.weights.push_back(all > 0.0 ? 0.5 * equal + 0.5 * area / all : equal);
    }
    return out;
}

Spoiled::Spoiled(const Work& work)
    : work_(work), sums_(work.weights.size(), 0.0), areas_(work.weights.size(), 0.0) {}

void Spoiled::add(std::size_t view, const std::vector<float>& changed) {
    constexpr float kRounding = 0.05F;  // of a change that is plain to see
    double outside = 0.0, content = 0.0;
    const std::vector<std::uint32_t>& items = work_.items[view];
    for (std::size_t p = 0; p < changed.size() && p < items.size(); ++p) {
        const double change = changed[p] > kRounding ? static_cast<double>(changed[p]) : 0.0;
        if (items[p] == 0) {
            outside += change;
            continue;
        }
        content += 1.0;
        sums_[items[p] - 1] += change;
        areas_[items[p] - 1] += 1.0;
    }
    background_ += outside / std::max(content, 64.0) / static_cast<double>(work_.items.size());
}

double Spoiled::share() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < sums_.size(); ++i)
        if (areas_[i] > 0.0) sum += work_.weights[i] * sums_[i] / std::max(areas_[i], 16.0);
    constexpr double kBeside = 0.5;  // of objects that show where none should
    return std::clamp(sum + kBeside * background_, 0.0, 1.0);
}

}  // namespace farol::grade
