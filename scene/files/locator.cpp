#include "scene/files/locator.h"

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

#include "core/did_you_mean.h"
#include "core/digest.h"
#include "core/text.h"
#include "scene/files/spelling.h"
#include "scene/messages.h"

namespace farol::scene {
namespace {

/// Files of one name whose bytes are compared; with more the name is ambiguous.
constexpr std::size_t kMaxNamesakes = 64;
constexpr std::size_t kMaxCompared = std::size_t{256} << 20U;
constexpr std::size_t kShownRivals = 5;
constexpr std::size_t kMaxParts = 256;

std::string parentOf(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    return slash == std::string::npos ? "" : path.substr(0, slash);
}

/// The number of parts that two paths share at their ends.
std::size_t sharedTail(const std::vector<std::string_view>& a,
                       const std::vector<std::string_view>& b) {
    const auto [at, other] = std::mismatch(a.rbegin(), a.rend(), b.rbegin(), b.rend());
    return static_cast<std::size_t>(at - a.rbegin());
}

std::size_t sharedHead(std::string_view a, std::string_view b) {
    const auto left = split(a, "/"), right = split(b, "/");
    const auto [at, other] = std::mismatch(left.begin(), left.end(), right.begin(), right.end());
    return static_cast<std::size_t>(at - left.begin());
}

/// The last parts in which the ends of two paths differ.
std::pair<std::string, std::string> firstDifference(std::string written, const std::string& found) {
    std::replace(written.begin(), written.end(), '\\', '/');
    const auto a = split(written, "/"), b = split(found, "/");
    const auto [at, other] = std::mismatch(a.rbegin(), a.rend(), b.rbegin(), b.rend());
    if (at == a.rend() || other == b.rend()) return {};
    return {std::string(*at), std::string(*other)};
}

/// A path for a message, in quotes: at most its last 200 bytes, from a slash on.
std::string named(std::string path) {
    constexpr std::size_t kShown = 200;
    std::replace_if(
        path.begin(), path.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
    if (path.size() <= kShown) return "\"" + path + "\"";
    const std::size_t slash = path.find('/', path.size() - kShown);
    if (slash == std::string::npos) return quoted(baseName(path));
    return "\"..." + path.substr(slash) + "\"";
}

/// Keeps the elements with the greatest measure.
template <typename T, typename Measure>
void keepGreatest(std::vector<T>& all, Measure measure) {
    std::size_t most = 0;
    for (const T& one : all) most = std::max(most, measure(one));
    std::erase_if(all, [&](const T& one) { return measure(one) < most; });
}

}  // namespace

Locator::Locator(const Assets& assets, DocumentPlace main)
    : assets_(assets), main_(std::move(main)), bytesLeft_(kMaxCompared) {}

const std::vector<std::string>& Locator::list() {
    if (!paths_) paths_ = assets_.list();
    return *paths_;
}

Locator::Wanted Locator::parse(const std::string& path) {
    std::string plain = path;
    std::replace(plain.begin(), plain.end(), '\\', '/');
    constexpr std::string_view kScheme = "file://";
    if (sameWord(std::string_view(plain).substr(0, kScheme.size()), kScheme))
        plain.erase(0, kScheme.size());
    Wanted wanted;
    if (plain.empty() || plain.back() == '/') return wanted;  // a folder
    wanted.isAbsolute = plain.front() == '/';
    for (const std::string_view part : split(plain, "/")) {
        const bool isDrive = wanted.parts.empty() && part.size() == 2 && part[1] == ':';
        if (isDrive) wanted.isAbsolute = true;
        if (isDrive || part == ".") continue;
        if (part == ".." && !wanted.parts.empty() && wanted.parts.back() != "..")
            wanted.parts.pop_back();
        else
            wanted.parts.emplace_back(part);
    }
    const bool isName = !wanted.parts.empty() && wanted.parts.size() <= kMaxParts &&
                        isSafePath(wanted.parts.back());
    if (!isName) wanted.parts.clear();
    return wanted;
}

std::string Locator::folderOf(const Location& where) const {
    return parentOf(where.file.empty() || where.file == main_.name ? main_.path : where.file);
}

/// The path from that folder; nothing where it leads out of the assets.
std::optional<std::string> Locator::join(std::string_view folder, const Wanted& wanted) {
    std::vector<std::string_view> parts = split(folder, "/");
    for (const std::string& part : wanted.parts) {
        if (part != "..") {
            parts.push_back(part);
            continue;
        }
        if (parts.empty()) return std::nullopt;
        parts.pop_back();
    }
    std::string path = joined(parts, "/");
    if (!isSafePath(path)) return std::nullopt;
    return path;
}

const Locator::Index& Locator::index(Reading reading) {
    std::optional<Index>& made = indices_[static_cast<int>(reading)];
    if (made) return *made;
    made.emplace();
    const auto add = [&](std::size_t at, std::string key) {
        std::string name(baseName(key));
        (*made)[std::move(name)].push_back({at, std::move(key)});
    };
    for (std::size_t i = 0; i < list().size(); ++i) {
        const std::string& path = list()[i];
        if (reading == Reading::exact) add(i, path);
        if (reading == Reading::folded) add(i, spelling::folded(path));
        if (reading == Reading::codePage)
            for (const std::string& other : spelling::otherReadings(path))
                add(i, spelling::folded(other));
    }
    return *made;
}

bool Locator::haveEqualBytes(const std::string& a, const std::string& b) {
    if (assets_.version(a) == assets_.version(b)) return true;
    const auto size = assets_.size(a);
    if (!size || size != assets_.size(b)) return false;
    const std::string& first = digestOf(a);
    return !first.empty() && first == digestOf(b);
}

/// Returns a digest of the file, read once; empty for a file over bytesLeft_.
const std::string& Locator::digestOf(const std::string& path) {
    const auto [known, fresh] = digests_.try_emplace(path);
    const std::uint64_t size = assets_.size(path).value_or(0);
    if (!fresh || size > bytesLeft_) return known->second;
    bytesLeft_ -= size;
    if (const auto bytes = assets_.read(path)) known->second = contentDigest(*bytes);
    return known->second;
}

/// One path for all that have the same bytes: the first in the order of the list.
std::vector<std::string> Locator::distinct(std::vector<std::string> paths) {
    std::sort(paths.begin(), paths.end());
    paths.erase(std::unique(paths.begin(), paths.end()), paths.end());
    if (paths.size() < 2 || paths.size() > kMaxNamesakes) return paths;
    assets_.prefetch(paths);
    std::vector<std::string> kept;
    for (std::string& path : paths)
        if (std::none_of(kept.begin(), kept.end(),
                         [&](const std::string& one) { return haveEqualBytes(one, path); }))
            kept.push_back(std::move(path));
    return kept;
}

std::optional<Locator::Found> Locator::look(const Wanted& wanted, const std::string& folder,
                                            Reading reading, std::vector<std::string>& rivals) {
    const auto keyOf = [&](const std::string& path) {
        return reading == Reading::exact ? path : spelling::folded(path);
    };
    const std::vector<Named>* known = nullptr;
    const auto namesakes = [&]() -> const std::vector<Named>& {
        static const std::vector<Named> kNone;
        if (known == nullptr) {
            const Index& files = index(reading);
            const auto found = files.find(std::string(baseName(keyOf(wanted.parts.back()))));
            known = found == files.end() ? &kNone : &found->second;
        }
        return *known;
    };
    // 1 and 2: from the document's folder, then from each folder above.
    if (!wanted.isAbsolute) {
        for (std::string from = folder;; from = parentOf(from)) {
            const Step step = from == folder ? Step::document : Step::parent;
            const std::optional<std::string> path = join(from, wanted);
            if (path && reading == Reading::exact) {
                if (assets_.has(*path)) return Found{*path, step, reading};
            } else if (path) {
                std::vector<std::string> same;
                for (const Named& one : namesakes())
                    if (one.key == keyOf(*path)) same.push_back(list()[one.index]);
                same = distinct(std::move(same));
                if (same.size() == 1) return Found{same.front(), step, reading};
                if (!same.empty()) {
                    rivals = std::move(same);
                    return std::nullopt;
                }
            }
            if (from.empty()) break;
        }
    }
    // 3 and 4: the files that share the longest end with the written path; of these, those that
    // share the most folders with the document.
    if (namesakes().empty()) return std::nullopt;
    Wanted inside = wanted;
    std::erase(inside.parts, "..");
    const std::string key = keyOf(joined(inside.parts, "/"));
    const auto end = split(key, "/");
    std::vector<Named> matches = namesakes();
    const auto shared = [&](const Named& one) { return sharedTail(end, split(one.key, "/")); };
    keepGreatest(matches, shared);
    const Step step = shared(matches.front()) > 1 ? Step::suffix : Step::baseName;
    std::vector<std::string> paths;
    for (const Named& one : matches) paths.push_back(list()[one.index]);
    keepGreatest(paths, [&](const std::string& path) { return sharedHead(folder, path); });
    paths = distinct(std::move(paths));
    if (paths.size() == 1) return Found{paths.front(), step, reading};
    rivals = std::move(paths);
    return std::nullopt;
}

void Locator::report(const std::string& path, const Found& found, const Location& where,
                     Diagnostics& diagnostics) const {
    const auto add = [&](Severity severity, Message text) {
        diagnostics.push_back(diagnosticOf(severity, std::move(text), where));
    };
    const auto pathArgument = "path"_arg = path;
    const auto foundArgument = "found"_arg = uncut(found.path);
    if (found.reading == Reading::codePage) {
        add(Severity::info, message<"asset.code-page">(pathArgument, foundArgument));
    } else if (found.reading == Reading::folded) {
        const auto [mine, its] = firstDifference(path, found.path);
        if (spelling::percentDecoded(mine) != mine || spelling::percentDecoded(its) != its)
            add(Severity::info, message<"asset.percent">(pathArgument, foundArgument));
        else if (spelling::decomposed(mine) == spelling::decomposed(its))
            add(Severity::info, message<"asset.unicode">(pathArgument, foundArgument));
        else
            add(Severity::info, message<"asset.case">(pathArgument, foundArgument));
    }
    if (found.step == Step::parent)
        add(Severity::info, message<"asset.in-parent">(pathArgument, foundArgument));
    if (found.step == Step::suffix)
        add(Severity::warning, message<"asset.found-elsewhere/end">(pathArgument, foundArgument));
    if (found.step == Step::baseName)
        add(Severity::warning, message<"asset.found-elsewhere/name">(pathArgument, foundArgument));
}

std::optional<std::string> Locator::locate(const std::string& path, const Location& where,
                                           Diagnostics& diagnostics) {
    const Wanted wanted = parse(path);
    if (wanted.parts.empty()) return std::nullopt;
    const std::string folder = folderOf(where);
    for (const Reading reading : {Reading::exact, Reading::folded, Reading::codePage}) {
        std::vector<std::string> rivals;
        if (const auto found = look(wanted, folder, reading, rivals)) {
            report(path, *found, where, diagnostics);
            return found->path;
        }
        if (rivals.empty()) continue;
        const std::span<const std::string> some(rivals.data(),
                                                std::min(rivals.size(), kShownRivals));
        std::string names = joined(some, ", ", named);
        if (rivals.size() > kShownRivals) names += ", ...";
        diagnostics.push_back(diagnosticOf(
            Severity::warning,
            message<"asset.ambiguous">("path"_arg = path, "candidates"_arg = uncut(names)), where));
        return std::nullopt;
    }
    return std::nullopt;
}

bool Locator::leadsOut(const std::string& path, const Location& where) const {
    const Wanted wanted = parse(path);
    return !wanted.parts.empty() && (wanted.isAbsolute || !join(folderOf(where), wanted));
}

std::optional<Message> Locator::nearest(const std::string& path,
                                        std::vector<std::string> candidates) {
    // More names than this would cost more time than the hint is worth.
    constexpr std::size_t kMaxNames = 2'000;
    for (const std::string& listed : list()) {
        if (candidates.size() >= kMaxNames) break;
        candidates.emplace_back(baseName(listed));
    }
    const std::string near = didYouMean(std::string(baseName(path)), candidates);
    if (near.empty() || near == path) return std::nullopt;
    return message<"part.near-file">("name"_arg = uncut(near));
}

Message Locator::advice(const std::string& path, const Location& where,
                        std::vector<std::string> candidates) {
    if (leadsOut(path, where)) return message<"part.name-assets">();
    std::optional<Message> near;
    if (hintsLeft_-- > 0) near = nearest(path, std::move(candidates));
    return near ? std::move(*near) : message<"part.add-file">();
}

std::optional<std::string> locate(const Assets& assets, const std::string& path,
                                  const Location& where, Diagnostics& diagnostics,
                                  DocumentPlace main) {
    return Locator(assets, std::move(main)).locate(path, where, diagnostics);
}

}  // namespace farol::scene
