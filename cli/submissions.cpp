#include "cli/submissions.h"

#include <algorithm>
#include <filesystem>
#include <map>
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

/// Matches "Name_12345_assignsubmission_file_" and a rest: 1 prefix, 2 name, 3 number, 4 rest.
const std::regex& moodleName() {
    static const std::regex kMoodle(
        "^((.{1,200})_([0-9]{1,18})_assignsubmission_[a-z]+(?:_|$))(.*)$");
    return kMoodle;
}

void readMoodle(Submission& submission) {
    std::smatch parts;
    if (submission.id.size() > 255 || !std::regex_match(submission.id, parts, moodleName())) return;
    submission.name = parts[2];
    submission.number = parts[3];
}

/// Of a file that Moodle sends without a folder "Name_12345_assignsubmission_file_", else "".
std::string moodlePrefix(const std::string& name) {
    std::smatch parts;
    const bool isOf = name.size() <= 255 && std::regex_match(name, parts, moodleName());
    return isOf ? parts[1].str() : "";
}

/// Collects submissions, each with a unique id.
class Collector {
  public:
    explicit Collector(std::string folder) : folder_(std::move(folder)) {}

    /// Adds an entry called `name`, or finds the submission of the same path, or that a file of
    /// Moodle's belongs to.
    Submission& add(const std::string& path, const std::string& name, bool isFile) {
        const std::string prefix = isFile ? moodlePrefix(name) : "";
        const auto [known, isFresh] =
            known_.try_emplace(prefix.empty() ? path + "/" : prefix, all_.size());
        if (!isFresh) return all_[known->second];
        const std::string id = prefix.empty() ? name : prefix;
        all_.push_back({path, id, "", ""});
        Submission& added = all_.back();
        readMoodle(added);
        // Names that differ on the disk may read alike.
        for (int i = 2; !ids_.insert(added.id).second; ++i)
            added.id = id + " (" + std::to_string(i) + ")";
        if (all_.size() > kMaxSubmissions)
            throw Error(message<"limit.submissions">("max"_arg = kMaxSubmissions), {folder_, 0, 0});
        return added;
    }

    std::vector<Submission> take() {
        if (all_.empty()) throw Error(message<"grade.no-submissions">(), {folder_, 0, 0});
        return std::move(all_);
    }

  private:
    std::string folder_;
    std::vector<Submission> all_;
    std::set<std::string> ids_;
    std::map<std::string, std::size_t> known_;
};

/// Of a class in one .zip: an entry below the folder that holds all is a submission.
std::vector<Submission> submissionsOf(const std::string& path) {
    const auto archive = std::make_shared<const ClassArchive>(path);
    std::vector<std::size_t> files;
    for (std::size_t i = 0; i < archive->entries().size(); ++i) {
        const std::string& name = archive->entries()[i].path;
        if (!name.empty() && !scene::isClutter(name)) files.push_back(i);
    }
    std::sort(files.begin(), files.end(), [&](std::size_t a, std::size_t b) {
        return archive->entries()[a].path < archive->entries()[b].path;
    });
    // Moodle packs no folder around the class; systems that pack a folder do.
    std::string top;
    if (!files.empty()) {
        const std::string& first = archive->entries()[files.front()].path;
        const std::string folder = first.substr(0, first.find('/') + 1);
        const bool holdsAll = std::all_of(files.begin(), files.end(), [&](std::size_t i) {
            return archive->entries()[i].path.starts_with(folder);
        });
        if (holdsAll && moodlePrefix(folder).empty()) top = folder;
    }
    Collector collector(path);
    for (const std::size_t i : files) {
        const std::string below = archive->entries()[i].path.substr(top.size());
        if (below.empty()) continue;
        const std::size_t slash = below.find('/');
        const std::string name = below.substr(0, slash);
        if (isHidden(name)) continue;
        Submission& submission = collector.add(path + "/" + name, name, slash == std::string::npos);
        submission.archive = archive;
        if (!below.ends_with('/')) submission.entries.push_back(i);
    }
    return collector.take();
}

/// Collects the files below a folder that scenes need, by relative path, without the folders
/// `apart` and hidden files.
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
                           [&](const std::string& one) { return (path + "/").starts_with(one); });
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
    if (fs::is_regular_file(folder, failed)) return submissionsOf(folder);
    if (!fs::is_directory(folder, failed))
        throw Error(message<"asset.missing/submissions">(), {folder, 0, 0});
    Collector collector(folder);
    for (const fs::path& path : entriesOf(folder)) {
        const bool isFile = typeOf(path) == fs::file_type::regular;
        Submission& submission =
            collector.add(path.string(), nameToUtf8(path.filename().string()), isFile);
        if (isFile && submission.id.size() < path.filename().string().size() &&
            !moodlePrefix(submission.id).empty())
            submission.parts.push_back(path.string());
    }
    return collector.take();
}

Submission oneSubmission(const std::string& path) {
    std::error_code failed;
    const fs::path real = fs::canonical(path, failed);
    if (failed) throw Error(message<"asset.missing/submission">(), {path, 0, 0});
    return {path, nameToUtf8(real.filename().string()), "", ""};
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

grade::Subject readSubject(const std::string& path, const grade::Wanted& wanted) {
    if (isFolder(path)) return grade::subjectOf(collect(path, {}), path, wanted);
    const std::string name = fs::path(path).filename().string();
    // Files of other types are not read: grade::subjectOf() reports them by name.
    const bool isRead = !wanted.isScene || ending(path) == "xml" || isArchive(path) ||
                        isPicture(path) || typeOf(path) != fs::file_type::regular;
    return grade::subjectOf(single(name, isRead ? readRegularFile(path, kMaxBytes) : ""), path,
                            isArchive(name) ? wanted : grade::Wanted{"", {}, {}, wanted.isScene});
}

grade::Subject readSubmission(const Submission& submission, const grade::Wanted& wanted) {
    const std::string prefix = moodlePrefix(submission.id);
    if (submission.archive) {
        std::vector<std::string> names;
        for (const std::size_t i : submission.entries) {
            const std::string& path = submission.archive->entries()[i].path;
            const std::string name = path.substr(path.find(submission.id));
            const bool isFlat = !prefix.empty() && name.size() > prefix.size() &&
                                name[prefix.size()] != '/' && name.starts_with(prefix);
            names.push_back(isFlat ? name.substr(prefix.size()) : path);
        }
        if (names.empty()) return grade::subjectOf(single("", ""), submission.path, wanted);
        grade::Subject subject;
        subject.job.archive = submission.archive->packed(submission.entries, names, kMaxBytes);
        subject.job.name = submission.id + ".zip";
        subject.wanted = wanted;
        return subject;
    }
    if (submission.parts.empty()) return readSubject(submission.path, wanted);
    scene::BundleAssets::Files files;
    std::size_t left = kMaxBytes;
    for (const std::string& path : submission.parts) {
        const std::string name =
            nameToUtf8(fs::path(path).filename().string()).substr(prefix.size());
        std::string& content = files[name] = readRegularFile(path, left);
        left -= content.size();
    }
    return grade::subjectOf(std::make_shared<const scene::BundleAssets>(std::move(files)),
                            submission.path, wanted);
}

grade::Subject readReference(const std::string& path, const std::vector<fs::path>& apart) {
    // Unlike a submission, it may be named by a link.
    std::error_code failed;
    const fs::path real = fs::canonical(path, failed);
    if (failed)
        throw Error(message<"asset.unreadable/input">("reason"_arg = failed.message()),
                    {path, 0, 0});
    if (isFolder(real)) return readSubject(real.string(), {});
    const std::string name = fs::path(path).filename().string();
    std::string content = readRegularFile(real.string(), kMaxBytes);
    if (ending(path) != "xml") return grade::subjectOf(single(name, std::move(content)), path, {});
    if (content.empty()) throw Error(message<"grade.empty-file/reference">(), {path, 0, 0});
    grade::Subject subject;
    subject.job.name = name;
    subject.job.xml = std::move(content);
    subject.job.assets = collect(folderOf(path), apart);
    return subject;
}

}  // namespace farol::cli
