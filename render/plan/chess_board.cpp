#include "render/plan/chess_board.h"

#include <algorithm>

namespace farol::render {

image::Image chessBoard(const scene::Chess& chess) {
    // Fields of 32 texels: mipmaps have something to average, and edges stay sharp when magnified.
    constexpr int kField = 32;
    constexpr int kMaxChessSide = 4096;
    const int field =
        std::max(1, std::min(kField, kMaxChessSide / std::max(chess.columns, chess.rows)));
    image::Image image{chess.columns * field, chess.rows * field, {}};
    image.pixels.reserve(static_cast<std::size_t>(image.width) *
                         static_cast<std::size_t>(image.height) * 4);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const bool odd = ((x / field + y / field) & 1) != 0;
            const glm::vec3& color = odd ? chess.second : chess.first;
            for (int c = 0; c < 3; ++c)
                image.pixels.push_back(
                    static_cast<std::uint8_t>(glm::clamp(color[c], 0.0F, 1.0F) * 255.0F + 0.5F));
            image.pixels.push_back(255);
        }
    return image;
}

}  // namespace farol::render
