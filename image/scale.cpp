#include <algorithm>

#include "image/image.h"

namespace farol::image {
namespace {

/// RGBA texels at equal distances: a row or a column of an image.
struct Line {
    std::size_t step;  ///< samples from one texel to the next
    int count;
};

/// Target texel t is the mean of the source from t * source.count to (t + 1) * source.count, in
/// units of 1 / target.count texels, weighted by the covered length.
void shrinkLine(const std::uint8_t* from, Line source, std::uint8_t* to, Line target) {
    const auto length = static_cast<std::uint64_t>(source.count);
    const auto unit = static_cast<std::uint64_t>(target.count);
    for (std::uint64_t t = 0; t < unit; ++t) {
        const std::uint64_t begin = t * length, end = begin + length;
        std::uint64_t sum[4] = {length / 2, length / 2, length / 2, length / 2};
        for (std::uint64_t at = begin / unit; at * unit < end; ++at) {
            const std::uint64_t weight =
                std::min(end, (at + 1) * unit) - std::max(begin, at * unit);
            const std::uint8_t* texel = from + at * source.step;
            for (int c = 0; c < 4; ++c) sum[c] += weight * texel[c];
        }
        for (int c = 0; c < 4; ++c)
            to[t * target.step + static_cast<std::uint64_t>(c)] =
                static_cast<std::uint8_t>(sum[c] / length);
    }
}

Image blank(int width, int height) {
    Image image{width, height, {}};
    image.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
    return image;
}

}  // namespace

Image scaleDown(Image image, int width, int height) {
    if (width < image.width) {
        Image narrow = blank(width, image.height);
        const std::size_t before = static_cast<std::size_t>(image.width) * 4;
        const std::size_t after = static_cast<std::size_t>(width) * 4;
        for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y)
            shrinkLine(&image.pixels[y * before], {4, image.width}, &narrow.pixels[y * after],
                       {4, width});
        image = std::move(narrow);
    }
    if (height < image.height) {
        Image low = blank(image.width, height);
        const std::size_t stride = static_cast<std::size_t>(image.width) * 4;
        for (std::size_t x = 0; x < stride; x += 4)
            shrinkLine(&image.pixels[x], {stride, image.height}, &low.pixels[x], {stride, height});
        image = std::move(low);
    }
    return image;
}

}  // namespace farol::image
