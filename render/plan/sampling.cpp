#include "render/plan/sampling.h"

#include <algorithm>
#include <array>

namespace farol::render {

Sampling chooseSampling(int wanted, const GlFacts& gl) {
    if (wanted <= 1 || gl.samplePatterns.empty()) return {1, std::max(1, wanted)};
    int most = 1;
    for (const SamplePattern& pattern : gl.samplePatterns) {
        most = static_cast<int>(pattern.size());
        if (most >= wanted) break;
    }
    return {most, std::max(1, wanted / most)};
}

glm::dvec2 passOffset(int pass, int passes) {
    if (passes == 1) return glm::dvec2(0.0);
    // Turned by quarters, and beside GL's usual four samples no two of all passes in one row or
    // column: of such offsets those with the least error of the area beside random edges, a third
    // of them within four degrees of upright or level (rms 0.057 and 0.042 of a pixel; 0.091 for
    // the four alone).
    constexpr std::array<glm::dvec2, 2> kTwo{{{-5.0 / 64, 5.0 / 64}, {5.0 / 64, -5.0 / 64}}};
    constexpr std::array<glm::dvec2, 4> kFour{{{7.0 / 64, 2.0 / 64},
                                               {-2.0 / 64, 7.0 / 64},
                                               {-7.0 / 64, -2.0 / 64},
                                               {2.0 / 64, -7.0 / 64}}};
    if (passes == 2) return kTwo[static_cast<std::size_t>(pass)];
    if (passes <= 4) return kFour[static_cast<std::size_t>(pass)];
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

SamplePattern samplePattern(int wanted, const GlFacts& gl) {
    const Sampling sampling = chooseSampling(wanted, gl);
    const SamplePattern middle{glm::dvec2(0.5)};
    const auto pattern = std::find_if(
        gl.samplePatterns.begin(), gl.samplePatterns.end(), [&](const SamplePattern& one) {
            return one.size() == static_cast<std::size_t>(sampling.samples);
        });
    SamplePattern all;
    for (int pass = 0; pass < sampling.passes; ++pass) {
        // The picture moves by the offset, the samples stay.
        const glm::dvec2 moved = passOffset(pass, sampling.passes);
        for (const glm::dvec2& at : pattern == gl.samplePatterns.end() ? middle : *pattern)
            all.push_back(at - moved);
    }
    return all;
}

}  // namespace farol::render
