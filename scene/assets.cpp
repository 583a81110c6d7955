#include "scene/assets.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <utility>

#include "scene/digest.h"

namespace farol::scene {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMaxPath = 1024;
/// Entries looked at when a folder is listed, so that a huge tree costs bounded time.
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

bool isInside(const fs::path& path, const fs::path& root) {
    const auto [rootEnd, pathAt] =
        std::mismatch(root.begin(), root.end(), path.begin(), path.end());
    return rootEnd == root.end() && pathAt != path.end();
}

std::string beneath(const std::string& root) { return root == "/" ? root : root + "/"; }

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

std::string lowered(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), lower);
    return text;
}

std::string baseName(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    return slash == std::string::npos ? path : path.substr(slash + 1);
}

/// Backslashes become slashes, "." parts go: what a scene written on another system means.
std::string portable(std::string path) {
    std::replace(path.begin(), path.end(), '\\', '/');
    while (path.rfind("./", 0) == 0) path.erase(0, 2);
    for (std::size_t at; (at = path.find("/./")) != std::string::npos;) path.erase(at, 2);
    return path;
}

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
        paths.push_back(path);
    }
    return paths;
}

bool BundleAssets::has(const std::string& path) const { return files_->count(path) != 0; }

std::optional<std::string> BundleAssets::read(const std::string& path) const {
    const auto found = files_->find(path);
    if (found == files_->end()) return std::nullopt;
    return found->second;
}

std::string BundleAssets::version(const std::string& path) const {
    const auto found = files_->find(path);
    if (found == files_->end()) return "";
    const std::lock_guard lock(digests_->mutex);
    std::string& digest = digests_->made[path];
    if (digest.empty()) digest = contentDigest(found->second);
    return digest;
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

std::vector<std::string> FolderAssets::list() const {
    std::vector<std::string> paths;
    if (root_.empty()) return paths;
    std::error_code failed;
    fs::recursive_directory_iterator at(root_, fs::directory_options::skip_permission_denied,
                                        failed);
    const fs::recursive_directory_iterator end;
    for (int visited = 0; !failed && at != end && visited < kMaxVisited; ++visited) {
        // The folders on the way are no links: those are not followed.
        const fs::file_type type = at->symlink_status(failed).type();
        const std::string path = at->path().native().substr(beneath(root_).size());
        const bool isFile = type == fs::file_type::regular && isSafePath(path);
        if (isFile || (type == fs::file_type::symlink && resolve(path))) paths.push_back(path);
        if (paths.size() == kMaxListed) break;
        at.increment(failed);
    }
    std::sort(paths.begin(), paths.end());
    return paths;
}

bool FolderAssets::has(const std::string& path) const { return resolve(path).has_value(); }

std::optional<std::string> FolderAssets::read(const std::string& path) const {
    const auto real = resolve(path);
    if (!real) return std::nullopt;
    const Descriptor file(open(real->c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
    struct stat facts {};
    if (file.fd < 0 || fstat(file.fd, &facts) != 0 || !S_ISREG(facts.st_mode)) return std::nullopt;
    if (facts.st_size > static_cast<off_t>(kMaxFileBytes))
        throw Error("limit.file-bytes", "the file \"" + path + "\" is larger than " +
                                            std::to_string(kMaxFileBytes >> 20U) + " MiB");
    std::string bytes(static_cast<std::size_t>(facts.st_size), '\0');
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t got = ::read(file.fd, bytes.data() + done, bytes.size() - done);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return std::nullopt;
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

std::optional<std::string> locate(const Assets& assets, const std::string& path,
                                  const Location& where, Diagnostics& diagnostics) {
    const std::string wanted = portable(path);
    if (isSafePath(wanted) && assets.has(wanted)) return wanted;
    const std::string base = baseName(wanted);
    if (!isSafePath(base)) return std::nullopt;
    std::vector<std::string> same, alike;
    for (const std::string& one : assets.list()) {
        const std::string name = baseName(one);
        if (name == base)
            same.push_back(one);
        else if (lowered(name) == lowered(base))
            alike.push_back(one);
    }
    const std::vector<std::string>& found = same.empty() ? alike : same;
    if (found.size() > 1)
        diagnostics.push_back({Severity::warning, "asset.ambiguous", where,
                               "\"" + path +
                                   "\" is not there, and several files have its name (\"" +
                                   found[0] + "\", \"" + found[1] + "\"): say which is meant",
                               ""});
    if (found.size() != 1) return std::nullopt;
    diagnostics.push_back({Severity::warning, "asset.found-elsewhere", where,
                           "\"" + path + "\" is not there; \"" + found[0] + "\" is taken instead",
                           ""});
    return found[0];
}

}  // namespace farol::scene
