#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/error.h"

namespace farol::scene {

/// The files that a scene may name: a folder or an uploaded bundle. Paths are relative, with
/// forward slashes; anything absolute, with "..", a drive or a NUL is never found.
class Assets {
  public:
    virtual ~Assets() = default;
    /// All paths, sorted; bounded (kMaxListed).
    virtual std::vector<std::string> list() const = 0;
    virtual bool has(const std::string& path) const = 0;
    /// The file's bytes, or nothing where there is no such file.
    virtual std::optional<std::string> read(const std::string& path) const = 0;
    /// A token that changes when the file's content may have changed, for cache keys.
    virtual std::string version(const std::string& path) const = 0;

    static constexpr std::size_t kMaxListed = 10'000;
    /// Larger files on disk are refused by `read`: Error limit.file-bytes.
    static constexpr std::size_t kMaxFileBytes = std::size_t{256} << 20U;
};

/// Files in memory: the parts of an upload.
class BundleAssets final : public Assets {
  public:
    using Files = std::map<std::string, std::string>;
    /// Files of other than safe paths are left out.
    explicit BundleAssets(Files files = {});
    /// Precondition: all paths are safe.
    explicit BundleAssets(std::shared_ptr<const Files> files);
    std::size_t bytes() const;  ///< of all files
    std::vector<std::string> list() const override;
    bool has(const std::string& path) const override;
    std::optional<std::string> read(const std::string& path) const override;
    std::string version(const std::string& path) const override;

  private:
    struct Digests;  ///< made on demand; copies of a bundle share them
    std::shared_ptr<const Files> files_;
    std::shared_ptr<Digests> digests_;
};

/// Files below a folder; symbolic links that lead out of it are not found.
class FolderAssets final : public Assets {
  public:
    explicit FolderAssets(std::string root);
    std::vector<std::string> list() const override;
    bool has(const std::string& path) const override;
    std::optional<std::string> read(const std::string& path) const override;
    std::string version(const std::string& path) const override;
    /// The folder, absolute and without links; empty where there is none.
    const std::string& root() const { return root_; }

  private:
    std::optional<std::string> resolve(const std::string& path) const;
    std::string root_;
};

/// True for a relative path without "..", empty parts, backslashes, drive letters or NUL.
bool isSafePath(const std::string& path);

/// Finds the file that a scene means by `path`: as written, else the one file of the same base
/// name (case-sensitive, then not), with a warning `asset.found-elsewhere` at `where`.
/// Returns nothing when there is none or, with a warning `asset.ambiguous`, more than one.
std::optional<std::string> locate(const Assets& assets, const std::string& path,
                                  const Location& where, Diagnostics& diagnostics);

}  // namespace farol::scene
