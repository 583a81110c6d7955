#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "scene/files/assets.h"
#include "scene/scene.h"

namespace farol::scene {

/// Finds the files that documents name, by the rule of docs/scene-language.md ("How a file is
/// found"); its only implementation. Lists the assets once, on first use: each missing name costs
/// one look-up.
class Locator {
  public:
    /// The assets must outlive it, and their files stay as they are. `main` is the document that
    /// `where.file` names by its shown name; every other one is named by its path.
    explicit Locator(const Assets& assets, DocumentPlace main = {});

    /// Finds the file that the document `where.file` means by `path`. Reports differences between
    /// `path` and the file's path at `where`: an info asset.in-parent, asset.case, asset.unicode,
    /// asset.percent or asset.code-page, a warning asset.found-elsewhere. Returns nothing if none
    /// fits or, with a warning asset.ambiguous, if several of different bytes fit.
    std::optional<std::string> locate(const std::string& path, const Location& where,
                                      Diagnostics& diagnostics);
    /// As Assets::list.
    const std::vector<std::string>& list();
    /// Returns whether `path`, written in the document `where.file`, leads out of the assets.
    bool leadsOut(const std::string& path, const Location& where) const;
    /// Returns "did you mean "x"?" for the candidate or file whose name is nearest to that of
    /// `path`, or nothing. Compares a bounded number of names.
    std::optional<Message> nearest(const std::string& path,
                                   std::vector<std::string> candidates = {});
    /// Returns how to fix a missing file: by --assets where `path` leads out of the assets, else as
    /// nearest, else to add it. Looks for the nearest name a bounded number of times: more missing
    /// files are the same mistake.
    Message advice(const std::string& path, const Location& where,
                   std::vector<std::string> candidates = {});

  private:
    /// How names are compared, in this order.
    enum class Reading { exact, folded, codePage };
    static constexpr int kReadings = 3;
    /// The search steps, in order.
    enum class Step { document, parent, suffix, baseName };
    struct Named {
        std::size_t index;  ///< into list()
        std::string key;    ///< the whole path as the reading compares it
    };
    /// Files by the last part of their key.
    using Index = std::map<std::string, std::vector<Named>>;
    /// A written path without "." and a drive.
    struct Wanted {
        std::vector<std::string> parts;
        bool isAbsolute = false;
    };
    struct Found {
        std::string path;
        Step step = Step::document;
        Reading reading = Reading::exact;
    };

    static Wanted parse(const std::string& path);
    std::string folderOf(const Location& where) const;
    static std::optional<std::string> join(std::string_view folder, const Wanted& wanted);
    const Index& index(Reading reading);
    std::optional<Found> look(const Wanted& wanted, const std::string& folder, Reading reading,
                              std::vector<std::string>& rivals);
    std::vector<std::string> distinct(std::vector<std::string> paths);
    bool haveEqualBytes(const std::string& a, const std::string& b);
    const std::string& digestOf(const std::string& path);
    void report(const std::string& path, const Found& found, const Location& where,
                Diagnostics& diagnostics) const;

    const Assets& assets_;
    DocumentPlace main_;
    int hintsLeft_ = 50;
    std::size_t bytesLeft_;  ///< that may be read to compare namesakes
    std::optional<std::vector<std::string>> paths_;
    std::optional<Index> indices_[kReadings];
    std::map<std::string, std::string> digests_;
};

/// Locator::locate for a single look-up.
std::optional<std::string> locate(const Assets& assets, const std::string& path,
                                  const Location& where, Diagnostics& diagnostics,
                                  DocumentPlace main = {});

}  // namespace farol::scene
