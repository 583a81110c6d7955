#include "worker/tasks/compare.h"

#include <optional>

#include "grade/images/compare.h"
#include "grade/images/comparison_cost.h"
#include "grade/images/flip.h"
#include "image/format.h"
#include "image/image_file.h"
#include "worker/state.h"

namespace farol::worker {
namespace {

image::Image drawn(render::Renderer& renderer, const grade::Subject& subject,
                   const std::optional<image::ImageSize>& size) {
    render::Job job = grade::opened(subject).job;
    job.options = subject.job.options;
    if (size && !job.options.width && !job.options.height) {
        job.options.width = size->width;
        job.options.height = size->height;
    }
    image::Image image;
    renderer.draw(job, image);
    return image;
}

grade::Mask maskOf(const std::string& text, const image::Image& first, const image::Image& second) {
    grade::Mask mask;
    if (text.empty()) return mask;
    grade::requireSameSize(first.width, first.height, second.width, second.height);
    grade::hide(mask, first.width, first.height, {});
    if (text == "axes")
        grade::hideAxes(mask, first, second);
    else
        grade::hide(mask, first.width, first.height, {grade::readRectangle(text, "mask")});
    return mask;
}

}  // namespace

CompareTask::Reply CompareTask::run(const Request& request, WorkerState& state) {
    std::optional<image::Image> pictures[2];
    std::optional<image::ImageSize> size;
    const grade::Subject* subjects[2] = {&request.first, &request.second};
    for (int i = 0; i < 2; ++i) {
        if (!subjects[i]->picture) continue;
        const std::string& name = subjects[i]->job.name;
        pictures[i] =
            grade::cut(image::decodeImage(*subjects[i]->picture, name, {name, 0, 0}), request.crop);
        size = image::ImageSize{pictures[i]->width, pictures[i]->height};
    }
    for (int i = 0; i < 2; ++i)
        if (!pictures[i]) pictures[i] = drawn(state.renderer, *subjects[i], size);
    const image::Image &first = *pictures[0], &second = *pictures[1];
    grade::spendOnComparison(state.renderer.budget(), first.width, first.height);
    const auto [found, shown] = grade::compare(first, second, maskOf(request.mask, first, second));
    Reply reply{grade::toJson(found), "", ""};
    if (!request.pictures) return reply;
    reply.diff = image::encodePng(shown);
    reply.heat = image::encodePng(
        grade::heatMap(grade::flip(grade::FloatImage(first), grade::FloatImage(second))));
    return reply;
}

namespace {
std::uint64_t maxHeatBytes() {
    return maxImageBytes(image::Format::png, static_cast<std::uint64_t>(render::kMaxPixels));
}
}  // namespace

CompareTask::Bounds CompareTask::boundsOf(const Request& request) {
    Bounds bounds{kBaseLimits, request.pictures};
    if (bounds.pictures) bounds.bytes += 2 * maxHeatBytes();
    return bounds;
}

void CompareTask::accept(Reply& reply, const Bounds& bounds) {
    checkJson(reply.json, grade::kComparisonJson, "the comparison");
    for (const std::string* image : {&reply.diff, &reply.heat})
        require(bounds.pictures ? image->size() <= maxHeatBytes() &&
                                      image::hasSignature(*image, image::Format::png)
                                : image->empty(),
                "an image of a comparison");
}

}  // namespace farol::worker
