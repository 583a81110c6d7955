#include "grade/rubric/subject.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <vector>

#include "core/text.h"
#include "grade/messages.h"
#include "scene/files/archive.h"

namespace farol::grade {
namespace {

namespace fs = std::filesystem;

/// Throws Error grade.empty-file.
std::string contentOf(const scene::Assets& files, const std::string& name,
                      const std::string& where) {
    std::string bytes = files.read(name).value_or("");
    if (bytes.empty()) throw Error(message<"grade.empty-file">("name"_arg = name), {where, 0, 0});
    return bytes;
}

long depthOf(const std::string& path) { return std::count(path.begin(), path.end(), '/'); }

/// The image of the task's name; without a task the only one, or the only one that is highest.
std::string chooseImage(const std::vector<std::string>& paths, const std::string& task) {
    std::vector<std::string> left;
    long least = 1'000'000;
    for (const std::string& path : paths) {
        if (!task.empty() && !isNamedLike(fs::path(path).stem().string(), task) &&
            !isNamedLike(fs::path(path).parent_path().filename().string(), task))
            continue;
        least = std::min(least, depthOf(path));
        left.push_back(path);
    }
    std::erase_if(left, [&](const std::string& path) { return depthOf(path) > least; });
    return left.size() == 1 ? left.front() : "";
}

/// Throws Error grade.no-scene; names the type of the files if all have the same.
[[noreturn]] void throwNoScene(const scene::Assets& files, const std::string& where,
                               const Wanted& wanted, bool hasScenes) {
    const Location place{where, 0, 0};
    if (hasScenes || !wanted.task.empty())
        throw Error(message<"grade.no-scene/task">("task"_arg = wanted.task), place);
    std::set<std::string> endings;
    for (const std::string& name : files.list()) endings.insert(fileEnding(name));
    if (endings.size() == 1 && !endings.begin()->empty())
        throw Error(message<"grade.no-scene/kind">("ending"_arg = nameToUtf8(*endings.begin())),
                    place);
    throw Error(message<"grade.no-scene/files">(), place);
}

}  // namespace

bool isPictureName(const std::string& name) {
    static const std::set<std::string> kEndings{"png", "jpg", "jpeg", "webp", "bmp", "tga"};
    return kEndings.count(fileEnding(name)) != 0;
}

Subject subjectOf(std::shared_ptr<const scene::Assets> files, const std::string& where,
                  const Wanted& wanted) {
    std::vector<std::string> scenes, images, archives;
    for (const std::string& name : files->list()) {
        if (fileEnding(name) == "xml") scenes.push_back(name);
        if (isPictureName(name)) images.push_back(name);
        if (scene::isArchiveName(name)) archives.push_back(name);
    }
    Subject subject;
    const Choice choice = chooseDocument(*files, scenes, wanted, where);
    if (!choice.path.empty()) {
        subject.job.xml = contentOf(*files, choice.path, where);
        subject.job.name = fs::path(choice.path).filename().string();
        subject.job.path = choice.path;
        subject.job.assets = std::move(files);
        if (!choice.reason.empty())
            subject.notes.push_back(diagnosticOf(
                Severity::info,
                message<"grade.chosen">("path"_arg = nameToUtf8(choice.path),
                                        "count"_arg = scenes.size(), "reason"_arg = choice.reason),
                {subject.job.name, 0, 0}));
        return subject;
    }
    if (scenes.empty() && archives.size() == 1) {
        subject.job.archive = contentOf(*files, archives.front(), where);
        subject.job.name = archives.front();
        subject.wanted = wanted;
        return subject;
    }
    if (scenes.empty()) {
        const std::string image = chooseImage(images, wanted.task);
        if (!image.empty()) {
            subject.job.name = image;
            subject.picture = contentOf(*files, image, where);
            return subject;
        }
    }
    if (!wanted.isScene && scenes.empty()) {
        subject.job.name = where;
        subject.job.assets = std::move(files);
        return subject;
    }
    throwNoScene(*files, where, wanted, !scenes.empty());
}

Subject opened(const Subject& subject, const std::vector<std::string>& files) {
    Subject inside = subject;
    constexpr int kMaxDepth = 4;  // archives in archives
    for (int depth = 0; !inside.job.archive.empty() && depth < kMaxDepth; ++depth) {
        Wanted wanted = inside.wanted;
        if (wanted.files.empty()) wanted.files = files;
        inside = subjectOf(std::make_shared<const scene::ArchiveAssets>(
                               std::make_shared<std::string>(std::move(inside.job.archive))),
                           subject.job.name, wanted);
    }
    if (!inside.job.archive.empty())
        throw Error(message<"grade.no-scene/deep">("max"_arg = kMaxDepth),
                    {subject.job.name, 0, 0});
    inside.job.options = subject.job.options;
    return inside;
}

}  // namespace farol::grade
