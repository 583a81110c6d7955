#include "tests/support/ray_caster/texture.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace farol::reference {
namespace {

int wrapped(int i, int size) {
    const int rest = i % size;
    return rest < 0 ? rest + size : rest;
}

}  // namespace

Texture::Texture(const Pixels& pixels) {
    Level base{pixels.width, pixels.height, {}};
    if (pixels.width < 1 || pixels.height < 1 ||
        pixels.rgb.size() !=
            3 * static_cast<std::size_t>(pixels.width) * static_cast<std::size_t>(pixels.height) ||
        (!pixels.alpha.empty() && pixels.rgb.size() != 3 * pixels.alpha.size()))
        throw std::invalid_argument("a texture's size and its values differ");
    kind_ = kindOf(pixels);
    for (int y = pixels.height - 1; y >= 0; --y)
        for (int x = 0; x < pixels.width; ++x) {
            const auto at = static_cast<std::size_t>(y * pixels.width + x);
            const std::uint8_t* p = &pixels.rgb[3 * at];
            const double alpha = kind_ == Kind::opaque ? 1.0 : pixels.alpha[at] / 255.0;
            base.texels.push_back(alpha * glm::dvec4(glm::dvec3(p[0], p[1], p[2]) / 255.0, 1.0));
        }
    levels_.push_back(std::move(base));
    while (levels_.back().width > 1 || levels_.back().height > 1) {
        Level next{
            std::max(1, levels_.back().width / 2), std::max(1, levels_.back().height / 2), {}};
        const Level& from = levels_.front();
        const double stepX = static_cast<double>(from.width) / next.width;
        const double stepY = static_cast<double>(from.height) / next.height;
        for (int y = 0; y < next.height; ++y)
            for (int x = 0; x < next.width; ++x) {
                glm::dvec4 sum(0.0);
                const double x0 = x * stepX, x1 = (x + 1) * stepX;
                const double y0 = y * stepY, y1 = (y + 1) * stepY;
                for (int j = static_cast<int>(y0); j < std::min(from.height, int(std::ceil(y1)));
                     ++j)
                    for (int i = static_cast<int>(x0); i < std::min(from.width, int(std::ceil(x1)));
                         ++i) {
                        const double wide = std::min(x1, i + 1.0) - std::max(x0, double(i));
                        const double high = std::min(y1, j + 1.0) - std::max(y0, double(j));
                        sum += std::max(0.0, wide) * std::max(0.0, high) *
                               from.texels[static_cast<std::size_t>(j * from.width + i)];
                    }
                next.texels.push_back(sum / (stepX * stepY));
            }
        levels_.push_back(std::move(next));
    }
    if (kind_ != Kind::cutOut) return;
    for (std::size_t i = 1; i < levels_.size(); ++i) keepCoverage(levels_[i]);
}

Texture::Kind Texture::kindOf(const Pixels& pixels) {
    const auto count = [&](int low, int high) {
        return std::count_if(pixels.alpha.begin(), pixels.alpha.end(),
                             [&](int alpha) { return alpha >= low && alpha <= high; });
    };
    const auto all = static_cast<std::ptrdiff_t>(pixels.alpha.size());
    if (count(255, 255) == all || count(0, 0) == all) return Kind::opaque;
    return count(0, 7) > 0 && 10 * count(8, 247) <= all ? Kind::cutOut : Kind::blended;
}

/// The factor puts the alpha at half whose texels, with those above, are as many as of the picture.
void Texture::keepCoverage(Level& level) const {
    const auto half = [](const glm::dvec4& texel) { return texel.a >= 128.0 / 255.0; };
    const std::vector<glm::dvec4>& base = levels_.front().texels;
    const double share = static_cast<double>(std::count_if(base.begin(), base.end(), half)) /
                         static_cast<double>(base.size());
    std::vector<int> alphas;
    for (const glm::dvec4& texel : level.texels)
        alphas.push_back(static_cast<int>(std::lround(255.0 * texel.a)));
    int best = 128;
    double least = 2.0;
    for (int threshold = 1; threshold <= 255; ++threshold) {
        const auto there = std::count_if(alphas.begin(), alphas.end(),
                                         [&](int alpha) { return alpha >= threshold; });
        const double off =
            std::abs(static_cast<double>(there) / static_cast<double>(alphas.size()) - share);
        const bool isCloser = off == least && std::abs(threshold - 128) < std::abs(best - 128);
        if (off > least || (off == least && !isCloser)) continue;
        least = off;
        best = threshold;
    }
    for (glm::dvec4& texel : level.texels)
        if (texel.a > 0.0) texel *= std::min(1.0, texel.a * 128.0 / best) / texel.a;
}

glm::ivec2 Texture::size(std::size_t level) const {
    return {levels_.at(level).width, levels_.at(level).height};
}

const glm::dvec4& Texture::texel(std::size_t level, int column, int row) const {
    const Level& one = levels_.at(level);
    return one.texels[static_cast<std::size_t>(wrapped(row, one.height) * one.width +
                                               wrapped(column, one.width))];
}

double Texture::levelOfDetail(const glm::dvec2& dx, const glm::dvec2& dy) const {
    const glm::dvec2 size(levels_[0].width, levels_[0].height);
    return std::log2(std::max(glm::length(dx * size), glm::length(dy * size)));
}

glm::dvec4 Texture::linear(std::size_t level, const glm::dvec2& uv) const {
    const Level& one = levels_[level];
    const double x = (uv.x - std::floor(uv.x)) * one.width - 0.5;
    const double y = (uv.y - std::floor(uv.y)) * one.height - 0.5;
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    const double a = x - i, b = y - j;
    return glm::mix(glm::mix(texel(level, i, j), texel(level, i + 1, j), a),
                    glm::mix(texel(level, i, j + 1), texel(level, i + 1, j + 1), a), b);
}

glm::dvec4 Texture::sample(const glm::dvec2& uv, const glm::dvec2& dx, const glm::dvec2& dy,
                           scene::Filter filter) const {
    if (filter == scene::Filter::anisotropic)
        throw std::invalid_argument("the reference has no anisotropic filter");
    if (filter == scene::Filter::nearest) {
        const Level& base = levels_[0];
        const glm::dvec2 part = uv - glm::floor(uv);
        return texel(0, static_cast<int>(part.x * base.width),
                     static_cast<int>(part.y * base.height));
    }
    const double detail = filter == scene::Filter::mipmap ? levelOfDetail(dx, dy) : 0.0;
    if (!(detail > 0.0)) return linear(0, uv);
    const double last = static_cast<double>(levels_.size() - 1);
    const double level = std::floor(std::min(detail, last));
    const auto index = static_cast<std::size_t>(level);
    if (level >= last) return linear(index, uv);
    return glm::mix(linear(index, uv), linear(index + 1, uv), detail - level);
}

}  // namespace farol::reference
