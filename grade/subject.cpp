#include "grade/subject.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <vector>

#include "scene/archive.h"
#include "scene/words.h"

namespace farol::grade {
namespace {

namespace fs = std::filesystem;

std::string endingOf(const std::string& name) {
    const std::string ending = scene::lowerCase(fs::path(name).extension().string());
    return ending.empty() ? ending : ending.substr(1);
}

std::string stemOf(const std::string& path) {
    return scene::lowerCase(fs::path(path).stem().string());
}

long depthOf(const std::string& path) { return std::count(path.begin(), path.end(), '/'); }

/// The one of `paths` that is meant, or nothing.
std::string chooseOf(const std::vector<std::string>& paths, const std::string& task) {
    const auto only = [](const std::vector<std::string>& some) {
        return some.size() == 1 ? some.front() : std::string();
    };
    if (!task.empty()) {
        std::vector<std::string> named;
        for (const std::string& path : paths)
            if (stemOf(path) == scene::lowerCase(task) ||
                stemOf(fs::path(path).parent_path().string()) == scene::lowerCase(task))
                named.push_back(path);
        return only(named);
    }
    if (paths.size() == 1) return paths.front();
    std::vector<std::string> usual, highest;
    long least = 1'000'000;
    for (const std::string& path : paths) {
        if (stemOf(path) == "scene") usual.push_back(path);
        least = std::min(least, depthOf(path));
    }
    for (const std::string& path : paths)
        if (depthOf(path) == least) highest.push_back(path);
    const std::string scene = only(usual);
    return scene.empty() ? only(highest) : scene;
}

}  // namespace

bool isArchiveName(const std::string& name) {
    static const std::set<std::string> kEndings{"zip", "tar", "tgz", "gz"};
    return kEndings.count(endingOf(name)) != 0;
}

bool isPictureName(const std::string& name) {
    static const std::set<std::string> kEndings{"png", "jpg", "jpeg", "webp", "bmp", "tga"};
    return kEndings.count(endingOf(name)) != 0;
}

Subject subjectOf(std::map<std::string, std::string> files, const std::string& where,
                  const std::string& task) {
    std::vector<std::string> scenes, pictures, archives;
    for (const auto& [name, bytes] : files) {
        const std::string kind = endingOf(name);
        if (kind == "xml") scenes.push_back(name);
        if (isPictureName(name)) pictures.push_back(name);
        if (isArchiveName(name)) archives.push_back(name);
    }
    Subject subject;
    const std::string scene = chooseOf(scenes, task);
    if (!scene.empty()) {
        subject.job.name = scene;
        subject.job.xml = files[scene];
        // Files are named relative to the scene's own folder.
        const std::string folder = fs::path(scene).parent_path().generic_string();
        std::map<std::string, std::string> near;
        for (auto& [name, bytes] : files)
            near[!folder.empty() && name.starts_with(folder + "/") ? name.substr(folder.size() + 1)
                                                                   : name] = std::move(bytes);
        subject.job.name = fs::path(scene).filename().string();
        subject.job.assets = std::make_shared<scene::BundleAssets>(std::move(near));
        return subject;
    }
    if (scenes.empty() && archives.size() == 1) {
        subject.job.archive = files[archives.front()];
        subject.job.name = archives.front();
        subject.task = task;
        return subject;
    }
    if (scenes.empty()) {
        const std::string picture = chooseOf(pictures, task);
        if (!picture.empty()) {
            subject.job.name = picture;
            subject.picture = files[picture];
            return subject;
        }
    }
    if (!scenes.empty() && task.empty())
        throw Error("grade.which-scene",
                    "it holds " + std::to_string(scenes.size()) +
                        " .xml files, and none is called scene.xml",
                    {where, 0, 0});
    throw Error("grade.no-scene",
                task.empty() ? "it holds no .xml file, archive or picture"
                             : "it holds nothing that is called " + scene::shown(task),
                {where, 0, 0});
}

Subject opened(const Subject& subject) {
    if (subject.job.archive.empty()) return subject;
    auto files = scene::readFiles(subject.job.archive);
    std::erase_if(files, [](const auto& file) { return isArchiveName(file.first); });
    return subjectOf(std::move(files), subject.job.name, subject.task);
}

}  // namespace farol::grade
