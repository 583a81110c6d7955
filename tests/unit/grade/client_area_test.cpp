#include "grade/images/client_area.h"

#include <catch2/catch.hpp>

namespace {

using farol::grade::clientArea;
using farol::grade::Rectangle;
using farol::image::Image;

struct Painter {
    Image image;
    Painter(int width, int height) : image{width, height, {}} {
        image.pixels.assign(static_cast<std::size_t>(width * height) * 4, 255);
    }
    void fill(const Rectangle& area, int r, int g, int b) {
        for (int y = area.y; y < area.y + area.height; ++y)
            for (int x = area.x; x < area.x + area.width; ++x) {
                std::uint8_t* pixel =
                    &image.pixels[static_cast<std::size_t>(y * image.width + x) * 4];
                pixel[0] = static_cast<std::uint8_t>(r);
                pixel[1] = static_cast<std::uint8_t>(g);
                pixel[2] = static_cast<std::uint8_t>(b);
            }
    }
    /// A picture with something in it: a sky, a ground that fades, a ball.
    void scene(const Rectangle& at) {
        fill(at, 30, 60, 120);
        for (int i = at.height / 2; i < at.height; ++i)
            fill({at.x, at.y + i, at.width, 1}, 20, 60 + i * 150 / at.height, 20);
        fill({at.x + at.width / 3, at.y + at.height / 3, at.width / 4, at.height / 4}, 200, 40, 30);
    }
    void title(const Rectangle& at, int r, int g, int b) {
        fill(at, r, g, b);
        for (int x = 0; x < 60; x += 3)
            fill({at.x + 20 + x, at.y + at.height / 2 - 4, 2, 8}, 90, 90, 90);
    }
};

}  // namespace

TEST_CASE("a window's client area is found inside its frame") {
    struct Case {
        int width, height;
        Rectangle inside;
        int titleColor;
    };
    const Case one = GENERATE(values<Case>({
        {402, 332, {1, 31, 400, 300}, 255},  // thin dark borders, light title
        {408, 345, {4, 41, 400, 300}, 235},  // thick borders
        {400, 328, {0, 28, 400, 300}, 50},   // no borders, dark title
    }));
    Painter painter(one.width, one.height);
    painter.fill({0, 0, one.width, one.height}, 80, 80, 80);
    painter.title({one.inside.x, 0, one.inside.width, one.inside.y}, one.titleColor, one.titleColor,
                  one.titleColor);
    painter.scene(one.inside);
    const Rectangle found = clientArea(painter.image);
    CHECK(found == one.inside);
    CHECK(clientArea(painter.image, farol::image::ImageSize{400, 300}) == one.inside);
}

TEST_CASE("an image without a frame is used whole") {
    Painter painter(400, 300);
    painter.scene({0, 0, 400, 300});
    CHECK(clientArea(painter.image) == Rectangle{0, 0, 400, 300});
    Painter black(400, 300);
    black.fill({0, 0, 400, 300}, 0, 0, 0);
    black.fill({150, 100, 60, 60}, 255, 255, 255);
    CHECK(clientArea(black.image) == Rectangle{0, 0, 400, 300});
    CHECK(clientArea(Painter(20, 20).image) == Rectangle{0, 0, 20, 20});
}

TEST_CASE("borders as dark as the picture are cut to the size that is expected") {
    Painter painter(402, 331);
    painter.fill({0, 0, 402, 331}, 0, 0, 0);
    painter.title({0, 0, 402, 30}, 240, 240, 240);
    painter.fill({150, 150, 60, 60}, 255, 255, 255);
    CHECK(clientArea(painter.image, farol::image::ImageSize{400, 300}) ==
          Rectangle{1, 30, 400, 300});
}
