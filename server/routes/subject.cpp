#include "server/routes/subject.h"

#include "core/text.h"
#include "image/format.h"
#include "scene/files/archive.h"
#include "scene/files/assets.h"

namespace farol::server {
namespace {

bool isPicture(const Part& part) {
    for (std::size_t i = 0; i < image::kFormats.size(); ++i)
        if (image::hasSignature(part.content, image::Format(i))) return true;
    // TGA has no signature, and BMP one of two letters.
    return grade::isPictureName(part.fileName) && !trimmed(part.content).starts_with("<");
}

}  // namespace

grade::Subject subjectOf(Part part) {
    grade::Subject subject;
    subject.job.name = std::string(baseName(part.fileName));
    if (subject.job.name.empty()) subject.job.name = "scene.xml";
    if (scene::isArchive(part.content)) {
        subject.job.archive = std::move(part.content);
    } else if (isPicture(part)) {
        subject.picture = std::move(part.content);
    } else {
        const std::string& name = subject.job.name;
        subject.job.assets =
            std::make_shared<scene::BundleAssets>(scene::BundleAssets::Files{{name, part.content}});
        subject.job.xml = std::move(part.content);
    }
    return subject;
}

}  // namespace farol::server
