#pragma once

#include <cstddef>
#include <vector>

#include "image/image.h"

namespace farol::grade {

/// One number a pixel: width * height floats, top row first.
struct Plane {
    int width = 0, height = 0;
    std::vector<float> values;

    float at(int x, int y) const {
        return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)];
    }
};

/// A colour image in floats: display values (sRGB-encoded) 0..1, three planes of one size. From an
/// 8-bit image, transparent pixels are composited over black.
struct FloatImage {
    FloatImage(int width, int height)
        : red{width, height, {}}, green{width, height, {}}, blue{width, height, {}} {
        for (Plane* plane : {&red, &green, &blue})
            plane->values.resize(static_cast<std::size_t>(width) *
                                 static_cast<std::size_t>(height));
    }
    explicit FloatImage(const image::Image& image);

    int width() const { return red.width; }
    int height() const { return red.height; }
    Plane red, green, blue;
};

/// Which pixels count: width * height bytes, 0 or 1; no bytes: all of them.
struct Mask {
    std::vector<std::uint8_t> counts;
    bool operator()(std::size_t pixel) const { return counts.empty() || counts[pixel] != 0; }
};

/// The distribution of a plane over the pixels that count; all 0 where none does.
struct Summary {
    double mean = 0, median = 0, p95 = 0, p99 = 0, max = 0;  ///< percentiles by nearest rank
};
Summary summarize(const Plane& plane, const Mask& mask = {});

/// A plane that is filtered across, and still to be filtered down: one serves several filters.
struct Rows {
    int width = 0, height = 0;
    std::size_t stride = 0;  ///< floats from row to row; those beyond the width mean nothing
    std::vector<float> values;
};

/// The plane filtered by rows with `across` and by columns with `down`: weights of odd number,
/// applied as a correlation; beyond the border the nearest pixel repeats.
Plane filter(const Plane& plane, const std::vector<float>& across, const std::vector<float>& down);
Rows filterAcross(const Plane& plane, const std::vector<float>& weights);
Plane filterDown(const Rows& rows, const std::vector<float>& weights);

/// exp(-x^2 / (2 sigma^2)) at -radius..radius px, scaled to the sum 1.
std::vector<float> gaussian(double sigma, int radius);

/// Throws Error image.size unless both pictures have the same size, of at least one pixel.
void requireSameSize(int widthA, int heightA, int widthB, int heightB);

}  // namespace farol::grade
