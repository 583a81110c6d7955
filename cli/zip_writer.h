#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace farol::cli {

/// A file of a zip with its packed bytes.
struct ZipEntry {
    std::string name;  ///< UTF-8, with forward slashes
    std::uint16_t madeBy = 0, method = 0;
    std::uint16_t time = 0, date = 0x21;  ///< of MS-DOS; 1980-01-01
    std::uint32_t crc = 0, size = 0, attributes = 0;
    std::string packed;
};

/// Writes a zip entry by entry (PKWARE's APPNOTE 6.3, without zip64: less than 4 GiB, 65,535
/// entries). Only the directory stays in memory.
class ZipWriter {
  public:
    explicit ZipWriter(std::function<void(std::string_view)> write) : write_(std::move(write)) {}
    void add(const ZipEntry& entry);
    /// Adds a file as it is, without compression.
    void addStored(const std::string& name, std::string bytes);
    /// Writes the directory. Nothing can be added then.
    void finish();
    std::uint64_t bytes() const { return bytes_; }  ///< written so far

  private:
    void put(std::string_view bytes);

    std::function<void(std::string_view)> write_;
    std::string directory_;
    std::uint64_t bytes_ = 0;
    std::uint16_t count_ = 0;
};

}  // namespace farol::cli
