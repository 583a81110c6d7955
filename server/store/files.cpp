#include "server/store/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <new>

namespace farol::server::store {
namespace {

int writeAll(int fd, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t wrote = write(fd, bytes.data(), bytes.size());
        if (wrote < 0 && errno == EINTR) continue;
        if (wrote < 0) return errno;
        bytes.remove_prefix(static_cast<std::size_t>(wrote));
    }
    return fsync(fd) == 0 ? 0 : errno;
}

Descriptor folderOf(const std::string& path) {
    const std::string folder = std::filesystem::path(path).parent_path().string();
    return Descriptor(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
}

int writeNew(const std::string& path, std::string_view bytes) {
    const Descriptor file(open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600));
    return file.fd() < 0 ? errno : writeAll(file.fd(), bytes);
}

}  // namespace

Descriptor::~Descriptor() {
    if (fd_ >= 0) close(fd_);
}

int writeDurably(const std::string& temporary, const std::string& path, std::string_view bytes) {
    const Descriptor folder = folderOf(path);
    if (folder.fd() < 0) return errno;
    int failed = writeNew(temporary, bytes);
    if (failed == 0 && rename(temporary.c_str(), path.c_str()) != 0) failed = errno;
    if (failed != 0) {
        unlink(temporary.c_str());
        return failed;
    }
    return fsync(folder.fd()) == 0 ? 0 : errno;
}

int removeDurably(const std::string& path) {
    const Descriptor folder = folderOf(path);
    if (folder.fd() < 0) return errno;
    if (unlink(path.c_str()) != 0) return errno == ENOENT ? 0 : errno;
    return fsync(folder.fd()) == 0 ? 0 : errno;
}

FileContent readWhole(const std::string& path, std::size_t maxBytes) {
    using Kind = FileContent::Kind;
    const auto failure = [](int error) {
        return FileContent{error == ENOENT ? Kind::missing : Kind::failed, error, {}};
    };
    struct stat facts {};
    if (lstat(path.c_str(), &facts) != 0) return failure(errno);
    if (!S_ISREG(facts.st_mode)) return {Kind::foreign, 0, {}};
    const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
    if (file.fd() < 0 || fstat(file.fd(), &facts) != 0) return failure(errno);
    if (!S_ISREG(facts.st_mode) || static_cast<std::size_t>(facts.st_size) > maxBytes)
        return {Kind::foreign, 0, {}};
    FileContent content{Kind::whole, 0, {}};
    try {
        content.bytes.resize(static_cast<std::size_t>(facts.st_size));
    } catch (const std::bad_alloc&) {
        return failure(ENOMEM);
    }
    std::size_t done = 0;
    while (done < content.bytes.size()) {
        const ssize_t got =
            read(file.fd(), content.bytes.data() + done, content.bytes.size() - done);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return {Kind::failed, errno, {}};
        if (got == 0) return {Kind::failed, EIO, {}};  // shorter than its size
        done += static_cast<std::size_t>(got);
    }
    return content;
}

}  // namespace farol::server::store
