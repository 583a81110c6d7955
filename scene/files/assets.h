#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

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
    /// The file's size, or nothing where there is no such file.
    virtual std::optional<std::uint64_t> size(const std::string& path) const = 0;
    /// Announces that these files will be read next: an archive reads them in one pass.
    virtual void prefetch(const std::vector<std::string>& /*paths*/) const {}
    /// A token that changes when the file's content may have changed, for cache keys.
    virtual std::string version(const std::string& path) const = 0;

    static constexpr std::size_t kMaxListed = 50'000;
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
    std::optional<std::uint64_t> size(const std::string& path) const override;
    std::string version(const std::string& path) const override;

  private:
    struct Digests;  ///< made on demand; copies of a bundle share them
    std::shared_ptr<const Files> files_;
    std::shared_ptr<Digests> digests_;
};

/// Identifies a folder, since another one may replace it under the same path.
struct FolderIdentity {
    std::uint64_t device = 0, inode = 0;
    std::int64_t bornS = 0, bornNs = 0;  ///< its birth, where the file system knows it
    bool operator==(const FolderIdentity&) const = default;
};
/// Returns nothing where the path leads to no folder. Follows links.
std::optional<FolderIdentity> folderIdentity(const std::string& path);

/// Files below a folder; symbolic links that lead out of it are not found. `list` and `read` throw
/// std::system_error where descriptors, memory or the disk fail: the file may be there.
class FolderAssets final : public Assets {
  public:
    explicit FolderAssets(std::string root);
    /// An entry below the folder that is no file: a folder, a link that leads nowhere, a pipe.
    struct Oddity {
        std::string path;
        std::string what;  ///< "is a pipe"
    };
    /// Lists those whose path ends in `suffix`, sorted, kMaxListed at most. Links that lead out of
    /// the folder are left out.
    std::vector<Oddity> oddities(std::string_view suffix) const;
    /// Returns the type of the entry at `path` if it is no file ("is a pipe"); empty for a file,
    /// and where there is none.
    std::string oddityOf(const std::string& path) const;
    /// Throws std::system_error where the folder cannot be opened.
    void checkReadable() const;
    std::optional<std::uint64_t> size(const std::string& path) const override;
    std::vector<std::string> list() const override;
    bool has(const std::string& path) const override;
    std::optional<std::string> read(const std::string& path) const override;
    std::string version(const std::string& path) const override;
    /// The folder, absolute and without links; empty where there is none.
    const std::string& root() const { return root_; }

  private:
    std::optional<std::string> resolve(const std::string& path) const;
    void walk(const std::function<bool(const std::string& path, int type)>& visit) const;
    std::string root_;
};

/// True for files of operating systems and version control beside a project's own: anything in
/// __MACOSX, .git, .svn or .hg, "._name", .DS_Store, Thumbs.db, desktop.ini. They are never
/// listed.
bool isClutter(std::string_view path);

/// True for a relative path without "..", empty parts, backslashes, drive letters or NUL.
bool isSafePath(const std::string& path);

}  // namespace farol::scene
