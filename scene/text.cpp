#include "scene/text.h"

#include <algorithm>
#include <cctype>

namespace farol::scene {
namespace {

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// Optimal string alignment: insert, delete, replace, and swap of neighbours count one each.
std::size_t distance(const std::string& a, const std::string& b) {
    const std::size_t width = b.size() + 1;
    std::vector<std::size_t> cost((a.size() + 1) * width);
    for (std::size_t i = 0; i <= a.size(); ++i) {
        for (std::size_t j = 0; j <= b.size(); ++j) {
            std::size_t& here = cost[i * width + j];
            if (i == 0 || j == 0) {
                here = i + j;
                continue;
            }
            here = std::min({cost[(i - 1) * width + j] + 1, cost[i * width + j - 1] + 1,
                             cost[(i - 1) * width + j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                here = std::min(here, cost[(i - 2) * width + j - 2] + 1);
        }
    }
    return cost.back();
}

}  // namespace

std::string didYouMean(const std::string& word, const std::vector<std::string>& candidates) {
    constexpr std::size_t kLongest = 64;
    if (word.empty() || word.size() > kLongest) return {};
    const std::string wanted = lower(word);
    std::size_t best = std::clamp<std::size_t>(word.size() / 3, 1, 3) + 1;
    std::string found;
    for (const std::string& one : candidates) {
        if (one.size() > kLongest) continue;
        const std::size_t edits = distance(wanted, lower(one));
        // Words of a letter or two are near everything: only a part kept counts as a likeness.
        if (edits < best && 2 * edits <= word.size()) {
            best = edits;
            found = one;
        }
    }
    return found;
}

}  // namespace farol::scene
