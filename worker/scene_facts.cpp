#include "worker/scene_facts.h"

#include "core/digest.h"

namespace farol::worker {
namespace {

/// True for a scene of the served folder. An upload has no folder, or, beside the files of a served
/// scene, a digest as its identity instead of an entity tag.
bool isServed(const render::Job& job) {
    return dynamic_cast<const scene::FolderAssets*>(job.assets.get()) != nullptr &&
           job.identity.starts_with('"');
}

std::string sceneOf(const render::Job& job) {
    if (!job.identity.empty()) return job.identity;
    std::string all = job.name + "\n" + job.path + "\n" + job.xml + "\n";
    if (const auto* folder = dynamic_cast<const scene::FolderAssets*>(job.assets.get()))
        all += folder->root();
    else if (job.assets)
        for (const std::string& path : job.assets->list())
            all += path + "\n" + job.assets->version(path) + "\n";
    return contentDigest(all);
}

}  // namespace

JobFacts factsOf(const render::Job& job) { return {sceneOf(job), !isServed(job)}; }

}  // namespace farol::worker
