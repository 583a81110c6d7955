#include "render/plan/skybox.h"

#include <algorithm>
#include <cmath>

namespace farol::render {
namespace {

struct Cell {
    int column, row;
};

// In the order +X -X +Y -Y +Z -Z of a cube map, whose space is left-handed: with the world's -Z
// as its +Z, every face holds its cell as it stands in the cross.
constexpr std::array<Cell, 6> kCells{{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}};

/// `at` of `to` cells in units of `from` cells.
int scaled(int at, int from, int to) { return static_cast<int>(std::int64_t{at} * from / to); }

}  // namespace

bool isCross(int width, int height) {
    const double cellWidth = width / 4.0, cellHeight = height / 3.0;
    return std::abs(cellWidth - cellHeight) <= std::max(1.0, 0.01 * cellHeight);
}

std::array<image::Image, 6> cutCross(const image::Image& cross, int maxSide) {
    const int cellWidth = std::max(1, cross.width / 4);
    const int cellHeight = std::max(1, cross.height / 3);
    const int side = std::min(cellWidth, maxSide);
    std::array<image::Image, 6> faces;
    for (std::size_t f = 0; f < 6; ++f) {
        faces[f] = image::Image{side, side, {}};
        faces[f].pixels.resize(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * 4);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const int sourceX = std::min(
                    kCells[f].column * cellWidth + scaled(x, cellWidth, side), cross.width - 1);
                const int sourceY = std::min(
                    kCells[f].row * cellHeight + scaled(y, cellHeight, side), cross.height - 1);
                const std::size_t from =
                    (static_cast<std::size_t>(sourceY) * static_cast<std::size_t>(cross.width) +
                     static_cast<std::size_t>(sourceX)) *
                    4;
                const std::size_t to =
                    (static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
                     static_cast<std::size_t>(x)) *
                    4;
                std::copy_n(&cross.pixels[from], 4, &faces[f].pixels[to]);
            }
    }
    return faces;
}

}  // namespace farol::render
