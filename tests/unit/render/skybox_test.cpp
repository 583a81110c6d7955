#include "render/plan/skybox.h"

#include <catch2/catch.hpp>

using farol::image::Image;

TEST_CASE("the faces of a cube map are the cells of the cross") {
    // Each cell of 4x3 has its number as its colour.
    constexpr int kSide = 8;
    Image cross{4 * kSide, 3 * kSide, {}};
    for (int y = 0; y < cross.height; ++y)
        for (int x = 0; x < cross.width; ++x)
            for (const int value : {(y / kSide) * 4 + x / kSide, x % kSide, y % kSide, 255})
                cross.pixels.push_back(static_cast<std::uint8_t>(value));
    const auto faces = farol::render::cutCross(cross);
    const int cells[6] = {6, 4, 1, 9, 5, 7};  // right left top bottom front back
    for (std::size_t face = 0; face < 6; ++face) {
        REQUIRE(faces[face].width == kSide);
        REQUIRE(faces[face].height == kSide);
        for (std::size_t i = 0; i < kSide * kSide; ++i) {
            REQUIRE(faces[face].pixels[i * 4] == cells[face]);
            REQUIRE(faces[face].pixels[i * 4 + 1] == i % kSide);
            REQUIRE(faces[face].pixels[i * 4 + 2] == i / kSide);
        }
    }
}
