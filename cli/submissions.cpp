#include "cli/submissions.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <regex>
#include <set>

#include "cli/files.h"
#include "cli/messages.h"
#include "core/text.h"
#include "scene/files/archive.h"

namespace farol::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxBytes = std::size_t{64} << 20U;  // of one submission
constexpr std::size_t kMaxSubmissions = 100'000;

bool isPicture(const fs::path& path) { return grade::isPictureName(path.string()); }
bool isArchive(const fs::path& path) { return scene::isArchiveName(path.string()); }

bool isHidden(const fs::path& path) {
    const std::string name = path.filename().string();
    return name.empty() || name[0] == '.' || name == "__MACOSX" || name == "Thumbs.db";
}

std::string ending(const fs::path& path) { return fileEnding(path.string()); }

/// Entries of a folder that are not hidden, by name.
std::vector<fs::path> entriesOf(const fs::path& folder) {
    std::vector<fs::path> all;
    std::error_code failed;
    for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed))
        if (!isHidden(at->path())) all.push_back(at->path());
    if (failed)
        throw Error(message<"asset.unreadable/input">("reason"_arg = failed.message()),
                    {folder.string(), 0, 0});
    std::sort(all.begin(), all.end());
    return all;
}

/// The type of an entry itself, of a link too; `none` where it cannot be asked for.
fs::file_type typeOf(const fs::path& path) {
    std::error_code failed;
    return fs::symlink_status(path, failed).type();
}

bool isFolder(const fs::path& path) { return typeOf(path) == fs::file_type::directory; }

/// Whether a link leads to a folder.
bool leadsToFolder(const fs::path& path) {
    std::error_code failed;
    return fs::is_directory(path, failed);
}

/// Takes "Name_12345_assignsubmission_file_" apart.
void readMoodle(Submission& one) {
    static const std::regex kMoodle("^(.{1,200})_([0-9]{1,18})_assignsubmission_[a-z]+_.*$");
    std::smatch parts;
    if (one.id.size() > 255 || !std::regex_match(one.id, parts, kMoodle)) return;
    one.name = parts[1];
    one.number = parts[2];
}

/// The files below a folder that scenes need, by relative path, but for the folders `apart` and
/// what is hidden.
std::shared_ptr<const scene::Assets> collect(const fs::path& root,
                                             const std::vector<fs::path>& apart) {
    const scene::FolderAssets folder(root.string());
    std::vector<std::string> below;
    for (const fs::path& one : apart) {
        std::error_code failed;
        const std::string path =
            fs::canonical(one, failed).lexically_relative(folder.root()).generic_string();
        if (!failed && !path.empty() && !path.starts_with("..")) below.push_back(path + "/");
    }
    std::vector<std::string> paths = folder.list();
    std::erase_if(paths, [&](const std::string& path) {
        return path.starts_with(".") || path.find("/.") != std::string::npos ||
               std::any_of(below.begin(), below.end(),
                           [&](const std::string& one) { return path.starts_with(one); });
    });
    try {
        return std::make_shared<const scene::BundleAssets>(
            scene::readFiles(folder, scene::neededFiles(folder, paths, kMaxBytes), kMaxBytes));
    } catch (const Error& error) {
        Diagnostics all = error.diagnostics();
        for (Diagnostic& one : all)
            if (one.where.file.empty()) one.where.file = root.string();
        throw Error(std::move(all));
    }
}

std::shared_ptr<const scene::Assets> single(const std::string& name, std::string content) {
    return std::make_shared<const scene::BundleAssets>(
        scene::BundleAssets::Files{{name, std::move(content)}});
}

}  // namespace

std::vector<Submission> findSubmissions(const std::string& folder) {
    std::error_code failed;
    if (!fs::is_directory(folder, failed))
        throw Error(message<"asset.missing/submissions">(), {folder, 0, 0});
    std::vector<Submission> all;
    std::set<std::string> ids;
    for (const fs::path& path : entriesOf(folder)) {
        const bool isNamed = ending(path) == "xml" || isArchive(path) || isPicture(path);
        if (!isNamed && !isFolder(path) && !leadsToFolder(path)) continue;
        const std::string id = nameToUtf8(path.filename().string());
        Submission one{path.string(), id, "", ""};
        readMoodle(one);
        // Names that differ on the disk may read alike.
        for (int i = 2; !ids.insert(one.id).second; ++i)
            one.id = id + " (" + std::to_string(i) + ")";
        all.push_back(std::move(one));
        if (all.size() > kMaxSubmissions)
            throw Error(message<"limit.submissions">("max"_arg = kMaxSubmissions), {folder, 0, 0});
    }
    if (all.empty()) throw Error(message<"grade.no-submissions">(), {folder, 0, 0});
    return all;
}

std::vector<GradeTask> findTasks(const std::string& reference) {
    std::error_code failed;
    if (!fs::exists(reference, failed))
        throw Error(message<"asset.missing/reference">(), {reference, 0, 0});
    if (!fs::is_directory(reference, failed)) return {{"", reference}};
    std::vector<GradeTask> scenes, folders, pictures;
    for (const fs::path& path : entriesOf(reference)) {
        const GradeTask task{nameToUtf8(path.stem().string()), path.string()};
        if (isFolder(path)) {
            for (const fs::path& inside : entriesOf(path))
                if (ending(inside) == "xml") {
                    folders.push_back({nameToUtf8(path.filename().string()), path.string()});
                    break;
                }
        } else if (typeOf(path) != fs::file_type::regular) {
            continue;
        } else if (ending(path) == "xml" || isArchive(path)) {
            scenes.push_back(task);
        } else if (isPicture(path)) {
            pictures.push_back(task);
        }
    }
    std::vector<GradeTask> tasks = !scenes.empty() ? scenes : !folders.empty() ? folders : pictures;
    if (tasks.empty()) throw Error(message<"grade.no-scene/reference">(), {reference, 0, 0});
    if (tasks.size() == 1) tasks.front().name.clear();
    return tasks;
}

grade::Subject readSubject(const std::string& path, const std::string& task) {
    if (isFolder(path)) return grade::subjectOf(collect(path, {}), path, task);
    const std::string name = fs::path(path).filename().string();
    return grade::subjectOf(single(name, readRegularFile(path, kMaxBytes)), path,
                            isArchive(name) ? task : "");
}

grade::Subject readReference(const std::string& path, const std::vector<fs::path>& apart) {
    // Unlike a submission, it may be named by a link.
    std::error_code failed;
    const fs::path real = fs::canonical(path, failed);
    if (failed)
        throw Error(message<"asset.unreadable/input">("reason"_arg = failed.message()),
                    {path, 0, 0});
    if (isFolder(real)) return readSubject(real.string(), "");
    const std::string name = fs::path(path).filename().string();
    std::string content = readRegularFile(real.string(), kMaxBytes);
    if (ending(path) != "xml") return grade::subjectOf(single(name, std::move(content)), path, "");
    if (content.empty()) throw Error(message<"grade.empty-file/reference">(), {path, 0, 0});
    grade::Subject subject;
    subject.job.name = name;
    subject.job.xml = std::move(content);
    subject.job.assets = collect(folderOf(path), apart);
    return subject;
}

}  // namespace farol::cli
