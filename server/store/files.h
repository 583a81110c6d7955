#pragma once

#include <string>
#include <string_view>

/// Files that survive the end of the process, and of the machine, at any moment.
namespace farol::server::store {

/// A descriptor that is closed with it.
class Descriptor {
  public:
    explicit Descriptor(int fd) : fd_(fd) {}
    ~Descriptor();
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int fd() const { return fd_; }

  private:
    int fd_;
};

/// Writes `bytes` to `temporary`, and when they are on the disk, gives the file the name `path`,
/// and puts that on the disk as well. Returns 0 or an errno: then there is no new file, or (where
/// only the last step failed) a whole one that may not outlive the machine. All descriptors are
/// opened before the first change.
int writeDurably(const std::string& temporary, const std::string& path, std::string_view bytes);

/// Removes the file for good. Returns 0 (also where there was none) or an errno. All descriptors
/// are opened before the file is removed.
int removeDurably(const std::string& path);

/// Outcome of readWhole.
struct FileContent {
    enum class Kind {
        whole,
        missing,  ///< no such file
        foreign,  ///< no regular file, or larger than asked for: nothing that the store wrote
        failed    ///< the file may be intact: descriptors, memory or the disk failed
    };
    Kind kind = Kind::failed;
    int error = 0;      ///< errno of `failed`
    std::string bytes;  ///< of `whole`
};

/// Reads a file of at most `maxBytes`. Does not follow a symbolic link and never waits.
FileContent readWhole(const std::string& path, std::size_t maxBytes);

}  // namespace farol::server::store
