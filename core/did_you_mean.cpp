#include "core/did_you_mean.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "core/text.h"

namespace farol {
namespace {

constexpr std::size_t kMaxWord = 64;

/// Optimal string alignment: insert, delete, replace, and swap of neighbours count one each. More
/// than `most` for words that are farther apart: only cells that near the diagonal are computed.
/// Precondition: no word is longer than kMaxWord.
std::size_t distance(std::string_view a, std::string_view b, std::size_t most) {
    if (std::max(a.size(), b.size()) - std::min(a.size(), b.size()) > most) return most + 1;
    using Row = std::array<std::size_t, kMaxWord + 1>;
    std::array<Row, 3> rows;  // of a's last three prefixes
    for (std::size_t i = 0; i <= a.size(); ++i) {
        Row &here = rows[i % 3], &above = rows[(i + 2) % 3], &twoAbove = rows[(i + 1) % 3];
        std::fill_n(here.begin(), b.size() + 1, most + 1);
        const std::size_t last = std::min(b.size(), i + most);
        for (std::size_t j = i > most ? i - most : 0; j <= last; ++j) {
            if (i == 0 || j == 0) {
                here[j] = i + j;
                continue;
            }
            here[j] = std::min(
                {above[j] + 1, here[j - 1] + 1, above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                here[j] = std::min(here[j], twoAbove[j - 2] + 1);
        }
    }
    return std::min(rows[a.size() % 3][b.size()], most + 1);
}

}  // namespace

std::string didYouMean(const std::string& word, const std::vector<std::string>& candidates) {
    // More names than this would cost more time than the hint is worth.
    constexpr std::size_t kMaxCandidates = 2'000;
    if (word.empty() || word.size() > kMaxWord) return {};
    const std::string wanted = lowerCase(word);
    std::size_t left = kMaxCandidates;
    std::size_t best = std::clamp<std::size_t>(word.size() / 3, 1, 3) + 1;
    std::string found;
    for (const std::string& one : candidates) {
        if (left-- == 0) break;
        if (one.size() > kMaxWord) continue;
        const std::size_t edits = distance(wanted, lowerCase(one), best - 1);
        // Words of a letter or two are near everything: only a part kept counts as a likeness.
        if (edits < best && 2 * edits <= word.size()) {
            best = edits;
            found = one;
        }
    }
    return found;
}

}  // namespace farol
