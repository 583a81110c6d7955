#include "grade/images/mask.h"

#include <algorithm>
#include <array>

namespace farol::grade {
namespace {

void fill(Mask& mask, int width, int height) {
    if (mask.counts.empty())
        mask.counts.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 1);
}

bool isAxis(const std::uint8_t* pixel) {
    std::array<std::uint8_t, 3> levels{pixel[0], pixel[1], pixel[2]};
    std::sort(levels.begin(), levels.end());
    return levels[2] > 60 && levels[1] < 40;
}

}  // namespace

void hide(Mask& mask, int width, int height, const std::vector<Rectangle>& hidden) {
    if (hidden.empty()) return;
    fill(mask, width, height);
    for (const Rectangle& one : hidden)
        for (int y = std::max(0, one.y); y < std::min(height, one.y + one.height); ++y)
            for (int x = std::max(0, one.x); x < std::min(width, one.x + one.width); ++x)
                mask.counts[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                            static_cast<std::size_t>(x)] = 0;
}

void hideAxes(Mask& mask, const image::Image& first, const image::Image& second) {
    const int width = first.width, height = first.height;
    fill(mask, width, height);
    std::vector<Rectangle> around;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const std::size_t pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(x);
            if (isAxis(&first.pixels[4 * pixel]) || isAxis(&second.pixels[4 * pixel]))
                around.push_back({x - 1, y - 1, 3, 3});
        }
    hide(mask, width, height, around);
}

}  // namespace farol::grade
