#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace farol::scene {

/// True for the first bytes of a zip, tar, gzip, 7z or rar file. Looks at nothing else.
bool isArchive(std::string_view bytes);

/// Returns the most bytes that the used files of an archive of `packed` bytes may have together.
std::size_t maxUnpackedBytes(std::size_t packed);

/// Throws Error limit.bundle: over Assets::kMaxListed entries.
[[noreturn]] void tooManyEntries();

/// The files and links of an archive one by one: zip (stored or deflated), tar, tar.gz, 7z, rar.
/// Skips folders, devices and clutter (isClutter). Bounded before allocation: entries, and bytes
/// unpacked to reach an entry. Throws Error bundle.damaged, bundle.path (absolute or with
/// ".."), limit.bundle.
class EntryReader {
  public:
    /// The bytes must outlive it.
    explicit EntryReader(std::string_view bytes);
    ~EntryReader();
    EntryReader(const EntryReader&) = delete;
    EntryReader& operator=(const EntryReader&) = delete;
    /// Advances to the next file or link; false at the end. Skips the unread rest of the current
    /// one.
    bool next();
    const std::string& path() const { return path_; }
    /// Returns the target of a symbolic or hard link as a path in the archive, "" if it is outside.
    /// Nothing for a file. A link has no content.
    const std::optional<std::string>& link() const { return link_; }
    std::uint64_t size() const { return size_; }  ///< in the archive's directory; 0: unknown
    /// Returns the file's bytes. Throws Error limit.bundle over `left` bytes, bundle.entry for an
    /// encrypted file or an unsupported method.
    std::string content(std::size_t left);

  private:
    struct Open;
    [[noreturn]] void fail() const;

    std::size_t packed_, passable_, entries_ = 0;
    std::uint64_t before_ = 0, size_ = 0;  ///< bytes of the entries before this one; of this one
    bool isSolid_ = false;                 ///< 7z and rar files may be
    std::string path_;
    std::optional<std::string> link_;
    std::unique_ptr<Open> open_;
};

}  // namespace farol::scene
