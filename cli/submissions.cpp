#include "cli/submissions.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <regex>
#include <set>

#include "cli/files.h"
#include "scene/words.h"

namespace farol::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 256;                     // of one submission
constexpr std::size_t kMostBytes = std::size_t{64} << 20U;  // of one submission
constexpr std::size_t kMostSubmissions = 100'000;

const std::set<std::string> kArchives{"zip", "tar", "tgz", "gz"};
const std::set<std::string> kPictures{"png", "jpg", "jpeg", "webp", "bmp", "tga"};

bool isHidden(const fs::path& path) {
    const std::string name = path.filename().string();
    return name.empty() || name[0] == '.' || name == "__MACOSX" || name == "Thumbs.db";
}

std::string ending(const fs::path& path) { return endingOf(path.string()); }

/// Entries of a folder that are not hidden, by name; links are not followed.
std::vector<fs::path> entriesOf(const fs::path& folder) {
    std::vector<fs::path> all;
    std::error_code failed;
    for (fs::directory_iterator one(folder, failed), end; !failed && one != end;
         one.increment(failed))
        if (!isHidden(one->path()) && !one->is_symlink()) all.push_back(one->path());
    if (failed)
        throw Error("asset.unreadable", "cannot be read: " + failed.message(),
                    {folder.string(), 0, 0});
    std::sort(all.begin(), all.end());
    return all;
}

/// Takes "Name_12345_assignsubmission_file_" apart.
void readMoodle(Submission& one) {
    static const std::regex kMoodle("^(.{1,200})_([0-9]{1,18})_assignsubmission_[a-z]+_.*$");
    std::smatch parts;
    if (one.id.size() > 255 || !std::regex_match(one.id, parts, kMoodle)) return;
    one.name = parts[1];
    one.number = parts[2];
}

/// All files below a folder, by relative path.
void collect(const fs::path& root, const fs::path& folder, std::map<std::string, std::string>& out,
             std::size_t& bytes, int depth) {
    constexpr int kDeepest = 16;
    if (depth > kDeepest)
        throw Error("limit.bundle", "its folders are nested too deep", {root.string(), 0, 0});
    for (const fs::path& path : entriesOf(folder)) {
        if (fs::is_directory(path)) {
            collect(root, path, out, bytes, depth + 1);
            continue;
        }
        if (!fs::is_regular_file(path)) continue;
        std::error_code failed;
        const std::uintmax_t size = fs::file_size(path, failed);
        if (out.size() >= kMostFiles || failed || size > kMostBytes - bytes)
            throw Error("limit.bundle",
                        "a submission may hold " + std::to_string(kMostFiles) + " files of " +
                            std::to_string(kMostBytes >> 20U) + " MiB together",
                        {root.string(), 0, 0});
        bytes += size;
        out[path.lexically_relative(root).generic_string()] = readInput(path.string());
    }
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

grade::Subject subjectOf(std::map<std::string, std::string> files, const std::string& path,
                         const std::string& task) {
    std::vector<std::string> scenes, pictures, archives;
    for (const auto& [name, bytes] : files) {
        const std::string kind = endingOf(name);
        if (kind == "xml") scenes.push_back(name);
        if (kPictures.count(kind) != 0) pictures.push_back(name);
        if (kArchives.count(kind) != 0) archives.push_back(name);
    }
    grade::Subject subject;
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
                    {path, 0, 0});
    throw Error("grade.no-scene",
                task.empty() ? "it holds no .xml file, archive or picture"
                             : "it holds nothing that is called " + scene::shown(task),
                {path, 0, 0});
}

}  // namespace

std::vector<Submission> findSubmissions(const std::string& folder) {
    if (!fs::is_directory(folder))
        throw Error("asset.missing", "there is no such folder", {folder, 0, 0});
    std::vector<Submission> all;
    for (const fs::path& path : entriesOf(folder)) {
        const std::string kind = ending(path);
        if (!fs::is_directory(path) &&
            !(fs::is_regular_file(path) &&
              (kind == "xml" || kArchives.count(kind) != 0 || kPictures.count(kind) != 0)))
            continue;
        Submission one{path.string(), path.filename().string(), "", ""};
        readMoodle(one);
        all.push_back(std::move(one));
        if (all.size() > kMostSubmissions)
            throw Error("limit.submissions",
                        "more than " + std::to_string(kMostSubmissions) + " submissions",
                        {folder, 0, 0});
    }
    if (all.empty())
        throw Error("grade.no-submissions",
                    "holds no folder, .xml file, archive or picture to grade", {folder, 0, 0});
    return all;
}

std::vector<GradeTask> findTasks(const std::string& reference) {
    if (!fs::exists(reference))
        throw Error("asset.missing", "there is no such file or folder", {reference, 0, 0});
    if (!fs::is_directory(reference)) return {{"", reference}};
    std::vector<GradeTask> scenes, folders, pictures;
    for (const fs::path& path : entriesOf(reference)) {
        const GradeTask task{path.stem().string(), path.string()};
        if (fs::is_directory(path)) {
            for (const fs::path& inside : entriesOf(path))
                if (ending(inside) == "xml") {
                    folders.push_back({path.filename().string(), path.string()});
                    break;
                }
        } else if (ending(path) == "xml" || kArchives.count(ending(path)) != 0) {
            scenes.push_back(task);
        } else if (kPictures.count(ending(path)) != 0) {
            pictures.push_back(task);
        }
    }
    std::vector<GradeTask> tasks = !scenes.empty() ? scenes : !folders.empty() ? folders : pictures;
    if (tasks.empty())
        throw Error("grade.no-scene", "the reference holds no .xml file or picture",
                    {reference, 0, 0});
    if (tasks.size() == 1) tasks.front().name.clear();
    return tasks;
}

grade::Subject readSubject(const std::string& path, const std::string& task, bool beside) {
    std::map<std::string, std::string> files;
    std::size_t bytes = 0;
    if (fs::is_directory(path)) {
        collect(path, path, files, bytes, 0);
        return subjectOf(std::move(files), path, task);
    }
    const std::string name = fs::path(path).filename().string();
    if (beside && endingOf(name) == "xml") {
        collect(folderOf(path), folderOf(path), files, bytes, 0);
        grade::Subject subject;
        subject.job.name = name;
        subject.job.xml = readInput(path);
        subject.job.assets = std::make_shared<scene::BundleAssets>(std::move(files));
        return subject;
    }
    files[name] = readInput(path);
    return subjectOf(std::move(files), path, "");
}

}  // namespace farol::cli
