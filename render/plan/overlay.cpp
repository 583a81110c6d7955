#include "render/plan/overlay.h"

#include <algorithm>
#include <array>
#include <cmath>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#endif
#include <stb/stb_easy_font.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace farol::render {
namespace {

constexpr int kMarginUnits = 4;
constexpr std::size_t kMaxCharacters = 2000;

/// A vertex of stb_easy_font: four a quad, axis-aligned.
struct FontVertex {
    float x, y, z;
    std::array<unsigned char, 4> color;
};

template <typename Change>
void forEachPixel(image::Image& image, int left, int top, int right, int bottom, Change change) {
    left = std::clamp(left, 0, image.width);
    right = std::clamp(right, 0, image.width);
    top = std::clamp(top, 0, image.height);
    bottom = std::clamp(bottom, 0, image.height);
    for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x)
            change(
                &image.pixels[(static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                               static_cast<std::size_t>(x)) *
                              4]);
}

}  // namespace

void drawText(image::Image& image, const std::string& text, int scale) {
    scale = std::clamp(scale, 1, 8);
    std::string ascii = text.substr(0, kMaxCharacters);
    for (char& c : ascii)
        if (c != '\n' && (c < ' ' || c > '~')) c = '?';
    // The font's own figure: about 270 bytes a character.
    std::vector<FontVertex> vertices(ascii.size() * 20 + 64);
    const int quads = stb_easy_font_print(
        static_cast<float>(kMarginUnits), static_cast<float>(kMarginUnits), ascii.data(), nullptr,
        vertices.data(), static_cast<int>(vertices.size() * sizeof(FontVertex)));
    const int width = stb_easy_font_width(ascii.data()) + 2 * kMarginUnits;
    const int height = stb_easy_font_height(ascii.data()) + 2 * kMarginUnits;
    forEachPixel(image, 0, 0, width * scale, height * scale, [](std::uint8_t* pixel) {
        for (int c = 0; c < 3; ++c) pixel[c] = static_cast<std::uint8_t>(pixel[c] / 3);
        pixel[3] = std::max<std::uint8_t>(pixel[3], 170);
    });
    for (int q = 0; q < quads; ++q) {
        const FontVertex& a = vertices[static_cast<std::size_t>(q) * 4];
        const FontVertex& b = vertices[static_cast<std::size_t>(q) * 4 + 2];
        const auto at = [&](float units) { return static_cast<int>(std::lround(units)) * scale; };
        forEachPixel(image, at(std::min(a.x, b.x)), at(std::min(a.y, b.y)), at(std::max(a.x, b.x)),
                     at(std::max(a.y, b.y)),
                     [](std::uint8_t* pixel) { std::fill_n(pixel, 4, std::uint8_t{255}); });
    }
}

}  // namespace farol::render
