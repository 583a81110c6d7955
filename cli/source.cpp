#include "cli/source.h"

#include <filesystem>
#include <memory>

#include "cli/command.h"
#include "cli/files.h"
#include "cli/messages.h"
#include "scene/files/archive.h"

namespace farol::cli {

std::string assetFolder(const std::string& path, const std::string& assets) {
    if (!assets.empty()) return assets;
    return path != "-" && std::filesystem::is_directory(path) ? path : folderOf(path);
}

/// The document's path below the folder of its files; empty where it is outside of it.
static std::string pathBelow(const std::string& path, const std::string& assets) {
    namespace fs = std::filesystem;
    if (assets.empty() || path == "-") return "";
    std::error_code failed;
    const fs::path below = fs::relative(path, assets, failed);
    const std::string text = below.generic_string();
    return failed || text == "." || text.starts_with("..") ? "" : text;
}

render::Job openSource(const std::string& path, const std::string& assets, bool strict) {
    if (!assets.empty() && !std::filesystem::is_directory(assets))
        throw UsageError(message<"usage/assets">("path"_arg = uncut(assets)));
    render::Job job;
    job.strict = strict;
    if (path != "-" && std::filesystem::is_directory(path)) {
        const auto folder = std::make_shared<scene::FolderAssets>(assets.empty() ? path : assets);
        const std::string inside = scene::mainOf(scene::FolderAssets(path));
        job.name = (std::filesystem::path(path) / inside).string();
        job.xml = readInput(job.name);
        job.path = assets.empty() ? inside : pathBelow(job.name, assets);
        job.assets = folder;
        return job;
    }
    job.name = path == "-" ? "scene.xml" : path;
    job.xml = readInput(path);
    job.assets = std::make_shared<scene::FolderAssets>(assetFolder(path, assets));
    job.path = pathBelow(path, assets);
    if (scene::isArchive(job.xml)) {  // a bundle; its files are all there is
        job.archive = std::move(job.xml);
        job.xml.clear();
    }
    return job;
}

}  // namespace farol::cli
