#include "server/routes/subject.h"

#include "core/text.h"
#include "scene/files/archive.h"
#include "scene/files/assets.h"

namespace farol::server {

grade::Subject subjectOf(Part part) {
    grade::Subject subject;
    subject.job.name = std::string(baseName(part.fileName));
    if (subject.job.name.empty()) subject.job.name = "scene.xml";
    const std::string_view text = trimmed(part.content);
    if (scene::isArchive(part.content)) {
        subject.job.archive = std::move(part.content);
    } else if (text.starts_with("<") || text.starts_with("\xEF\xBB\xBF<")) {
        const std::string& name = subject.job.name;
        subject.job.assets =
            std::make_shared<scene::BundleAssets>(scene::BundleAssets::Files{{name, part.content}});
        subject.job.xml = std::move(part.content);
    } else {
        subject.picture = std::move(part.content);
    }
    return subject;
}

}  // namespace farol::server
