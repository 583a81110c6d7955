#include "scene/files/archive.h"

#include <algorithm>
#include <iterator>

#include "core/digest.h"
#include "core/text.h"
#include "scene/messages.h"

namespace farol::scene {
namespace {

constexpr std::size_t kMaxNested = std::size_t{64} << 20U;  // of archives in the archive, together
constexpr int kMaxDepth = 2;                                // archives in archives

[[noreturn]] void differsFrom(const std::string& path) {
    throw Error(message<"bundle.path/twice">("path"_arg = path));
}

}  // namespace

bool isArchiveName(std::string_view path) {
    static constexpr std::string_view kEndings[] = {"zip", "tar", "gz", "tgz", "7z", "rar"};
    return std::find(std::begin(kEndings), std::end(kEndings), fileEnding(path)) !=
           std::end(kEndings);
}

ArchiveAssets::ArchiveAssets(std::shared_ptr<const std::string> bytes)
    : digest_(contentDigest(*bytes)),
      packed_(bytes->size()),
      allowed_(maxUnpackedBytes(bytes->size())),
      entriesLeft_(kMaxListed),
      nestedLeft_(kMaxNested) {
    open(std::move(bytes), "", 0);
    stripTop();
}

/// Lists an archive, then the archives in it. Throws where the archive itself is at fault.
void ArchiveAssets::open(std::shared_ptr<const std::string> bytes, const std::string& prefix,
                         int depth) {
    std::map<std::string, File> found;
    std::map<std::string, std::string> links;
    std::map<std::string, std::shared_ptr<std::string>> inner;
    std::size_t innerBytes = 0;
    for (EntryReader reader(*bytes); reader.next();) {
        if (entriesLeft_ == 0) tooManyEntries();
        --entriesLeft_;
        const std::string& path = reader.path();
        if (reader.link()) {
            links.try_emplace(path, *reader.link());
            continue;
        }
        const auto [known, fresh] = found.try_emplace(path, File{bytes, path, reader.size()});
        if (!fresh && known->second.size != reader.size()) differsFrom(path);
        if (!fresh || !isArchiveName(path)) continue;
        if (depth < kMaxDepth && reader.size() <= nestedLeft_) {
            nestedLeft_ -= reader.size();
            innerBytes += reader.size();
            inner.try_emplace(path);
        } else {
            note(message<"bundle.closed/limit">("path"_arg = uncut(prefix + path)));
        }
    }
    follow(links, found, prefix);
    for (auto& [path, file] : found) files_.emplace(prefix + path, std::move(file));
    if (inner.empty()) return;
    for (EntryReader reader(*bytes); reader.next();) {
        const auto wanted = inner.find(reader.path());
        if (wanted == inner.end() || wanted->second) continue;
        try {
            wanted->second = std::make_shared<std::string>(reader.content(innerBytes));
            innerBytes -= wanted->second->size();
        } catch (const Error& error) {
            note(message<"bundle.closed">("path"_arg = uncut(prefix + wanted->first),
                                          "why"_arg = error.primary()));
        }
    }
    for (auto& [path, content] : inner) {
        if (!content || !isArchive(*content)) continue;
        try {
            open(std::move(content), prefix + path + "/", depth + 1);
        } catch (const Error& error) {
            if (error.code() == "limit.bundle" && entriesLeft_ == 0) throw;
            note(message<"bundle.closed">("path"_arg = uncut(prefix + path),
                                          "why"_arg = error.primary()));
        }
    }
}

/// Adds the links whose ends are files of the archive to them, under the link's path.
void ArchiveAssets::follow(const std::map<std::string, std::string>& links,
                           std::map<std::string, File>& files, const std::string& prefix) {
    constexpr int kMaxLinks = 8;  // one after the other
    std::map<std::string, File> followed;
    for (const auto& [path, first] : links) {
        if (files.count(path) != 0) continue;
        std::string target = first;
        for (int i = 1; i < kMaxLinks && links.count(target) != 0; ++i) target = links.at(target);
        const auto file = files.find(target);
        if (file == files.end()) {
            note(message<"bundle.link/outside">("path"_arg = uncut(prefix + path)));
            continue;
        }
        followed.emplace(path, file->second);
        note(message<"bundle.link">("path"_arg = uncut(prefix + path),
                                    "target"_arg = uncut(prefix + target)));
    }
    files.merge(followed);
}

void ArchiveAssets::note(Message text) {
    constexpr std::size_t kMaxFindings = 20;
    if (findings_.size() < kMaxFindings)
        findings_.push_back(diagnosticOf(Severity::info, std::move(text)));
}

/// Takes off the folders that hold everything.
void ArchiveAssets::stripTop() {
    if (files_.empty()) return;
    const std::string first = files_.begin()->first;
    std::size_t shared = first.rfind('/') + 1;  // npos + 1 is 0
    for (const auto& [path, file] : files_) {
        const auto differs = std::mismatch(first.begin(), first.begin() + std::ptrdiff_t(shared),
                                           path.begin(), path.end());
        shared = static_cast<std::size_t>(differs.first - first.begin());
        if (shared > 0) shared = first.rfind('/', shared - 1) + 1;
    }
    if (shared == 0) return;
    std::map<std::string, File> stripped;
    for (auto& [path, file] : files_) stripped.emplace(path.substr(shared), std::move(file));
    files_ = std::move(stripped);
}

std::vector<std::string> ArchiveAssets::list() const {
    std::vector<std::string> paths;
    for (const auto& [path, file] : files_) paths.push_back(path);
    return paths;
}

bool ArchiveAssets::has(const std::string& path) const { return files_.count(path) != 0; }

std::optional<std::uint64_t> ArchiveAssets::size(const std::string& path) const {
    const auto file = files_.find(path);
    if (file == files_.end()) return std::nullopt;
    return file->second.size;
}

std::string ArchiveAssets::version(const std::string& path) const {
    return has(path) ? digest_ + ":" + path : "";
}

std::optional<std::string> ArchiveAssets::read(const std::string& path) const {
    if (!has(path)) return std::nullopt;
    const std::lock_guard lock(mutex_);
    if (loaded_.count(path) == 0) load({path});
    return loaded_.at(path);
}

void ArchiveAssets::prefetch(const std::vector<std::string>& paths) const {
    const std::lock_guard lock(mutex_);
    std::vector<std::string> wanted;
    std::uint64_t sum = 0;
    for (const std::string& path : paths) {
        const auto file = files_.find(path);
        if (file == files_.end() || loaded_.count(path) != 0) continue;
        // Files over the limit are left out: reading one of them is the error.
        if (file->second.size > allowed_ - used_ - sum) continue;
        sum += file->second.size;
        wanted.push_back(path);
    }
    try {
        if (!wanted.empty()) load(wanted);
    } catch (const Error&) {
        // It is thrown again where the file at fault is read, and is none of the others'.
    }
}

/// Reads files in one pass of each archive that holds some of them.
void ArchiveAssets::load(const std::vector<std::string>& paths) const {
    // Entries by the archive that holds them; with links, several paths have one entry.
    std::map<std::shared_ptr<const std::string>, std::map<std::string, std::vector<std::string>>>
        wanted;
    for (const std::string& path : paths) {
        const File& file = files_.at(path);
        wanted[file.archive][file.name].push_back(path);
    }
    for (const auto& [archive, entries] : wanted)
        for (EntryReader reader(*archive); reader.next();) {
            const auto entry = entries.find(reader.path());
            if (entry == entries.end() || reader.link()) continue;
            const std::string content = reader.content(allowed_ - used_);
            for (const std::string& path : entry->second) keep(path, content);
        }
    for (const std::string& path : paths)
        if (loaded_.count(path) == 0)
            throw Error(message<"bundle.damaged/lost">("path"_arg = path));
}

/// Adds a file's bytes to loaded_. Throws as `load`.
void ArchiveAssets::keep(const std::string& path, const std::string& content) const {
    const auto [known, isNew] = loaded_.try_emplace(path);
    if (!isNew && known->second != content) {
        used_ -= known->second.size();
        loaded_.erase(known);
        differsFrom(path);
    }
    if (!isNew) return;
    if (content.size() > allowed_ - used_) {
        loaded_.erase(known);
        throw Error(message<"limit.bundle/bytes">("max"_arg = allowed_ >> 20U));
    }
    used_ += content.size();
    known->second = content;
}

Bundle readArchive(std::string_view bytes) {
    const ArchiveAssets archive(std::make_shared<const std::string>(bytes));
    const std::size_t most = maxUnpackedBytes(bytes.size());
    Bundle bundle;
    bundle.main = mainOf(archive);
    bundle.files = readFiles(archive, neededFiles(archive, archive.list(), most), most);
    if (bundle.files.count(bundle.main) == 0)  // listed, and damaged where its bytes should be
        throw Error(message<"bundle.damaged/lost">("path"_arg = bundle.main));
    return bundle;
}

}  // namespace farol::scene
