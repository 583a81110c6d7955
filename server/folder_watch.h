#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>

namespace farol::server {

/// Detects changes below a folder without reading its files (inotify). The kernel queues an event
/// before the system call that makes the change returns, so that revision() reports every earlier
/// change. Changes without an event (another machine's writes to a shared disk, a mapped
/// file, a hard link elsewhere) are covered by a new revision each second.
class FolderWatch {
  public:
    /// `root`: absolute and without links; empty: nothing is watched.
    explicit FolderWatch(std::string root);
    ~FolderWatch();
    FolderWatch(const FolderWatch&) = delete;
    FolderWatch& operator=(const FolderWatch&) = delete;

    /// Returns the same number as before only if no change since is known. Nothing if the folder
    /// cannot be watched as a whole: then every request has to read it.
    std::optional<std::uint64_t> revision();
    /// Why the folder is not watched; empty while it is.
    std::string fault() const;

    static constexpr std::size_t kMaxFolders = 4096;
    static constexpr std::chrono::seconds kMaxDelay{1};

  private:
    void watchAll();
    bool hasNotes() const;
    bool takeNotes();
    void giveUp(const std::string& why);

    const std::string root_;
    mutable std::mutex mutex_;
    int fd_ = -1;
    std::string fault_;
    std::atomic<bool> isWatched_{false};
    std::atomic<std::uint64_t> revision_{1};
    std::atomic<std::chrono::steady_clock::time_point> renewed_;
};

}  // namespace farol::server
