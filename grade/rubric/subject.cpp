#include "grade/rubric/subject.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <vector>

#include "core/text.h"
#include "scene/files/archive.h"

namespace farol::grade {
namespace {

namespace fs = std::filesystem;

/// In UTF-8: names of one task may come from systems that write them otherwise.
std::string stemOf(const std::string& path) {
    return lowerCase(nameToUtf8(fs::path(path).stem().string()));
}

/// Throws Error grade.empty-file.
std::string contentOf(const scene::Assets& files, const std::string& name,
                      const std::string& where) {
    std::string bytes = files.read(name).value_or("");
    if (bytes.empty())
        throw Error("grade.empty-file",
                    "file " + farol::quoted(name) + " is empty (0 bytes); hand in the file again",
                    {where, 0, 0});
    return bytes;
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
            if (stemOf(path) == lowerCase(task) ||
                stemOf(fs::path(path).parent_path().string()) == lowerCase(task))
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

bool isPictureName(const std::string& name) {
    static const std::set<std::string> kEndings{"png", "jpg", "jpeg", "webp", "bmp", "tga"};
    return kEndings.count(fileEnding(name)) != 0;
}

Subject subjectOf(std::shared_ptr<const scene::Assets> files, const std::string& where,
                  const std::string& task) {
    std::vector<std::string> scenes, pictures, archives;
    for (const std::string& name : files->list()) {
        const std::string kind = fileEnding(name);
        if (kind == "xml") scenes.push_back(name);
        if (isPictureName(name)) pictures.push_back(name);
        if (scene::isArchiveName(name)) archives.push_back(name);
    }
    Subject subject;
    const std::string scene = chooseOf(scenes, task);
    if (!scene.empty()) {
        subject.job.xml = contentOf(*files, scene, where);
        subject.job.name = fs::path(scene).filename().string();
        subject.job.path = scene;
        subject.job.assets = std::move(files);
        return subject;
    }
    if (scenes.empty() && archives.size() == 1) {
        subject.job.archive = contentOf(*files, archives.front(), where);
        subject.job.name = archives.front();
        subject.task = task;
        return subject;
    }
    if (scenes.empty()) {
        const std::string picture = chooseOf(pictures, task);
        if (!picture.empty()) {
            subject.job.name = picture;
            subject.picture = contentOf(*files, picture, where);
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
                             : "it holds nothing that is called " + shown(task),
                {where, 0, 0});
}

Subject opened(const Subject& subject) {
    if (subject.job.archive.empty()) return subject;
    Subject inside = subjectOf(std::make_shared<const scene::ArchiveAssets>(
                                   std::make_shared<std::string>(subject.job.archive)),
                               subject.job.name, subject.task);
    inside.job.options = subject.job.options;
    return inside;
}

}  // namespace farol::grade
