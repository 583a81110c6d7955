#include "render/sampling.h"

#include <algorithm>
#include <array>

namespace farol::render {

Sampling chooseSampling(int wanted, int most) {
    if (wanted <= 1 || most <= 1) return {1, std::max(1, wanted)};
    return {most, std::max(1, wanted / most)};
}

glm::dvec2 passOffset(int pass, int passes) {
    if (passes == 1) return glm::dvec2(0.0);
    constexpr std::array<glm::dvec2, 4> kQuarter{
        {{-0.125, -0.125}, {0.125, 0.125}, {0.125, -0.125}, {-0.125, 0.125}}};
    if (passes <= 4) return kQuarter[static_cast<std::size_t>(pass)];
    // Without multisampling: Halton points of bases 2 and 3.
    const auto halton = [](int index, int base) {
        double value = 0.0;
        double fraction = 1.0;
        for (int i = index; i > 0; i /= base) {
            fraction /= base;
            value += fraction * (i % base);
        }
        return value;
    };
    return {halton(pass + 1, 2) - 0.5, halton(pass + 1, 3) - 0.5};
}

const SamplePattern& glSamplePattern() {
    static const SamplePattern pattern{
        {0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}};
    return pattern;
}

SamplePattern samplePattern(int wanted) {
    const Sampling sampling = chooseSampling(wanted, kGlSamples);
    SamplePattern all;
    for (int pass = 0; pass < sampling.passes; ++pass) {
        // The picture moves by the offset, the samples stay.
        const glm::dvec2 moved = passOffset(pass, sampling.passes);
        if (sampling.samples == 1)
            all.push_back(glm::dvec2(0.5) - moved);
        else
            for (const glm::dvec2& at : glSamplePattern()) all.push_back(at - moved);
    }
    return all;
}

}  // namespace farol::render
