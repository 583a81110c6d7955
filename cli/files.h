#pragma once

#include <sys/types.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/message.h"

/// Files as the command line names them: any path, "-" for stdin and stdout.
namespace farol::cli {

/// Larger inputs are refused: Error limit.file-bytes.
inline constexpr std::size_t kMaxInputBytes = std::size_t{256} << 20U;

/// An output cannot be written. The exit code is kInternal: the input is right.
class OutputError : public std::runtime_error {
  public:
    explicit OutputError(Message message)
        : std::runtime_error(message.text), message_(std::move(message)) {}
    const Message& message() const { return message_; }

  private:
    Message message_;
};

/// Throws Error asset.missing or asset.unreadable, which name the file.
std::string readInput(const std::string& path);

/// Reads a regular file of at most `maxBytes`, without waiting and without following a link. Throws
/// Error asset.missing, asset.unreadable, limit.file-bytes.
std::string readRegularFile(const std::string& path, std::size_t maxBytes);

/// An open descriptor, closed at the end where it is owned.
class File {
  public:
    explicit File(int descriptor, bool isOwned = true)
        : descriptor_(descriptor), isOwned_(isOwned) {}
    ~File();
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    int get() const { return descriptor_; }
    bool isOwned() const { return isOwned_; }
    /// Returns whether the system accepted all written bytes.
    bool close();

  private:
    int descriptor_;
    bool isOwned_;
};

/// An output file, written atomically: commit() renames a temporary file beside it to its name; the
/// destructor removes an uncommitted one. Devices, pipes and standard output are written directly.
/// Functions throw OutputError with the system's reason.
class OutputFile {
  public:
    explicit OutputFile(const std::string& path);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    void append(std::string_view bytes);
    void commit();

  private:
    std::string path_, target_;
    std::string draft_;  ///< the temporary file; empty: there is none
    mode_t mode_ = 0;
    std::unique_ptr<File> file_;
};

/// Writes `bytes` as an OutputFile.
void writeOutput(const std::string& path, std::string_view bytes);

/// The folder that holds the file, "." where the path names none.
std::string folderOf(const std::string& path);

}  // namespace farol::cli
