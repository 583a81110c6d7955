#include "grade/structure/pictures.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "image/image_file.h"

namespace farol::grade {
namespace {

constexpr int kSameTexelLevels = 12;  // of 255: JPEG and other formats of the same picture

/// Returns the mean difference of levels to `mine`, mirrored by the flags; samples some rows and
/// columns.
double meanDifference(const image::Image& theirs, const image::Image& mine, bool flipX,
                      bool flipY) {
    double sum = 0.0;
    std::size_t count = 0;
    const int stepX = std::max(1, mine.width / 128), stepY = std::max(1, mine.height / 128);
    const auto at = [&](int u, int v) {
        return 4 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(mine.width) +
                    static_cast<std::size_t>(u));
    };
    for (int y = 0; y < mine.height; y += stepY)
        for (int x = 0; x < mine.width; x += stepX, ++count) {
            const int fromX = flipX ? mine.width - 1 - x : x;
            const int fromY = flipY ? mine.height - 1 - y : y;
            for (std::size_t c = 0; c < 3; ++c)
                sum += std::abs(theirs.pixels[at(x, y) + c] - mine.pixels[at(fromX, fromY) + c]);
        }
    return sum / (3.0 * static_cast<double>(std::max<std::size_t>(1, count)));
}

Turn turnOf(const image::Image& theirs, const image::Image& mine) {
    if (theirs.width != mine.width || theirs.height != mine.height) return Turn::other;
    constexpr std::array<Turn, 4> kTurns{Turn::none, Turn::mirrored, Turn::upsideDown, Turn::both};
    std::size_t best = 0;
    double least = 1e9;
    for (std::size_t i = 0; i < kTurns.size(); ++i) {
        const double found = meanDifference(theirs, mine, (i & 1) != 0, (i & 2) != 0);
        if (found < least) {
            least = found;
            best = i;
        }
    }
    return least <= kSameTexelLevels ? kTurns[best] : Turn::other;
}

}  // namespace

Turn Pictures::compare(const scene::Texture& theirs, const scene::Texture& mine) {
    if (theirs.chess || mine.chess) return theirs.chess == mine.chess ? Turn::none : Turn::other;
    const auto key = std::make_pair(theirs.path, mine.path);
    const auto found = known_.find(key);
    if (found != known_.end()) return found->second;
    Turn turn = Turn::none;
    const auto bytesA = theirs_.read(theirs.path), bytesB = mine_.read(mine.path);
    if (bytesA != bytesB) {
        const auto decoded = [](const std::optional<std::string>& bytes,
                                const scene::Texture& texture) {
            std::string damage;  // drawing the scene warns of it
            return image::decodeImage(bytes.value_or(""), texture.path, texture.where, &damage);
        };
        turn =
            bytesA && bytesB ? turnOf(decoded(bytesA, theirs), decoded(bytesB, mine)) : Turn::other;
    }
    return known_.emplace(key, turn).first->second;
}

bool Pictures::isSameFile(const std::string& theirs, const std::string& mine) const {
    return theirs_.read(theirs) == mine_.read(mine);
}

}  // namespace farol::grade
