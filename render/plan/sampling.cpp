#include "render/plan/sampling.h"

#include <algorithm>
#include <array>

namespace farol::render {

Sampling chooseSampling(int wanted, const GlFacts& gl, int side) {
    if (wanted <= 1) return {};
    if (wanted <= 4)
        for (const SamplePattern& pattern : gl.samplePatterns)
            if (static_cast<int>(pattern.size()) >= wanted)
                return {1, static_cast<int>(pattern.size()), 1};
    // Chosen by time against error (docs/benchmarks/accuracy.md). Each pass draws all triangles
    // again; within a pass the samples form a regular grid.
    constexpr std::array<Sampling, 6> kLarger{
        {{2, 1, 1}, {3, 1, 1}, {2, 1, 2}, {3, 1, 2}, {2, 1, 4}, {1, 1, 16}}};
    for (const Sampling& one : kLarger)
        if (one.scale * one.scale * one.passes >= wanted && one.scale * side <= gl.maxTargetSide)
            return one;
    return kLarger.back();
}

double errorOf(double errorPx, int samples) {
    return samples > 4 ? std::min(errorPx, 1.0 / samples) : errorPx;
}

glm::dvec2 passOffset(int pass, const Sampling& sampling) {
    if (sampling.passes == 1) return glm::dvec2(0.0);
    constexpr std::array<glm::dvec2, 2> kTwo{{{-1.0 / 4, 1.0 / 4}, {1.0 / 4, -1.0 / 4}}};
    constexpr std::array<glm::dvec2, 4> kFour{
        {{1.0 / 8, 3.0 / 8}, {3.0 / 8, -1.0 / 8}, {-1.0 / 8, -3.0 / 8}, {-3.0 / 8, 1.0 / 8}}};
    const auto at = static_cast<std::size_t>(pass);
    if (sampling.passes == 2) return kTwo[at] / double(sampling.scale);
    if (sampling.passes == 4) return kFour[at] / double(sampling.scale);
    // Halton points of bases 2 and 3.
    const auto halton = [](int index, int base) {
        double value = 0.0;
        double fraction = 1.0;
        for (int i = index; i > 0; i /= base) {
            fraction /= base;
            value += fraction * (i % base);
        }
        return value;
    };
    return glm::dvec2(halton(pass + 1, 2) - 0.5, halton(pass + 1, 3) - 0.5) /
           double(sampling.scale);
}

SamplePattern samplePattern(const Sampling& sampling, const GlFacts& gl) {
    const SamplePattern middle{glm::dvec2(0.5)};
    const auto pattern = std::find_if(
        gl.samplePatterns.begin(), gl.samplePatterns.end(), [&](const SamplePattern& one) {
            return one.size() == static_cast<std::size_t>(sampling.samples);
        });
    SamplePattern all;
    for (int pass = 0; pass < sampling.passes; ++pass) {
        // The picture moves by the offset, the samples stay.
        const glm::dvec2 moved = passOffset(pass, sampling);
        for (int y = 0; y < sampling.scale; ++y)
            for (int x = 0; x < sampling.scale; ++x)
                for (const glm::dvec2& at : pattern == gl.samplePatterns.end() ? middle : *pattern)
                    all.push_back((glm::dvec2(x, y) + at) / double(sampling.scale) - moved);
    }
    return all;
}

}  // namespace farol::render
