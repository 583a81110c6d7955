#include "scene/files/bundle.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "core/digest.h"
#include "core/text.h"
#include "core/utf16.h"
#include "scene/files/spelling.h"
#include "scene/messages.h"

namespace farol::scene {
namespace {

constexpr std::size_t kShownCandidates = 5;

constexpr std::size_t kMaxDocuments = 1'000;
constexpr std::size_t kMaxDocumentBytes = std::size_t{1} << 20U;
constexpr std::size_t kMeshHead = std::size_t{64} << 10U;  // of a mesh, where libraries are named

bool isDocument(std::string_view path) { return fileEnding(path) == "xml" && path.size() > 4; }

/// The documents among the files that are small enough to be scenes, in the order of the list.
std::vector<std::string> documentsOf(const Assets& files, const std::vector<std::string>& paths) {
    std::vector<std::string> documents;
    for (const std::string& path : paths)
        if (isDocument(path) && documents.size() < kMaxDocuments &&
            files.size(path).value_or(0) <= kMaxDocumentBytes)
            documents.push_back(path);
    files.prefetch(documents);
    return documents;
}

/// Adds the base names that a text may mean: of quoted texts, of single words, and of the ends of
/// lines.
void addNames(std::string_view text, std::set<std::string>& names) {
    const std::optional<std::string> wide = utf16ToUtf8(text);
    if (wide) text = *wide;
    constexpr std::size_t kMaxWordBytes = 1024;
    const auto add = [&](std::string_view word) {
        word = trimmed(word);
        while (word.ends_with('/')) word.remove_suffix(1);  // of an empty tag
        if (word.empty() || word.size() > kMaxWordBytes) return;
        names.insert(spelling::folded(baseName(word)));
        names.insert(spelling::folded(baseName(spelling::percentDecoded(word))));
        // "bezier_comet_10.3d" means comet.patch.
        for (const std::string_view part : split(baseName(word), "_"))
            names.insert(spelling::folded(part) + ".patch");
    };
    for (const std::string_view word : split(text, " \t\r\n\"'<>=,;")) add(word);
    // Names with blanks, also behind the words of a material library: "map_Kd -s 1 1 1 my
    // wood.png".
    constexpr int kMaxWords = 12;
    for (std::string_view line : split(text, "\"'\r\n"))
        for (int i = 0; i < kMaxWords && !line.empty(); ++i) {
            add(line);
            const std::size_t blank = line.find_first_of(" \t");
            line = blank == std::string_view::npos ? "" : trimmed(line.substr(blank));
        }
}

bool isMesh(const std::string& path) {
    static constexpr std::string_view kEndings[] = {".3d",  ".3db", ".obj", ".ply",
                                                    ".tri", ".stl", ".off", ".patch"};
    return std::any_of(std::begin(kEndings), std::end(kEndings), [&](std::string_view ending) {
        return path.size() > ending.size() &&
               sameWord(std::string_view(path).substr(path.size() - ending.size()), ending);
    });
}

}  // namespace

bool beginsAsScene(std::string_view text) {
    const std::optional<std::string> wide = utf16ToUtf8(text);
    if (wide) text = *wide;
    static constexpr std::string_view kRoots[] = {"world", "scene", "xmls", "includes"};
    for (std::size_t at = text.find('<'); at != std::string_view::npos; at = text.find('<', at)) {
        text.remove_prefix(at + 1);
        at = 0;
        if (text.starts_with("!--")) {
            const std::size_t end = text.find("-->");
            if (end == std::string_view::npos) return false;
            text.remove_prefix(end);
        } else if (!text.empty() && text[0] != '?' && text[0] != '!') {
            const std::string_view name = text.substr(0, text.find_first_of(" \t\r\n/>"));
            return std::any_of(std::begin(kRoots), std::end(kRoots),
                               [&](std::string_view root) { return sameWord(root, name); });
        }
    }
    return false;
}

std::size_t Bundle::bytes() const {
    std::size_t sum = 0;
    for (const auto& [path, content] : files) sum += path.size() + content.size();
    return sum;
}

std::string mainOf(const Assets& files) {
    if (files.has("scene.xml")) return "scene.xml";
    const std::vector<std::string> paths = files.list();
    std::vector<std::string> candidates;
    std::copy_if(paths.begin(), paths.end(), std::back_inserter(candidates), isDocument);
    if (candidates.size() > 1) {
        std::vector<std::string> scenes, called;
        for (const std::string& path : documentsOf(files, paths))
            if (beginsAsScene(files.read(path).value_or(""))) {
                scenes.push_back(path);
                if (sameWord(baseName(path), "scene.xml")) called.push_back(path);
            }
        const auto depthOf = [](const std::string& path) {
            return std::count(path.begin(), path.end(), '/');
        };
        std::stable_sort(called.begin(), called.end(),
                         [&](const auto& a, const auto& b) { return depthOf(a) < depthOf(b); });
        if (called.size() == 1 || (called.size() > 1 && depthOf(called[0]) < depthOf(called[1])))
            return called.front();
        if (!scenes.empty()) candidates = std::move(scenes);
    }
    if (candidates.size() == 1) return candidates.front();
    if (candidates.empty()) {
        const auto mesh = std::find_if(paths.begin(), paths.end(), isMesh);
        // A word of a document cannot hold quotes, and a name with them is better not shown as
        // code.
        const bool isShown =
            mesh != paths.end() && mesh->find_first_of("\"<&") == std::string::npos;
        throw Error(isShown ? message<"bundle.no-scene/mesh">("mesh"_arg = uncut(*mesh))
                            : message<"bundle.no-scene">(),
                    {}, "scene");
    }
    const std::span<const std::string> named(candidates.data(),
                                             std::min(candidates.size(), kShownCandidates));
    std::string names = joined(named, ", ", quoted);
    if (candidates.size() > kShownCandidates) names += ", ...";
    throw Error(message<"bundle.which-scene">("candidates"_arg = uncut(names)), {}, "scene");
}

namespace {

/// The names that documents, meshes and libraries hold, and the files that bear them.
class NamedFiles {
  public:
    NamedFiles(const Assets& files, const std::vector<std::string>& paths)
        : files_(files), paths_(paths) {}

    /// Adds the files that `begin` name, those that these name, and so on. Documents among them are
    /// read whole, of meshes their beginning.
    void follow(std::vector<std::string> begin, bool throughDocuments) {
        taken_.insert(begin.begin(), begin.end());
        readNames(begin);
        // Documents include documents; meshes name libraries, which name images.
        constexpr int kMaxRounds = 4;
        for (int round = 0; round < kMaxRounds; ++round) {
            std::vector<std::string> fresh;
            for (const std::string& path : paths_)
                if (taken_.count(path) == 0 && (throughDocuments || !isDocument(path)) &&
                    isNamed(path))
                    fresh.push_back(path);
            taken_.insert(fresh.begin(), fresh.end());
            std::erase_if(fresh, [](const std::string& path) {
                return !isDocument(path) && fileEnding(path) != "obj" && fileEnding(path) != "mtl";
            });
            if (fresh.empty()) break;
            readNames(fresh);
        }
    }
    const std::set<std::string>& taken() const { return taken_; }

  private:
    bool isNamed(const std::string& path) const {
        if (names_.count(spelling::folded(baseName(path))) != 0) return true;
        const auto others = spelling::otherReadings(baseName(path));
        return std::any_of(others.begin(), others.end(), [&](const std::string& other) {
            return names_.count(spelling::folded(other)) != 0;
        });
    }
    void readNames(const std::vector<std::string>& fresh) {
        files_.prefetch(fresh);
        for (const std::string& path : fresh) {
            if (isDocument(path) && files_.size(path).value_or(0) > kMaxDocumentBytes) continue;
            const std::string content = files_.read(path).value_or("");
            addNames(isDocument(path) ? content : content.substr(0, kMeshHead), names_);
        }
    }

    const Assets& files_;
    const std::vector<std::string>& paths_;
    std::set<std::string> names_, taken_;
};

}  // namespace

std::vector<std::string> filesNamedBy(const Assets& files, const std::string& document) {
    const std::vector<std::string> paths = files.list();
    NamedFiles named(files, paths);
    named.follow({document}, true);
    std::vector<std::string> out = {document};
    std::copy_if(named.taken().begin(), named.taken().end(), std::back_inserter(out),
                 [&](const std::string& path) { return path != document; });
    return out;
}

std::vector<std::string> neededFiles(const Assets& files, const std::vector<std::string>& paths,
                                     std::size_t mostBytes) {
    std::uint64_t sum = 0;
    for (const std::string& path : paths) sum += files.size(path).value_or(0);
    if (paths.size() <= kMaxBundleFiles && sum <= mostBytes) return paths;
    NamedFiles named(files, paths);
    named.follow(documentsOf(files, paths), false);
    return {named.taken().begin(), named.taken().end()};
}

std::map<std::string, std::string> readFiles(const Assets& files,
                                             const std::vector<std::string>& paths,
                                             std::size_t mostBytes) {
    files.prefetch(paths);
    std::map<std::string, std::string> read;
    std::uint64_t sum = 0;
    for (const std::string& path : paths) {
        sum += files.size(path).value_or(0);
        if (sum > mostBytes)
            throw Error(message<"limit.bundle/needed">("most"_arg = mostBytes >> 20U));
        auto content = files.read(path);
        if (!content) throw Error(message<"asset.unreadable/file">(), {path, 0, 0});
        read.emplace(path, std::move(*content));
    }
    return read;
}

std::string digestOf(const Bundle& bundle) {
    std::string all = std::to_string(bundle.main.size()) + ":" + bundle.main;
    for (const auto& [path, content] : bundle.files)
        all.append(std::to_string(path.size()))
            .append(":")
            .append(path)
            .append(contentDigest(content));
    return contentDigest(all);
}

}  // namespace farol::scene
