#include "grade/requirements/facts.h"

#include <algorithm>
#include <cstdlib>
#include <functional>

#include "grade/images/measures.h"

namespace farol::grade {
namespace {

constexpr int kChange = 8;         // levels of 255
constexpr double kChanged = 0.05;  // of an object's pixels
constexpr int kVisiblePixels = 16;

}  // namespace

SeenFacts::SeenFacts(render::Renderer& renderer, std::shared_ptr<const render::Prepared> prepared,
                     const Inventory& inventory, std::vector<Shot> shots)
    : renderer_(renderer),
      prepared_(std::move(prepared)),
      inventory_(inventory),
      shots_(std::move(shots)) {
    for (const Shot& shot : shots_)
        if (std::find(timesS_.begin(), timesS_.end(), shot.options.timeS) == timesS_.end())
            timesS_.push_back(shot.options.timeS);
}

image::Image SeenFacts::draw(const std::shared_ptr<const render::Prepared>& prepared,
                             std::size_t shot, render::Layer layer) {
    render::Job job;
    job.options = shots_[shot].options;
    job.options.layer = layer;
    image::Image image;
    renderer_.draw(prepared, job, image);
    return image;
}

const SeenFacts::Frame& SeenFacts::frame(std::size_t shot) {
    const auto known = frames_.find(shot);
    if (known != frames_.end()) return known->second;
    Frame made;
    made.ids = idsOf(draw(prepared_, shot, render::Layer::id));
    made.pixels.assign(inventory_.objects().size(), 0);
    for (const std::uint32_t id : made.ids)
        if (id > 0 && id <= made.pixels.size()) ++made.pixels[id - 1];
    return frames_.emplace(shot, std::move(made)).first->second;
}

const image::Image& SeenFacts::plain(std::size_t shot) {
    const auto known = plain_.find(shot);
    if (known != plain_.end()) return known->second;
    return plain_.emplace(shot, draw(prepared_, shot, render::Layer::color)).first->second;
}

std::vector<int> SeenFacts::pixelsOf(std::size_t object) {
    std::vector<int> out;
    for (const double timeS : timesS_) {
        int most = 0;
        for (std::size_t i = 0; i < shots_.size(); ++i)
            if (shots_[i].options.timeS == timeS) most = std::max(most, frame(i).pixels[object]);
        out.push_back(most);
    }
    return out;
}

std::vector<double> SeenFacts::changes(const std::shared_ptr<const render::Prepared>& without,
                                       std::size_t shot) {
    const image::Image image = draw(without, shot, render::Layer::color);
    const image::Image& base = plain(shot);
    const Frame& seen = frame(shot);
    std::vector<double> shares(inventory_.objects().size(), 0.0);
    for (std::size_t i = 0; i < seen.ids.size(); ++i) {
        const std::uint32_t id = seen.ids[i];
        if (id == 0 || id > shares.size()) continue;
        int most = 0;
        for (std::size_t c = 4 * i; c < 4 * i + 3; ++c)
            most = std::max(most, std::abs(int{image.pixels[c]} - int{base.pixels[c]}));
        if (most >= kChange) shares[id - 1] += 1.0;
    }
    for (std::size_t k = 0; k < shares.size(); ++k)
        if (seen.pixels[k] > 0) shares[k] /= seen.pixels[k];
    return shares;
}

const std::vector<std::vector<double>>& SeenFacts::changesWithout(
    int key, const std::function<std::shared_ptr<const render::Prepared>()>& make) {
    const auto known = changes_.find(key);
    if (known != changes_.end()) return known->second;
    const std::shared_ptr<const render::Prepared> changed = make();
    std::vector<std::vector<double>> shares;
    for (std::size_t shot = 0; shot < shots_.size(); ++shot)
        shares.push_back(changes(changed, shot));
    return changes_.emplace(key, std::move(shares)).first->second;
}

bool SeenFacts::matters(std::size_t object, Effect effect) {
    const auto& shares = changesWithout(-1 - static_cast<int>(effect),
                                        [&] { return without(*prepared_, inventory_, effect); });
    return std::any_of(shares.begin(), shares.end(),
                       [&](const std::vector<double>& shot) { return shot[object] >= kChanged; });
}

std::optional<bool> SeenFacts::isLitBy(std::size_t object, int light) {
    const auto& shares = changesWithout(light, [&] { return withoutLight(*prepared_, light); });
    std::optional<bool> isLit;
    for (std::size_t shot = 0; shot < shots_.size(); ++shot) {
        if (frame(shot).pixels[object] < kVisiblePixels) continue;
        isLit = isLit.value_or(false) || shares[shot][object] >= kChanged;
    }
    return isLit;
}

}  // namespace farol::grade
