#include "grade/images/client_area.h"

#include <algorithm>
#include <cstdlib>
#include <map>

namespace farol::grade {
namespace {

constexpr int kMinTitle = 12, kMaxTitle = 80;  // px
constexpr int kMaxBorder = 12;                 // px
constexpr int kSameLevels = 12;                // of 255: title bars and borders have gradients
constexpr int kCorner = 10;                    // px of round corners, left out at either end

class Screenshot {
  public:
    explicit Screenshot(const image::Image& image)
        : image_(image), area_{0, 0, image.width, image.height} {}

    Rectangle find() {
        const int top = titleBottom();
        if (top == 0) return area_;
        area_.y = top;
        area_.height -= top;
        const int left = border(true, 0, 1), rightSide = border(true, image_.width - 1, -1);
        area_.x += left;
        area_.width -= left + rightSide;
        area_.height -= border(false, image_.height - 1, -1);
        return area_;
    }

  private:
    const std::uint8_t* at(int x, int y) const {
        return &image_.pixels[4 * (static_cast<std::size_t>(y) *
                                       static_cast<std::size_t>(image_.width) +
                                   static_cast<std::size_t>(x))];
    }
    static bool same(const std::uint8_t* a, const std::uint8_t* b) {
        return std::abs(a[0] - b[0]) <= kSameLevels && std::abs(a[1] - b[1]) <= kSameLevels &&
               std::abs(a[2] - b[2]) <= kSameLevels;
    }
    int right() const { return area_.x + area_.width; }
    int bottom() const { return area_.y + area_.height; }
    /// The most frequent colour of a row's middle, and its share there.
    std::pair<const std::uint8_t*, double> dominant(int y) const {
        std::map<int, std::pair<int, const std::uint8_t*>> counts;
        const int from = image_.width / 20, to = image_.width - from;
        for (int x = from; x < to; ++x) {
            const std::uint8_t* pixel = at(x, y);
            auto& entry = counts[(pixel[0] << 16) | (pixel[1] << 8) | pixel[2]];
            ++entry.first;
            entry.second = pixel;
        }
        const auto most = std::max_element(
            counts.begin(), counts.end(),
            [](const auto& a, const auto& b) { return a.second.first < b.second.first; });
        return {most->second.second,
                static_cast<double>(most->second.first) / std::max(1, to - from)};
    }

    /// The first row below the title bar; 0 where there is none.
    int titleBottom() const {
        constexpr double kMaxOfRow = 0.55;  // a long title leaves about as much
        constexpr double kWritten = 0.003;  // least share of pixels that are of another colour
        constexpr int kFrameAbove = 3;      // px
        if (image_.width < 64 || image_.height < 2 * kMaxTitle) return 0;
        int first = 0;
        while (first < kFrameAbove && !same(dominant(first).first, dominant(first + 1).first))
            ++first;
        const std::uint8_t* color = dominant(first).first;
        double written = 0.0;
        int y = first;
        for (; y <= kMaxTitle; ++y) {
            const auto [here, share] = dominant(y);
            if (!same(here, color) || share < kMaxOfRow) break;
            written += 1.0 - share;
        }
        const int rows = y - first;
        if (rows < kMinTitle || y > kMaxTitle || written / rows < kWritten) return 0;
        return y;
    }

    /// How many columns (or rows) from `outermost` inwards change slowly along themselves, the last
    /// of which differs from the next one.
    int border(bool columns, int outermost, int inwards) const {
        constexpr double kSlow = 0.9, kDiffers = 0.9;  // of the length: the desktop shines through
        const int begin = (columns ? area_.y : area_.x) + kCorner;
        const int end = (columns ? bottom() : right()) - kCorner;
        const auto pixel = [&](int line, int along) {
            return columns ? at(line, along) : at(along, line);
        };
        int found = 0;
        for (int width = 1; width <= kMaxBorder; ++width) {
            const int line = outermost + inwards * (width - 1);
            int slow = 0, differs = 0, all = 0;
            for (int i = begin + 1; i < end; ++i, ++all) {
                slow += same(pixel(line, i), pixel(line, i - 1)) ? 1 : 0;
                differs += same(pixel(line, i), pixel(line + inwards, i)) ? 0 : 1;
            }
            if (all <= 0 || slow < kSlow * all) break;
            if (differs >= kDiffers * all) found = width;
        }
        return found;
    }

    const image::Image& image_;
    Rectangle area_;
};

}  // namespace

Rectangle clientArea(const image::Image& screenshot,
                     const std::optional<image::ImageSize>& expected) {
    if (expected && screenshot.width == expected->width && screenshot.height == expected->height)
        return {0, 0, screenshot.width, screenshot.height};
    Rectangle area = Screenshot(screenshot).find();
    if (!expected) return area;
    // Borders as dark as the content are not seen: the frame is as wide left as right.
    const int wide = area.width - expected->width, high = area.height - expected->height;
    if (wide > 0 && wide <= 2 * kMaxBorder) {
        area.x += wide / 2;
        area.width = expected->width;
    }
    if (high > 0 && high <= (area.y > 0 ? kMaxBorder : kMaxTitle + kMaxBorder)) {
        if (area.y == 0) area.y = std::max(0, high - wide / 2);
        area.height = expected->height;
    }
    return area;
}

}  // namespace farol::grade
