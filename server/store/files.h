#pragma once

#include <string>
#include <string_view>

/// Durable file operations: consistent after a crash of the process or the machine at any moment.
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

/// Writes `bytes` to `temporary`, syncs it, renames it to `path` and syncs the folder. Returns 0 or
/// an errno: then there is no new file, or (if only the last step failed) a complete one that may
/// not survive a crash of the machine. Opens all descriptors before
/// the first change.
int writeDurably(const std::string& temporary, const std::string& path, std::string_view bytes);

/// Removes the file durably. Returns 0 (also where there was none) or an errno. Opens all
/// descriptors before it removes the file.
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
