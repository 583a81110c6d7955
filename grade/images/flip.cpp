#include "grade/images/flip.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "grade/images/compare.h"

namespace farol::grade {
namespace {

constexpr double kPi = 3.14159265358979323846;

// The paper's constants: exponent and shares of the colour map, width of the features.
constexpr float kQc = 0.7F, kPc = 0.4F, kPt = 0.95F;
constexpr double kFeatureWidthDeg = 0.082;

/// Linear RGB (sRGB primaries) to XYZ, each divided by that of white (D65: the row's sum).
constexpr std::array<std::array<double, 3>, 3> kXyzFromRgb{
    {{10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
     {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
     {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0}}};

using Color = std::array<float, 3>;
using Matrix = std::array<Color, 3>;

Matrix whiteFromRgb() {
    Matrix out{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double sum = kXyzFromRgb[i][0] + kXyzFromRgb[i][1] + kXyzFromRgb[i][2];
        for (std::size_t j = 0; j < 3; ++j) out[i][j] = static_cast<float>(kXyzFromRgb[i][j] / sum);
    }
    return out;
}

Matrix inverse(const Matrix& m) {
    Matrix out{};
    double det = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t r = (j + 1) % 3, s = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
            out[i][j] = m[r][c] * m[s][d] - m[r][d] * m[s][c];
            if (i == 0) det += static_cast<double>(out[i][j]) * static_cast<double>(m[j][0]);
        }
    for (Color& row : out)
        for (float& value : row) value = static_cast<float>(static_cast<double>(value) / det);
    return out;
}

Color times(const Matrix& m, const Color& v) {
    Color out{};
    for (std::size_t i = 0; i < 3; ++i) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return out;
}

/// sRGB decoding by a table: its steps are so fine that a line between them errs below 1e-7.
class Decoder {
  public:
    Decoder() {
        for (std::size_t i = 0; i < table_.size(); ++i) {
            const double v = static_cast<double>(i) / kSteps;
            table_[i] =
                static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
        }
    }
    float operator()(float value) const {
        const float place = std::clamp(value, 0.0F, 1.0F) * kSteps;
        const auto step = static_cast<std::size_t>(place);
        const float rest = place - static_cast<float>(step);
        return table_[step] + rest * (table_[step + 1] - table_[step]);
    }

  private:
    static constexpr int kSteps = 4096;
    std::array<float, kSteps + 2> table_{};
};

/// Cube root of 0.008..2, by two of Halley's steps from a guess of the exponent: exact to float.
float cubeRoot(float value) {
    float root = std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) / 3U + 709921077U);
    for (int step = 0; step < 2; ++step) {
        const float cube = root * root * root;
        root *= (cube + 2.0F * value) / (2.0F * cube + value);
    }
    return root;
}

/// CIE L*a*b* of white-relative XYZ, a* and b* scaled by 0.01 L*: colours are duller in the dark.
Color huntLab(const Color& xyz) {
    constexpr float kDelta = 6.0F / 29.0F;
    Color f{};
    for (std::size_t i = 0; i < 3; ++i)
        f[i] = xyz[i] > kDelta * kDelta * kDelta ? cubeRoot(xyz[i])
                                                 : xyz[i] / (3.0F * kDelta * kDelta) + 4.0F / 29.0F;
    const float lightness = 116.0F * f[1] - 16.0F;
    const float hunt = 0.01F * lightness;
    return {lightness, hunt * 500.0F * (f[0] - f[1]), hunt * 200.0F * (f[1] - f[2])};
}

float hyab(const Color& a, const Color& b) {
    const float da = a[1] - b[1], db = a[2] - b[2];
    return std::abs(a[0] - b[0]) + std::sqrt(da * da + db * db);
}

/// The largest colour difference there is: between green and blue.
float largestDifference() {
    const Matrix toWhite = whiteFromRgb();
    return std::pow(hyab(huntLab(times(toWhite, {0, 1, 0})), huntLab(times(toWhite, {0, 0, 1}))),
                    kQc);
}

/// A sum of Gaussians in the plane, each separable: the contrast sensitivity of one channel.
struct Sensitivity {
    double a1, b1, a2, b2;
};
constexpr Sensitivity kAchromatic{1.0, 0.0047, 0.0, 1e-5};
constexpr Sensitivity kRedGreen{1.0, 0.0053, 0.0, 1e-5};
constexpr Sensitivity kBlueYellow{34.1, 0.04, 13.5, 0.025};

/// Pixels farther out weigh less than a float's last place.
constexpr double kSigmas = 6.0;

/// The wide filter's reach in px: three of its deviations.
int reachOf(double pixelsPerDegree) {
    return static_cast<int>(
        std::ceil(3.0 * std::sqrt(kBlueYellow.b1 / (2.0 * kPi * kPi)) * pixelsPerDegree));
}

Plane sensed(const Plane& channel, const Sensitivity& of, double pixelsPerDegree) {
    const int radius = reachOf(pixelsPerDegree);
    // exp(-pi^2 d^2 / b) with d in degrees is a Gaussian of this many pixels.
    const auto sigma = [&](double b) { return pixelsPerDegree * std::sqrt(b / 2.0) / kPi; };
    if (of.a2 == 0.0) {
        const std::vector<float> weights = gaussian(
            sigma(of.b1), std::min(radius, static_cast<int>(std::ceil(kSigmas * sigma(of.b1)))));
        return filter(channel, weights, weights);
    }
    const auto total = [&](double a, double b) {
        double line = 0.0;
        for (int x = -radius; x <= radius; ++x)
            line += std::exp(-x * x / (2.0 * sigma(b) * sigma(b)));
        return a * std::sqrt(kPi / b) * line * line;
    };
    const double first = total(of.a1, of.b1), second = total(of.a2, of.b2);
    const std::vector<float> wide = gaussian(sigma(of.b1), radius),
                             slim = gaussian(sigma(of.b2), radius);
    Plane out = filter(channel, wide, wide);
    const Plane rest = filter(channel, slim, slim);
    const auto share = static_cast<float>(first / (first + second));
    for (std::size_t i = 0; i < out.values.size(); ++i)
        out.values[i] = share * out.values[i] + (1.0F - share) * rest.values[i];
    return out;
}

/// First (edges) or second (points) derivative of a Gaussian whose width is the paper's; positive
/// weights sum to 1, negative to -1.
std::vector<float> derivative(bool second, double sigma, int radius) {
    std::vector<double> weights;
    double positive = 0.0, negative = 0.0;
    for (int x = -radius; x <= radius; ++x) {
        const double bell = std::exp(-x * x / (2.0 * sigma * sigma));
        weights.push_back((second ? x * x / (sigma * sigma) - 1.0 : -static_cast<double>(x)) *
                          bell);
        (weights.back() > 0.0 ? positive : negative) += std::abs(weights.back());
    }
    std::vector<float> scaled;
    for (const double weight : weights)
        scaled.push_back(static_cast<float>(weight / (weight > 0.0 ? positive : negative)));
    return scaled;
}

/// Returns the length of the vector of the filter's responses along x and y. `smoothed` is the
/// luminance, smoothed along x.
Plane magnitude(const Plane& luminance, const Rows& smoothed, const std::vector<float>& found,
                const std::vector<float>& smooth) {
    Plane out = filter(luminance, found, smooth);
    const Plane down = filterDown(smoothed, found);
    for (std::size_t i = 0; i < out.values.size(); ++i)
        out.values[i] = std::sqrt(out.values[i] * out.values[i] + down.values[i] * down.values[i]);
    return out;
}

}  // namespace

FlipPicture::FlipPicture(const FloatImage& picture, double pixelsPerDegree) {
    static const Decoder linear;
    static const Matrix toWhite = whiteFromRgb();
    static const Matrix toRgb = inverse(toWhite);
    // Opponent space: luminance (16 less and 116 times more in the paper), red-green, blue-yellow.
    std::array<Plane, 3> opponent{picture.red, picture.green, picture.blue};
    for (std::size_t i = 0; i < picture.red.values.size(); ++i) {
        const Color xyz =
            times(toWhite, {linear(picture.red.values[i]), linear(picture.green.values[i]),
                            linear(picture.blue.values[i])});
        opponent[0].values[i] = xyz[1];
        opponent[1].values[i] = xyz[0] - xyz[1];
        opponent[2].values[i] = xyz[1] - xyz[2];
    }
    const double sigma = 0.5 * kFeatureWidthDeg * pixelsPerDegree;
    const int radius = static_cast<int>(std::ceil(3.0 * sigma));
    const std::vector<float> smooth = gaussian(sigma, radius);
    const Rows smoothed = filterAcross(opponent[0], smooth);
    edges = magnitude(opponent[0], smoothed, derivative(false, sigma, radius), smooth);
    points = magnitude(opponent[0], smoothed, derivative(true, sigma, radius), smooth);

    lab = {sensed(opponent[0], kAchromatic, pixelsPerDegree),
           sensed(opponent[1], kRedGreen, pixelsPerDegree),
           sensed(opponent[2], kBlueYellow, pixelsPerDegree)};
    for (std::size_t i = 0; i < lab[0].values.size(); ++i) {
        const float y = lab[0].values[i];
        Color rgb = times(toRgb, {y + lab[1].values[i], y, y - lab[2].values[i]});
        for (float& value : rgb) value = std::clamp(value, 0.0F, 1.0F);
        const Color color = huntLab(times(toWhite, rgb));
        for (std::size_t c = 0; c < 3; ++c) lab[c].values[i] = color[c];
    }
}

namespace {

/// FLIP of the pixels of `wanted`; `test` is the part `at` of its picture.
void flipInto(Plane& out, const FlipPicture& reference, const FlipPicture& test,
              const Rectangle& at, const Rectangle& wanted) {
    static const float most = largestDifference();
    const float knee = kPc * most;
    for (int y = wanted.y; y < wanted.y + wanted.height; ++y)
        for (int x = wanted.x; x < wanted.x + wanted.width; ++x) {
            const auto place = [&](int column, int row, int width) {
                return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                       static_cast<std::size_t>(column);
            };
            const std::size_t i = place(x, y, out.width),
                              j = place(x - at.x, y - at.y, test.edges.width);
            const auto color = [](const FlipPicture& of, std::size_t pixel) {
                return Color{of.lab[0].values[pixel], of.lab[1].values[pixel],
                             of.lab[2].values[pixel]};
            };
            const float apart = hyab(color(reference, i), color(test, j));
            if (apart <= 0.0F) continue;  // 0 to any power that is left
            const float feature =
                std::max(std::abs(reference.edges.values[i] - test.edges.values[j]),
                         std::abs(reference.points.values[i] - test.points.values[j]));
            const float power = std::pow(apart, kQc);
            const float colorError = power < knee
                                         ? kPt / knee * power
                                         : kPt + (power - knee) / (most - knee) * (1.0F - kPt);
            // The paper's exponent of features is a half.
            const float featureError =
                std::min(1.0F, std::sqrt(feature * static_cast<float>(std::sqrt(0.5))));
            out.values[i] = std::pow(std::min(1.0F, colorError), 1.0F - featureError);
        }
}

Plane emptyLike(const Plane& plane) {
    return {plane.width, plane.height, std::vector<float>(plane.values.size())};
}

/// The rectangle and `px` more at each side, within width x height.
Rectangle grown(const Rectangle& from, int px, int width, int height) {
    const int left = std::max(0, from.x - px), top = std::max(0, from.y - px);
    return {left, top, std::min(width, from.x + from.width + px) - left,
            std::min(height, from.y + from.height + px) - top};
}

}  // namespace

Plane flip(const FlipPicture& reference, const FlipPicture& test) {
    const Plane &like = reference.edges, &other = test.edges;
    requireSameSize(like.width, like.height, other.width, other.height);
    Plane out = emptyLike(like);
    const Rectangle all{0, 0, like.width, like.height};
    flipInto(out, reference, test, all, all);
    return out;
}

Plane flip(const FloatImage& reference, const FloatImage& test) {
    return flip(FlipPicture(reference), FlipPicture(test));
}

Plane flip(const FlipPicture& reference, const image::Image& test, const Rectangle& changed) {
    const Plane& like = reference.edges;
    requireSameSize(like.width, like.height, test.width, test.height);
    Plane out = emptyLike(like);
    if (changed.width <= 0 || changed.height <= 0) return out;
    const int reach = reachOf(kPixelsPerDegree);
    // The filters spread a change by `reach`, and need another `reach` of pixels as input there.
    const Rectangle read = grown(changed, 2 * reach, like.width, like.height);
    const FlipPicture part{FloatImage(crop(test, read))};
    flipInto(out, reference, part, read, grown(changed, reach, like.width, like.height));
    return out;
}

}  // namespace farol::grade
