// OpenEXR by OpenImageIO in its module; its head is checked here first.
#include <algorithm>
#include <array>
#include <stdexcept>

#include "image/decoder.h"
#include "image/exr_head.h"
#include "image/module.h"

namespace farol::image {
namespace {

/// Places spans of the data window in the image, the display window.
struct Target {
    const ExrHead& head;
    Decoded& out;
    std::int64_t count = 0;  ///< pixels received

    /// Clamps a display value to 0..1; NaN becomes 0.
    static std::uint8_t clamp(float value) {
        return value > 0.0F ? static_cast<std::uint8_t>(std::min(value, 1.0F) * 255.0F + 0.5F)
                            : std::uint8_t{0};
    }

    void place(const float* from, std::uint8_t* to) const {
        const int colors = head.isGrey ? 1 : 3;
        const float alpha = head.hasAlpha ? from[colors] : 1.0F;
        const bool isMultiplied = alpha > 0.0F && alpha < 1.0F;
        for (int c = 0; c < colors; ++c) to[c] = clamp(isMultiplied ? from[c] / alpha : from[c]);
        if (head.hasAlpha) to[colors] = clamp(alpha);
    }

    static void take(void* user, int x, int y, int count, const float* samples) {
        Target& target = *static_cast<Target*>(user);
        target.count += count;
        const ExrHead& head = target.head;
        const std::int64_t row = head.data.top + y - head.display.top;
        if (row < 0 || row >= head.display.height) return;
        const std::int64_t first = head.data.left + x - head.display.left;
        const auto channels = static_cast<std::size_t>(head.channels());
        const std::int64_t end = std::min<std::int64_t>(count, head.display.width - first);
        for (std::int64_t i = std::max<std::int64_t>(0, -first); i < end; ++i)
            target.place(samples + static_cast<std::size_t>(i) * channels,
                         target.out.row(static_cast<int>(row)) +
                             static_cast<std::size_t>(first + i) * channels);
    }
};

}  // namespace

void readExr(std::string_view bytes, bool wantsPixels, Decoded& out) {
    const ExrHead head = readExrHead(bytes);
    if (!out.announce(head.display.width, head.display.height, head.channels()) || !wantsPixels)
        return;
    static constexpr std::array<const char*, 4> kColors{"R", "G", "B", "A"};
    static constexpr std::array<const char*, 2> kGrey{"Y", "A"};
    out.allocate();
    Target target{head, out};
    readByModule({.format = "openexr",
                  .bytes = bytes,
                  .left = static_cast<int>(head.data.left),
                  .top = static_cast<int>(head.data.top),
                  .width = static_cast<int>(head.data.width),
                  .height = static_cast<int>(head.data.height),
                  .tileWidth = head.tileWidth,
                  .tileHeight = head.tileHeight,
                  .channels = head.isGrey ? kGrey.data() : kColors.data(),
                  .channelCount = head.channels(),
                  .take = Target::take,
                  .user = &target});
    if (target.count != head.data.width * head.data.height)
        throw std::runtime_error("its size and its pixels differ");
}

}  // namespace farol::image
