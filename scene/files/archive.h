#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/files/assets.h"
#include "scene/files/bundle.h"
#include "scene/files/entry_reader.h"

namespace farol::scene {

/// True for a name that ends like an archive's: zip, tar, gz, tgz, 7z, rar.
bool isArchiveName(std::string_view path);

/// The files of a zip (stored or deflated), tar, tar.gz, 7z or rar. Entries are listed first and
/// unpacked on demand: of a whole project only the files that a scene uses. A folder that holds
/// everything is left out of the paths; clutter (isClutter) is not listed. Archives in the archive,
/// two deep, are folders of their name: "a.zip/scene.xml". Links to files of the archive are these
/// files; other links, and devices, are left out.
/// Bounded before memory is allocated: entries listed (kMaxListed), bytes unpacked to reach an
/// entry, and bytes used. `read` throws Error limit.bundle, bundle.damaged, bundle.entry
/// (encrypted, or packed by a method that is not read), bundle.path (a name twice with different
/// bytes). Thread-safe.
class ArchiveAssets final : public Assets {
  public:
    /// Throws Error bundle.damaged, bundle.path (absolute or with ".."), limit.bundle.
    explicit ArchiveAssets(std::shared_ptr<const std::string> bytes);
    std::vector<std::string> list() const override;
    bool has(const std::string& path) const override;
    std::optional<std::string> read(const std::string& path) const override;
    std::optional<std::uint64_t> size(const std::string& path) const override;
    void prefetch(const std::vector<std::string>& paths) const override;
    std::string version(const std::string& path) const override;
    /// Upper bound of its memory, bytes: the packed archive and its unpacked files.
    std::size_t maxBytes() const { return packed_ + allowed_; }
    /// Infos about archives in the archive that were left closed, and about links.
    const Diagnostics& findings() const { return findings_; }

  private:
    struct File {
        std::shared_ptr<const std::string> archive;  ///< that holds it
        std::string name;                            ///< in there
        std::uint64_t size = 0;                      ///< in its directory
    };
    void follow(const std::map<std::string, std::string>& links, std::map<std::string, File>& files,
                const std::string& prefix);
    void keep(const std::string& path, const std::string& content) const;
    void open(std::shared_ptr<const std::string> bytes, const std::string& prefix, int depth);
    void note(Message text);
    void stripTop();
    void load(const std::vector<std::string>& paths) const;

    std::string digest_;
    std::size_t packed_, allowed_, entriesLeft_, nestedLeft_;
    std::map<std::string, File> files_;
    Diagnostics findings_;
    mutable std::mutex mutex_;
    mutable std::map<std::string, std::string> loaded_;
    mutable std::size_t used_ = 0;
};

/// Returns the document of an archive and the files its scenes need (neededFiles). Throws as
/// ArchiveAssets, mainOf and readFiles do.
Bundle readArchive(std::string_view bytes);

}  // namespace farol::scene
