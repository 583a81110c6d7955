#include "server/folder_watch.h"

#include <sys/inotify.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <vector>

namespace farol::server {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kChanges = IN_CREATE | IN_DELETE | IN_MODIFY | IN_MOVED_FROM | IN_MOVED_TO |
                                   IN_ATTRIB | IN_DELETE_SELF | IN_MOVE_SELF | IN_ONLYDIR |
                                   IN_DONT_FOLLOW | IN_EXCL_UNLINK;

}  // namespace

FolderWatch::FolderWatch(std::string root) : root_(std::move(root)) {
    if (root_.empty()) return;
    fd_ = ::inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    isWatched_ = true;
    if (fd_ < 0)
        giveUp(std::generic_category().message(errno));
    else
        watchAll();
}

FolderWatch::~FolderWatch() {
    if (fd_ >= 0) ::close(fd_);
}

void FolderWatch::giveUp(const std::string& why) {
    isWatched_ = false;  // the descriptor stays: another thread may be asking it
    fault_ = why;
}

// Watches a folder before listing it: files created in between are listed or cause an event.
void FolderWatch::watchAll() {
    std::vector<fs::path> folders{root_};
    for (std::size_t i = 0; i < folders.size(); ++i) {
        if (folders.size() > kMaxFolders)
            return giveUp("it has more than " + std::to_string(kMaxFolders) + " folders");
        if (::inotify_add_watch(fd_, folders[i].c_str(), kChanges) < 0) {
            // Removed in between, or unreadable for this process, as its files then are, too.
            if (errno == ENOENT || errno == ENOTDIR || errno == EACCES) continue;
            return giveUp(std::generic_category().message(errno));
        }
        std::error_code failed;
        fs::directory_iterator at(folders[i], failed);
        for (; !failed && at != fs::directory_iterator(); at.increment(failed)) {
            std::error_code unknown;
            if (at->symlink_status(unknown).type() == fs::file_type::directory)
                folders.push_back(at->path());
        }
    }
}

bool FolderWatch::hasNotes() const {
    int bytes = 0;
    return ::ioctl(fd_, FIONREAD, &bytes) != 0 || bytes > 0;
}

// True if there may be folders that are not watched yet.
bool FolderWatch::takeNotes() {
    bool newFolders = false;
    alignas(inotify_event) std::array<char, 16 * 1024> bytes;
    for (;;) {
        const ssize_t got = ::read(fd_, bytes.data(), bytes.size());
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return newFolders;
        for (std::size_t at = 0; at + sizeof(inotify_event) <= static_cast<std::size_t>(got);) {
            inotify_event note{};
            std::memcpy(&note, bytes.data() + at, sizeof note);
            const bool isNew = (note.mask & (IN_CREATE | IN_MOVED_TO | IN_ATTRIB)) != 0 &&
                               (note.mask & IN_ISDIR) != 0;
            newFolders = newFolders || isNew || (note.mask & IN_Q_OVERFLOW) != 0;
            at += sizeof note + note.len;
        }
    }
}

std::optional<std::uint64_t> FolderWatch::revision() {
    if (!isWatched_) return std::nullopt;
    const auto now = std::chrono::steady_clock::now();
    if (hasNotes() || now - renewed_.load() >= kMaxDelay) {
        const std::lock_guard lock(mutex_);
        // Increment before takeNotes(): a thread that finds no notes must see the new number. And
        // again after watching new folders: earlier changes in them were missed.
        ++revision_;
        if (takeNotes()) {
            watchAll();
            ++revision_;
        }
        renewed_ = now;
        if (!isWatched_) return std::nullopt;
    }
    return revision_.load();
}

std::string FolderWatch::fault() const {
    const std::lock_guard lock(mutex_);
    return fault_;
}

}  // namespace farol::server
