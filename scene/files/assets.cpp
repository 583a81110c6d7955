#include "scene/files/assets.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <iterator>
#include <memory>
#include <mutex>
#include <system_error>
#include <utility>

#include "core/digest.h"
#include "core/text.h"
#include "scene/messages.h"

namespace farol::scene {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMaxPath = 1024;
/// Most entries visited when a folder is listed: bounds the time of a huge tree.
constexpr int kMaxVisited = 100'000;

struct Descriptor {
    explicit Descriptor(int value) : fd(value) {}
    ~Descriptor() {
        if (fd >= 0) close(fd);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int fd;
};

/// True for an errno that is no fault of the file: the process or the machine lacks resources.
bool isPassing(int error) {
    return error == EMFILE || error == ENFILE || error == ENOMEM || error == EIO;
}

[[noreturn]] void fail(const std::string& path) {
    const int error = errno;
    throw std::system_error(error, std::generic_category(), "cannot read " + path);
}

bool isInside(const fs::path& path, const fs::path& root) {
    const auto [rootEnd, pathAt] =
        std::mismatch(root.begin(), root.end(), path.begin(), path.end());
    return rootEnd == root.end() && pathAt != path.end();
}

std::string beneath(const std::string& root) { return root == "/" ? root : root + "/"; }

}  // namespace

bool isSafePath(const std::string& path) {
    if (path.empty() || path.size() > kMaxPath) return false;
    if (path.find_first_of(std::string_view("\\\0", 2)) != std::string::npos) return false;
    if (path.size() > 1 && path[1] == ':') return false;
    for (std::size_t begin = 0; begin <= path.size();) {
        const std::size_t end = std::min(path.find('/', begin), path.size());
        const std::string_view part = std::string_view(path).substr(begin, end - begin);
        if (part.empty() || part == "." || part == "..") return false;
        begin = end + 1;
    }
    return true;
}

bool isClutter(std::string_view path) {
    static constexpr std::string_view kFolders[] = {"__MACOSX", ".git", ".svn", ".hg"};
    static constexpr std::string_view kFiles[] = {".DS_Store", "Thumbs.db", "desktop.ini"};
    const auto isOneOf = [](std::string_view name, const auto& names) {
        return std::find(std::begin(names), std::end(names), name) != std::end(names);
    };
    const std::string_view base = baseName(path);
    if (base.starts_with("._") || isOneOf(base, kFiles)) return true;
    const auto parts = split(path, "/");
    return std::any_of(parts.begin(), parts.end(),
                       [&](std::string_view part) { return isOneOf(part, kFolders); });
}

struct BundleAssets::Digests {
    std::mutex mutex;
    std::map<std::string, std::string> made;
};

BundleAssets::BundleAssets(Files files) : digests_(std::make_shared<Digests>()) {
    std::erase_if(files, [](const auto& entry) { return !isSafePath(entry.first); });
    files_ = std::make_shared<const Files>(std::move(files));
}

BundleAssets::BundleAssets(std::shared_ptr<const Files> files)
    : files_(std::move(files)), digests_(std::make_shared<Digests>()) {}

std::size_t BundleAssets::bytes() const {
    std::size_t sum = 0;
    for (const auto& [path, content] : *files_) sum += content.size();
    return sum;
}

std::vector<std::string> BundleAssets::list() const {
    std::vector<std::string> paths;
    for (const auto& [path, bytes] : *files_) {
        if (paths.size() == kMaxListed) break;
        if (!isClutter(path)) paths.push_back(path);
    }
    return paths;
}

bool BundleAssets::has(const std::string& path) const { return files_->count(path) != 0; }

std::optional<std::string> BundleAssets::read(const std::string& path) const {
    const auto found = files_->find(path);
    if (found == files_->end()) return std::nullopt;
    return found->second;
}

std::optional<std::uint64_t> BundleAssets::size(const std::string& path) const {
    const auto found = files_->find(path);
    if (found == files_->end()) return std::nullopt;
    return found->second.size();
}

std::string BundleAssets::version(const std::string& path) const {
    const auto found = files_->find(path);
    if (found == files_->end()) return "";
    const std::lock_guard lock(digests_->mutex);
    std::string& digest = digests_->made[path];
    if (digest.empty()) digest = contentDigest(found->second);
    return digest;
}

std::optional<FolderIdentity> folderIdentity(const std::string& path) {
    struct statx facts {};
    if (statx(AT_FDCWD, path.c_str(), AT_STATX_SYNC_AS_STAT, STATX_TYPE | STATX_INO | STATX_BTIME,
              &facts) != 0 ||
        !S_ISDIR(facts.stx_mode))
        return std::nullopt;
    FolderIdentity identity;
    identity.device = std::uint64_t{facts.stx_dev_major} << 32U | facts.stx_dev_minor;
    identity.inode = facts.stx_ino;
    if ((facts.stx_mask & STATX_BTIME) != 0) {
        identity.bornS = facts.stx_btime.tv_sec;
        identity.bornNs = facts.stx_btime.tv_nsec;
    }
    return identity;
}

FolderAssets::FolderAssets(std::string root) {
    std::error_code ignored;
    const fs::path real = fs::canonical(root.empty() ? "." : root, ignored);
    root_ = real.string();  // empty where there is no such folder: nothing is found then
}

std::optional<std::string> FolderAssets::resolve(const std::string& path) const {
    if (root_.empty() || !isSafePath(path)) return std::nullopt;
    // A path without links is its own real path: one look a part, where canonical() takes one for
    // each part of the root too.
    const std::string plain = beneath(root_) + path;
    for (std::size_t end = root_.size();;) {
        end = std::min(plain.find('/', end + 1), plain.size());
        struct stat facts {};
        if (lstat(plain.substr(0, end).c_str(), &facts) != 0) return std::nullopt;
        if (S_ISLNK(facts.st_mode)) break;
        if (end < plain.size()) continue;
        if (!S_ISREG(facts.st_mode)) return std::nullopt;
        return plain;
    }
    std::error_code failed;
    const fs::path real = fs::canonical(fs::path(root_) / path, failed);
    if (failed || !isInside(real, root_)) return std::nullopt;
    if (!fs::is_regular_file(real, failed)) return std::nullopt;
    return real.string();
}

// Visits each entry once, folders before their content. `visit` gets its path and its type
// (DT_*), and ends the walk by returning false. Skips folders that vanish meanwhile or may not be
// read.
void FolderAssets::walk(const std::function<bool(const std::string&, int)>& visit) const {
    std::vector<std::string> folders;
    if (!root_.empty()) folders.push_back(root_);
    int visited = 0;
    while (!folders.empty()) {
        const std::string folder = std::move(folders.back());
        folders.pop_back();
        const std::unique_ptr<DIR, int (*)(DIR*)> handle(opendir(folder.c_str()), closedir);
        if (!handle && isPassing(errno)) fail(folder);
        while (handle) {
            errno = 0;
            const dirent* entry = readdir(handle.get());
            if (entry == nullptr && isPassing(errno)) fail(folder);
            if (entry == nullptr) break;
            const std::string_view name = entry->d_name;
            if (name == "." || name == ".." || isClutter(name)) continue;
            if (++visited > kMaxVisited) return;
            const std::string full = beneath(folder).append(name);
            int type = entry->d_type;
            struct stat facts {};
            if (type == DT_UNKNOWN && lstat(full.c_str(), &facts) == 0)
                type = IFTODT(facts.st_mode);
            if (!visit(full.substr(beneath(root_).size()), type)) return;
            if (type == DT_DIR) folders.push_back(full);
        }
    }
}

std::vector<std::string> FolderAssets::list() const {
    std::vector<std::string> paths;
    walk([&](const std::string& path, int type) {
        const bool isFile = type == DT_REG && isSafePath(path);
        if (isFile || (type == DT_LNK && resolve(path))) paths.push_back(path);
        return paths.size() < kMaxListed;
    });
    std::sort(paths.begin(), paths.end());
    return paths;
}

std::vector<FolderAssets::Oddity> FolderAssets::oddities(std::string_view suffix) const {
    std::vector<Oddity> found;
    walk([&](const std::string& path, int type) {
        if (type == DT_REG || !path.ends_with(suffix)) return true;
        std::string what = oddityOf(path);
        if (!what.empty()) found.push_back({path, std::move(what)});
        return found.size() < kMaxListed;
    });
    std::sort(found.begin(), found.end(),
              [](const Oddity& a, const Oddity& b) { return a.path < b.path; });
    return found;
}

std::string FolderAssets::oddityOf(const std::string& path) const {
    struct stat facts {};
    if (root_.empty() || !isSafePath(path)) return "";
    const std::string plain = beneath(root_) + path;
    // The parent folder must be below the root, too.
    std::error_code failed;
    const fs::path parent = fs::canonical(fs::path(plain).parent_path(), failed);
    if (failed || (parent != root_ && !isInside(parent, root_))) return "";
    if (lstat(plain.c_str(), &facts) != 0) return "";
    if (S_ISLNK(facts.st_mode)) {
        const fs::path target = fs::canonical(plain, failed);
        if (failed) return "is a link that leads nowhere";
        if (!isInside(target, root_) || stat(target.c_str(), &facts) != 0) return "";
    }
    if (S_ISREG(facts.st_mode)) return "";
    if (S_ISDIR(facts.st_mode)) return "is a folder";
    if (S_ISFIFO(facts.st_mode)) return "is a pipe";
    if (S_ISSOCK(facts.st_mode)) return "is a socket";
    return "is a device";
}

void FolderAssets::checkReadable() const {
    const Descriptor folder(open(root_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (folder.fd < 0) fail(root_);
}

std::optional<std::uint64_t> FolderAssets::size(const std::string& path) const {
    const auto real = resolve(path);
    struct stat facts {};
    if (!real || stat(real->c_str(), &facts) != 0) return std::nullopt;
    return static_cast<std::uint64_t>(facts.st_size);
}

bool FolderAssets::has(const std::string& path) const { return resolve(path).has_value(); }

std::optional<std::string> FolderAssets::read(const std::string& path) const {
    const auto real = resolve(path);
    if (!real) return std::nullopt;
    const Descriptor file(open(real->c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
    struct stat facts {};
    if (file.fd < 0 && isPassing(errno)) fail(path);
    if (file.fd < 0 || fstat(file.fd, &facts) != 0 || !S_ISREG(facts.st_mode)) return std::nullopt;
    if (facts.st_size > static_cast<off_t>(kMaxFileBytes))
        throw Error(message<"limit.file-bytes/asset">("path"_arg = uncut(path),
                                                      "max"_arg = kMaxFileBytes >> 20U));
    std::string bytes(static_cast<std::size_t>(facts.st_size), '\0');
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t got = ::read(file.fd, bytes.data() + done, bytes.size() - done);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) fail(path);
        if (got == 0) break;  // it shrank meanwhile
        done += static_cast<std::size_t>(got);
    }
    bytes.resize(done);
    return bytes;
}

std::string FolderAssets::version(const std::string& path) const {
    const auto real = resolve(path);
    struct stat facts {};
    if (!real || stat(real->c_str(), &facts) != 0) return "";
    const auto stamp = [](const timespec& time) {
        return std::to_string(time.tv_sec) + "." + std::to_string(time.tv_nsec);
    };
    return std::to_string(facts.st_dev) + "-" + std::to_string(facts.st_ino) + "-" +
           std::to_string(facts.st_size) + "-" + stamp(facts.st_mtim) + "-" + stamp(facts.st_ctim);
}

}  // namespace farol::scene
