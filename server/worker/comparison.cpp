#include "server/worker/comparison.h"

#include <optional>

#include "grade/compare.h"
#include "grade/flip.h"
#include "render/encode.h"
#include "render/image_file.h"

namespace farol::server::worker {
namespace {

render::Image drawn(render::Renderer& renderer, const grade::Subject& subject,
                    const std::optional<render::ImageSize>& size) {
    render::Job job = grade::opened(subject).job;
    job.options = subject.job.options;
    if (size && !job.options.width && !job.options.height) {
        job.options.width = size->width;
        job.options.height = size->height;
    }
    render::Image image;
    renderer.draw(job, image);
    return image;
}

grade::Mask maskOf(const std::string& text, const render::Image& first,
                   const render::Image& second) {
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

CompareReply compareSubjects(render::Renderer& renderer, const CompareJob& job) {
    std::optional<render::Image> pictures[2];
    std::optional<render::ImageSize> size;
    const grade::Subject* subjects[2] = {&job.first, &job.second};
    for (int i = 0; i < 2; ++i) {
        if (subjects[i]->picture.empty()) continue;
        const std::string& name = subjects[i]->job.name;
        pictures[i] =
            grade::cut(render::decodeImage(subjects[i]->picture, name, {name, 0, 0}), job.crop);
        size = render::ImageSize{pictures[i]->width, pictures[i]->height};
    }
    for (int i = 0; i < 2; ++i)
        if (!pictures[i]) pictures[i] = drawn(renderer, *subjects[i], size);
    const render::Image &first = *pictures[0], &second = *pictures[1];
    const auto [found, shown] = grade::compare(first, second, maskOf(job.mask, first, second));
    CompareReply reply{grade::toJson(found), "", ""};
    if (!job.pictures) return reply;
    reply.diff = render::encodePng(shown);
    reply.heat = render::encodePng(
        grade::heatMap(grade::flip(grade::FloatImage(first), grade::FloatImage(second))));
    return reply;
}

}  // namespace farol::server::worker
