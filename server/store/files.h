#pragma once

#include <optional>
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
/// only the last step failed) a whole one that may not outlive the machine.
int writeDurably(const std::string& temporary, const std::string& path, std::string_view bytes);

/// Removes the file for good. Returns 0 (also where there was none) or an errno.
int removeDurably(const std::string& path);

/// The file's bytes; nothing where it is not a regular file, is larger than `most`, or cannot be
/// read.
std::optional<std::string> readWhole(const std::string& path, std::size_t most);

}  // namespace farol::server::store
