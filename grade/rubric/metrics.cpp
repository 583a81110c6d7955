#include "grade/rubric/metrics.h"

#include <algorithm>
#include <cmath>

#include "grade/images/measures.h"
#include "grade/images/ssim.h"
#include "grade/messages.h"

namespace farol::grade {
namespace {

using Format = MetricColumn::Format;

constexpr int kFullDepth = 12;  // levels: a step of depth well beyond rounding

Measurement oneColumn(double loss) { return {loss, {loss}}; }

Measurement differenceOf(FramePair& pair) {
    if (pair.hasSameColors()) return oneColumn(0.0);
    return oneColumn(shareOf(pair.beyond(), both(pair.content(), pair.counted())));
}

Measurement flipOf(FramePair& pair) {
    if (pair.hasSameColors()) return {0.0, {0.0, 0.0}};
    const image::Image &theirs = pair.reference().color, &mine = pair.submission().color;
    const auto& prepared = pair.reference().flip;
    const Plane seen = prepared ? flip(*prepared, mine, differing(theirs, mine))
                                : flip(FloatImage(theirs), FloatImage(mine));
    const Summary summary = summarize(seen, both(pair.content(), pair.counted()));
    return {summary.mean, {summary.mean, summary.p95}};
}

Measurement ssimOf(FramePair& pair) {
    constexpr int kMinSide = 2 * kSsimReach + 1;  // px: smaller images have no window
    if (pair.hasSameColors() || pair.width() < kMinSide || pair.height() < kMinSide)
        return {0.0, {1.0}};
    const Plane similar =
        ssim(FloatImage(pair.reference().color), FloatImage(pair.submission().color));
    const double mean =
        summarize(similar, ssimMask(pair.counted(), pair.width(), pair.height())).mean;
    return {std::clamp(1.0 - mean, 0.0, 1.0), {mean}};
}

Measurement coverageOf(FramePair& pair) {
    return oneColumn(
        uncovered(pair.reference().ids, pair.submission().ids, pair.width(), pair.height()));
}

Measurement depthOf(FramePair& pair) {
    return oneColumn(
        shareOf(beyondAPixel(pair.reference().depth, pair.submission().depth, kFullDepth),
                pair.sharedObjects()));
}

Measurement normalsOf(FramePair& pair) {
    return oneColumn(
        shareOf(beyondAPixel(pair.reference().normal, pair.submission().normal, kFullLevels),
                pair.sharedObjects()));
}

MetricSpec work(Topic topic, double weight, const char* summary) {
    return {kTopicWords[topic], summary, CauseMetric{topic}, weight};
}

// The tolerances are the losses by rounding, another tessellation order and a pixel's shift in
// docs/grading.md's table, with a margin.
std::vector<MetricSpec> makeMetrics() {
    return {
        {"difference",
         "share of what the images show that is beyond a pixel's shift: per channel outside the "
         "range of the 3x3 pixels around in the other image, the larger of both directions, "
         "whole from 64 levels on. Pixels that show the background in both do not count",
         ImageMetric{.needs = {},
                     .compute = differenceOf,
                     .sentence =
                         [](double loss) {
                             return message<"part.loss/difference">("share"_arg = percent(loss));
                         },
                     .columns = {{"difference", "Differs:", Format::percent}},
                     .tolerance = 0.002,
                     .limit = 0.25},
         35, false},
        {"flip", "mean FLIP (Andersson et al. 2020) over the same pixels",
         ImageMetric{.needs = {.flip = true},
                     .compute = flipOf,
                     .sentence =
                         [](double loss) {
                             return message<"part.loss/flip">(
                                 "value"_arg = shortNumber(std::round(loss * 1000.0) / 1000.0));
                         },
                     .columns = {{"mean", "FLIP mean", Format::decimals},
                                 {"p95", "95th percentile", Format::decimals}},
                     .tolerance = 0.05,
                     .limit = 0.5},
         5, false},
        {"ssim", "1 - mean SSIM (Wang et al. 2004); reports show the mean itself",
         ImageMetric{
             .needs = {},
             .compute = ssimOf,
             .sentence =
                 [](double loss) { return message<"part.loss/ssim">("share"_arg = percent(loss)); },
             .columns = {{"ssim", "SSIM", Format::decimals}}},
         1, false},
        {"coverage",
         "1 - IoU of each object's pixels, mean over the objects by the root of their areas; a "
         "pixel at edges is free. Objects are matched by what they are, not by number",
         ImageMetric{.needs = {.ids = true},
                     .compute = coverageOf,
                     .sentence =
                         [](double loss) {
                             return message<"part.loss/coverage">("share"_arg = percent(loss));
                         },
                     .columns = {{"coverage", "objects elsewhere", Format::percent}},
                     .tolerance = 0.02,
                     .limit = 0.6},
         10, false},
        {"depth", "share of the pixels of the same object that are farther or nearer",
         ImageMetric{.needs = {.ids = true, .depth = true},
                     .compute = depthOf,
                     .sentence =
                         [](double loss) {
                             return message<"part.loss/depth">("share"_arg = percent(loss));
                         },
                     .columns = {{"depth", "other depth", Format::percent}},
                     .tolerance = 0.01,
                     .limit = 0.5},
         5, false},
        {"normals", "share of the pixels of the same object that are turned another way",
         ImageMetric{.needs = {.ids = true, .normals = true},
                     .compute = normalsOf,
                     .sentence =
                         [](double loss) {
                             return message<"part.loss/normals">("share"_arg = percent(loss));
                         },
                     .columns = {{"normals", "other normals", Format::percent}},
                     .tolerance = 0.01,
                     .limit = 0.5},
         5, false},
        work(Topic::models, 22, "objects that are there, with their shapes"),
        work(Topic::transforms, 25, "objects that stand where they should"),
        work(Topic::textures, 9, "textures, coordinates, background"),
        work(Topic::materials, 9, "colours and shading"),
        work(Topic::lights, 15, "lights, as far as there are objects to light"),
        work(Topic::camera, 10, "the scene's own camera, as far as there are objects to see"),
        work(Topic::animation, 10, "what moves; where nothing does, the others share its points"),
    };
}

}  // namespace

std::span<const MetricSpec> metrics() {
    static const std::vector<MetricSpec> kMetrics = makeMetrics();
    return kMetrics;
}

const MetricSpec& mainMetric() { return metrics().front(); }

std::string percent(double share) { return shortNumber(std::round(share * 1000.0) / 10.0) + " %"; }

}  // namespace farol::grade
