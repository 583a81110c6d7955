#include "cli/submissions.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <regex>

#include "cli/files.h"
#include "scene/words.h"

namespace farol::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 256;                     // of one submission
constexpr std::size_t kMostBytes = std::size_t{64} << 20U;  // of one submission
constexpr std::size_t kMostSubmissions = 100'000;

bool isPicture(const fs::path& path) { return grade::isPictureName(path.string()); }
bool isArchive(const fs::path& path) { return grade::isArchiveName(path.string()); }

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

/// All files below a folder, by relative path, but for the folders `apart`.
void collect(const fs::path& root, const fs::path& folder, const std::vector<fs::path>& apart,
             std::map<std::string, std::string>& out, std::size_t& bytes, int depth) {
    constexpr int kDeepest = 16;
    if (depth > kDeepest)
        throw Error("limit.bundle", "its folders are nested too deep", {root.string(), 0, 0});
    for (const fs::path& path : entriesOf(folder)) {
        if (fs::is_directory(path)) {
            std::error_code failed;
            const bool leftOut = std::any_of(apart.begin(), apart.end(), [&](const fs::path& one) {
                return fs::equivalent(one, path, failed);
            });
            if (!leftOut) collect(root, path, apart, out, bytes, depth + 1);
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

}  // namespace

std::vector<Submission> findSubmissions(const std::string& folder) {
    if (!fs::is_directory(folder))
        throw Error("asset.missing", "there is no such folder", {folder, 0, 0});
    std::vector<Submission> all;
    for (const fs::path& path : entriesOf(folder)) {
        const std::string kind = ending(path);
        if (!fs::is_directory(path) &&
            !(fs::is_regular_file(path) && (kind == "xml" || isArchive(path) || isPicture(path))))
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
        } else if (ending(path) == "xml" || isArchive(path)) {
            scenes.push_back(task);
        } else if (isPicture(path)) {
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

grade::Subject readSubject(const std::string& path, const std::string& task) {
    std::map<std::string, std::string> files;
    std::size_t bytes = 0;
    if (fs::is_directory(path)) {
        collect(path, path, {}, files, bytes, 0);
        return grade::subjectOf(std::move(files), path, task);
    }
    const std::string name = fs::path(path).filename().string();
    files[name] = readInput(path);
    return grade::subjectOf(std::move(files), path, isArchive(name) ? task : "");
}

grade::Subject readReference(const std::string& path, const std::vector<fs::path>& apart) {
    if (fs::is_directory(path) || endingOf(path) != "xml") return readSubject(path, "");
    std::map<std::string, std::string> files;
    std::size_t bytes = 0;
    collect(folderOf(path), folderOf(path), apart, files, bytes, 0);
    grade::Subject subject;
    subject.job.name = fs::path(path).filename().string();
    subject.job.xml = readInput(path);
    subject.job.assets = std::make_shared<scene::BundleAssets>(std::move(files));
    return subject;
}

}  // namespace farol::cli
