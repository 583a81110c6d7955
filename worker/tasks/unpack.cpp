#include "worker/tasks/unpack.h"

#include "core/digest.h"
#include "scene/files/archive.h"

namespace farol::worker {

scene::Bundle UnpackTask::run(const Request& request, WorkerState&) {
    return scene::readArchive(request.archive);
}

JobFacts UnpackTask::factsOf(const Request& request) {
    return {contentDigest(request.archive), true};
}

UnpackTask::Bounds UnpackTask::boundsOf(const Request& request) {
    Bounds bounds{kBaseLimits};
    bounds.fileBytes = scene::maxUnpackedBytes(request.archive.size());
    bounds.bytes += bounds.fileBytes;
    bounds.entries += scene::Assets::kMaxListed;
    return bounds;
}

void UnpackTask::accept(Reply& bundle, const Bounds& bounds) {
    require(bundle.files.size() <= scene::Assets::kMaxListed && bundle.bytes() <= bounds.fileBytes,
            "the files of an archive");
    // A compromised worker must not choose the paths that are written.
    for (const auto& [path, content] : bundle.files)
        require(scene::isSafePath(path), "an unsafe path");
    require(bundle.files.count(bundle.main) == 1, "an archive without its scene");
}

}  // namespace farol::worker
