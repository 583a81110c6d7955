#include "cli/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "cli/messages.h"
#include "core/error.h"

namespace farol::cli {
namespace {

std::string reason(int error) { return std::generic_category().message(error); }

[[noreturn]] void cannotWrite(const std::string& path, int error) {
    throw OutputError(
        message<"output.unwritable">("path"_arg = uncut(path), "reason"_arg = reason(error)));
}

Message cannotRead(int error) {
    return error == ENOENT ? message<"asset.missing/input">("reason"_arg = reason(error))
                           : message<"asset.unreadable/input">("reason"_arg = reason(error));
}

void writeAll(int descriptor, std::string_view bytes, const std::string& path) {
    while (!bytes.empty()) {
        const ssize_t done = ::write(descriptor, bytes.data(), bytes.size());
        if (done < 0 && errno == EINTR) continue;
        if (done < 0) cannotWrite(path, errno);
        bytes.remove_prefix(static_cast<std::size_t>(done));
    }
}

const char* typeName(mode_t mode) {
    if (S_ISDIR(mode)) return "a folder";
    if (S_ISLNK(mode)) return "a symbolic link, which is not followed";
    if (S_ISFIFO(mode)) return "a pipe";
    if (S_ISSOCK(mode)) return "a socket";
    return "a device";
}

mode_t defaultMode() {
    const mode_t mask = ::umask(0);
    ::umask(mask);
    return 0666 & ~mask;
}

}  // namespace

File::~File() {
    if (isOwned_ && descriptor_ >= 0) ::close(descriptor_);
}

bool File::close() {
    const int result = ::close(descriptor_);
    descriptor_ = -1;
    return result == 0;
}

std::string readInput(const std::string& path) {
    const bool standard = path == "-";
    const File file(standard ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC),
                    !standard);
    if (file.get() < 0) throw Error(cannotRead(errno), {path, 0, 0});
    std::string bytes;
    char chunk[65536];
    for (;;) {
        const ssize_t got = ::read(file.get(), chunk, sizeof chunk);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0)
            throw Error(errno == EISDIR ? message<"asset.unreadable/folder">() : cannotRead(errno),
                        {path, 0, 0});
        if (got == 0) return bytes;
        bytes.append(chunk, static_cast<std::size_t>(got));
        if (bytes.size() > kMaxInputBytes)
            throw Error(message<"limit.file-bytes">("max"_arg = kMaxInputBytes >> 20U),
                        {path, 0, 0});
    }
}

std::string readRegularFile(const std::string& path, std::size_t maxBytes) {
    const auto refuse = [&](Message why) { throw Error(std::move(why), {path, 0, 0}); };
    struct stat facts {};
    if (::lstat(path.c_str(), &facts) != 0) throw Error(cannotRead(errno), {path, 0, 0});
    if (!S_ISREG(facts.st_mode))
        refuse(message<"asset.unreadable/kind">("found"_arg = typeName(facts.st_mode)));
    const File file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
    if (file.get() < 0 || ::fstat(file.get(), &facts) != 0) refuse(cannotRead(errno));
    if (!S_ISREG(facts.st_mode)) refuse(message<"asset.unreadable/replaced">());
    std::string bytes;
    char chunk[65536];
    for (;;) {
        const ssize_t got = ::read(file.get(), chunk, sizeof chunk);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) refuse(cannotRead(errno));
        if (got == 0) return bytes;
        bytes.append(chunk, static_cast<std::size_t>(got));
        if (bytes.size() > maxBytes || facts.st_size > static_cast<off_t>(maxBytes))
            throw Error(message<"limit.file-bytes">("max"_arg = maxBytes >> 20U), {path, 0, 0});
    }
}

OutputFile::OutputFile(const std::string& path) : path_(path) {
    if (path == "-") {
        path_ = "to standard output";
        file_ = std::make_unique<File>(STDOUT_FILENO, false);
        return;
    }
    // A link keeps pointing where it does: the file it names is replaced.
    std::error_code unresolved;
    target_ = std::filesystem::weakly_canonical(path, unresolved).string();
    struct stat facts {};
    const bool exists = ::stat(target_.c_str(), &facts) == 0;
    if (exists && S_ISDIR(facts.st_mode)) cannotWrite(path, EISDIR);
    if (exists && !S_ISREG(facts.st_mode)) {
        file_ = std::make_unique<File>(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
        if (file_->get() < 0) cannotWrite(path, errno);
        return;
    }
    if (exists && ::access(target_.c_str(), W_OK) != 0) cannotWrite(path, errno);
    if (unresolved) target_ = path;
    mode_ = exists ? facts.st_mode & 07777 : defaultMode();
    draft_ = target_ + ".XXXXXX";
    file_ = std::make_unique<File>(::mkstemp(draft_.data()));
    if (file_->get() < 0) {
        draft_.clear();
        cannotWrite(target_, errno);
    }
}

OutputFile::~OutputFile() {
    if (!draft_.empty()) ::unlink(draft_.c_str());
}

void OutputFile::append(std::string_view bytes) { writeAll(file_->get(), bytes, path_); }

void OutputFile::commit() {
    if (!file_->isOwned()) return;
    if (!draft_.empty() && ::fchmod(file_->get(), mode_) != 0) cannotWrite(path_, errno);
    if (!file_->close()) cannotWrite(path_, errno);
    if (!draft_.empty() && ::rename(draft_.c_str(), target_.c_str()) != 0)
        cannotWrite(path_, errno);
    draft_.clear();
}

void writeOutput(const std::string& path, std::string_view bytes) {
    OutputFile file(path);
    file.append(bytes);
    file.commit();
}

std::string folderOf(const std::string& path) {
    const std::string folder = std::filesystem::path(path).parent_path().string();
    return folder.empty() ? "." : folder;
}

}  // namespace farol::cli
