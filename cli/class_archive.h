#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/files.h"

namespace farol::cli {

/// A zip of a class's submissions, as Moodle exports it: read entry by entry, never decompressed
/// here. packed() copies the compressed entries of a submission into a zip for the sandbox.
class ClassArchive {
  public:
    /// A file in the zip.
    struct Entry {
        std::string path;  ///< UTF-8; names of older systems are read as Latin-1
        std::uint32_t packed = 0;
    };

    /// Reads the directory. Checks the sizes of the file (2 GiB) and of its directory first.
    /// Throws Error asset.missing, asset.unreadable, limit.file-bytes, bundle.damaged,
    /// limit.bundle.
    explicit ClassArchive(const std::string& path);

    const std::vector<Entry>& entries() const { return entries_; }

    /// Returns a zip of these entries under the names `names`. Throws Error limit.bundle over
    /// `maxBytes`, bundle.damaged.
    std::string packed(const std::vector<std::size_t>& entries,
                       const std::vector<std::string>& names, std::size_t maxBytes) const;

  private:
    struct Record {  ///< of an entry in the directory
        std::uint16_t madeBy, flags, method, time, date;
        std::uint32_t crc, packed, size, attributes, offset;
    };
    std::string readAt(std::uint64_t offset, std::size_t size) const;
    [[noreturn]] void damaged() const;

    std::string path_;
    File file_;
    std::uint64_t size_ = 0;
    std::vector<Entry> entries_;
    std::vector<Record> records_;
};

}  // namespace farol::cli
