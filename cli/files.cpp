#include "cli/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "scene/error.h"

namespace farol::cli {
namespace {

class File {
  public:
    explicit File(int descriptor, bool owned = true) : descriptor_(descriptor), owned_(owned) {}
    ~File() {
        if (owned_ && descriptor_ >= 0) ::close(descriptor_);
    }
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    int get() const { return descriptor_; }
    /// Says whether all that was written has reached the system.
    bool close() {
        const int result = ::close(descriptor_);
        descriptor_ = -1;
        return result == 0;
    }

  private:
    int descriptor_;
    bool owned_;
};

std::string reason(int error) { return std::generic_category().message(error); }

[[noreturn]] void cannotWrite(const std::string& path, int error) {
    throw OutputError("cannot write " + path + ": " + reason(error));
}

void writeAll(int descriptor, std::string_view bytes, const std::string& path) {
    while (!bytes.empty()) {
        const ssize_t done = ::write(descriptor, bytes.data(), bytes.size());
        if (done < 0 && errno == EINTR) continue;
        if (done < 0) cannotWrite(path, errno);
        bytes.remove_prefix(static_cast<std::size_t>(done));
    }
}

/// A temporary file beside its target, removed unless it was renamed to it.
class Draft {
  public:
    explicit Draft(const std::string& target)
        : target_(target), name_(target + ".XXXXXX"), file_(::mkstemp(name_.data())) {
        if (file_.get() < 0) cannotWrite(target, errno);
    }
    ~Draft() {
        if (!name_.empty()) ::unlink(name_.c_str());
    }
    Draft(const Draft&) = delete;
    Draft& operator=(const Draft&) = delete;

    void commit(std::string_view bytes, mode_t mode) {
        writeAll(file_.get(), bytes, target_);
        if (::fchmod(file_.get(), mode) != 0 || !file_.close() ||
            ::rename(name_.c_str(), target_.c_str()) != 0)
            cannotWrite(target_, errno);
        name_.clear();
    }

  private:
    std::string target_, name_;
    File file_;
};

mode_t defaultMode() {
    const mode_t mask = ::umask(0);
    ::umask(mask);
    return 0666 & ~mask;
}

}  // namespace

std::string readInput(const std::string& path) {
    const bool standard = path == "-";
    const File file(standard ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC),
                    !standard);
    if (file.get() < 0)
        throw Error(errno == ENOENT ? "asset.missing" : "asset.unreadable",
                    "cannot be read: " + reason(errno), {path, 0, 0});
    std::string bytes;
    char chunk[65536];
    for (;;) {
        const ssize_t got = ::read(file.get(), chunk, sizeof chunk);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0)
            throw Error("asset.unreadable",
                        errno == EISDIR ? "is a folder; name the file in it that is meant"
                                        : "cannot be read: " + reason(errno),
                        {path, 0, 0});
        if (got == 0) return bytes;
        bytes.append(chunk, static_cast<std::size_t>(got));
        if (bytes.size() > kMaxInputBytes)
            throw Error("limit.file-bytes", "is larger than 256 MiB", {path, 0, 0});
    }
}

void writeOutput(const std::string& path, std::string_view bytes) {
    if (path == "-") return writeAll(STDOUT_FILENO, bytes, "to standard output");
    // A link keeps pointing where it does: the file it names is replaced.
    std::error_code unresolved;
    const std::string target = std::filesystem::weakly_canonical(path, unresolved).string();
    struct stat facts {};
    const bool exists = ::stat(target.c_str(), &facts) == 0;
    if (exists && S_ISDIR(facts.st_mode)) cannotWrite(path, EISDIR);
    if (exists && !S_ISREG(facts.st_mode)) {
        File device(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
        if (device.get() < 0) cannotWrite(path, errno);
        writeAll(device.get(), bytes, path);
        if (!device.close()) cannotWrite(path, errno);
        return;
    }
    if (exists && ::access(target.c_str(), W_OK) != 0) cannotWrite(path, errno);
    Draft(unresolved ? path : target).commit(bytes, exists ? facts.st_mode & 07777 : defaultMode());
}

std::string endingOf(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    if (!ending.empty()) ending.erase(0, 1);
    for (char& c : ending)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return ending;
}

std::string folderOf(const std::string& path) {
    const std::string folder = std::filesystem::path(path).parent_path().string();
    return folder.empty() ? "." : folder;
}

}  // namespace farol::cli
