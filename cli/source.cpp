#include "cli/source.h"

#include <filesystem>
#include <memory>

#include "cli/command.h"
#include "cli/files.h"
#include "scene/archive.h"

namespace farol::cli {

render::Job openSource(const std::string& path, const std::string& assets, bool strict) {
    if (!assets.empty() && !std::filesystem::is_directory(assets))
        throw UsageError("--assets: there is no folder " + assets);
    render::Job job;
    job.name = path == "-" ? "scene.xml" : path;
    job.xml = readInput(path);
    job.assets = std::make_shared<scene::FolderAssets>(assets.empty() ? folderOf(path) : assets);
    job.strict = strict;
    if (scene::isArchive(job.xml)) {  // a bundle; its files are all there is
        job.archive = std::move(job.xml);
        job.xml.clear();
    }
    return job;
}

}  // namespace farol::cli
