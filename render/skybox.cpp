#include "render/skybox.h"

#include <algorithm>

namespace farol::render {
namespace {

struct Cell {
    int column, row;
};

// In the order +X -X +Y -Y +Z -Z of a cube map, whose space is left-handed: with the world's -Z
// as its +Z, every face holds its cell as it stands in the cross.
constexpr std::array<Cell, 6> kCells{{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}};

}  // namespace

std::array<Image, 6> cutCross(const Image& cross) {
    const int cellWidth = std::max(1, cross.width / 4);
    const int cellHeight = std::max(1, cross.height / 3);
    const int side = cellWidth;
    std::array<Image, 6> faces;
    for (std::size_t f = 0; f < 6; ++f) {
        faces[f] = Image{side, side, {}};
        faces[f].pixels.resize(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * 4);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const int sourceX = std::min(kCells[f].column * cellWidth + x, cross.width - 1);
                const int sourceY =
                    std::min(kCells[f].row * cellHeight + y * cellHeight / side, cross.height - 1);
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
