#pragma once

#include <functional>
#include <mutex>
#include <string>

#include "server/store/record_store.h"

namespace farol::server::store {

/// Records in a folder, a file each: `records/TABLE/KEY`. Each file read is checked against its
/// digest; a damaged one is never served and stays where it is. The caller holds the folder's lock
/// (DiskStore).
class DiskRecords final : public RecordStore {
  public:
    using Log = std::function<void(const std::string&)>;

    /// `maxBytes`: of all files together. Throws std::runtime_error when the folder cannot be made
    /// or listed.
    DiskRecords(const std::string& folder, std::uint64_t maxBytes, Log log);

    void put(const std::string& table, const std::string& key, const std::string& bytes,
             Time expires) override;
    std::optional<std::string> get(const std::string& table, const std::string& key) override;
    bool remove(const std::string& table, const std::string& key) override;
    std::vector<std::string> keys(const std::string& table) override;
    std::size_t expire() override;

  private:
    std::string pathOf(const std::string& table, const std::string& key) const;
    /// Returns the size of a file, 0 where there is none.
    static std::uint64_t sizeOf(const std::string& path);
    bool drop(const std::string& path);

    const std::string folder_;
    const std::uint64_t maxBytes_;
    const Log log_;
    std::mutex mutex_;
    std::uint64_t bytes_ = 0;
};

}  // namespace farol::server::store
