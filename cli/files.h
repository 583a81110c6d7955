#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

/// Files as the command line names them: any path, "-" for stdin and stdout.
namespace farol::cli {

/// Larger inputs are refused: Error limit.file-bytes.
inline constexpr std::size_t kMaxInputBytes = std::size_t{256} << 20U;

/// An output cannot be written. The input is not at fault, so that it becomes kInternal.
class OutputError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Throws Error asset.missing or asset.unreadable, which name the file.
std::string readInput(const std::string& path);

/// Writes all or nothing: into a temporary file beside it, which then takes its name. Devices and
/// pipes are written directly. Throws OutputError, which says what the system said.
void writeOutput(const std::string& path, std::string_view bytes);

/// The ending of the name without its dot, lower case: "png"; "" where there is none.
std::string endingOf(const std::string& path);

/// The folder that holds the file, "." where the path names none.
std::string folderOf(const std::string& path);

}  // namespace farol::cli
