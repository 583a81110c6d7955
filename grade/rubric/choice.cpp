#include "grade/rubric/choice.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <limits>
#include <set>

#include "core/text.h"
#include "grade/messages.h"
#include "scene/files/bundle.h"
#include "scene/files/spelling.h"

namespace farol::grade {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxRead = std::size_t{1} << 20U;  // of one document, to look into it
constexpr std::size_t kMaxLookedInto = 200;
constexpr std::size_t kMaxNamedFiles = 1000;

/// Splits a name into words of lower-case letters without accents, and numbers without zeros ahead.
std::vector<std::string> wordsOf(std::string_view name) {
    const std::string plain = scene::spelling::decomposed(nameToUtf8(name));
    std::vector<std::string> words;
    bool isOpen = false, wasLower = false;
    for (const char c : plain) {
        if (static_cast<unsigned char>(c) >= 0x80) continue;  // an accent
        if (!isAlphanumeric(c)) {
            isOpen = false;
            continue;
        }
        const bool isCapital = c >= 'A' && c <= 'Z';
        if (!isOpen || isDigit(c) != isDigit(words.back().back()) || (isCapital && wasLower))
            words.emplace_back();
        isOpen = true;
        wasLower = c >= 'a' && c <= 'z';
        words.back() += lowerCase(c);
    }
    for (std::string& word : words)  // "04" is 4
        if (isDigit(word[0])) word.erase(0, std::min(word.find_first_not_of('0'), word.size() - 1));
    return words;
}

bool isNumber(const std::string& word) { return isDigit(word[0]); }

/// Returns one synonym for all words of one meaning in names of tasks.
std::string meaningOf(const std::string& word) {
    static constexpr std::pair<std::string_view, std::string_view> kSame[] = {
        {"teste", "test"},     {"testes", "test"}, {"tests", "test"},     {"t", "test"},
        {"fase", "phase"},     {"f", "phase"},     {"etapa", "phase"},    {"stage", "phase"},
        {"p", "phase"},        {"cena", "scene"},  {"exercicio", "task"}, {"exercise", "task"},
        {"ex", "task"},        {"tarefa", "task"}, {"sistema", "system"}, {"casa", "house"},
        {"versao", "version"}, {"v", "version"},   {"ver", "version"}};
    for (const auto& [from, to] : kSame)
        if (word == from) return std::string(to);
    return word;
}

/// True for generic words: no task is named by them alone.
bool isFiller(const std::string& word) {
    static const std::set<std::string> kFillers{"test", "phase", "task", "scene", "xml"};
    return kFillers.count(word) != 0;
}

struct Name {
    std::vector<std::string> numbers, words;
};

Name nameOf(std::string_view text) {
    Name name;
    for (const std::string& word : wordsOf(text))
        (isNumber(word) ? name.numbers : name.words).push_back(meaningOf(word));
    return name;
}

/// Returns how well a name matches the task: 0 not at all, 1 with further words, 2 exactly.
int likeness(std::string_view text, std::string_view task) {
    const Name name = nameOf(text), meant = nameOf(task);
    if (meant.words.empty() && meant.numbers.empty()) return lowerCase(text) == lowerCase(task);
    // The task's numbers come first; later numbers count attempts.
    if (name.numbers.size() < meant.numbers.size() ||
        !std::equal(meant.numbers.begin(), meant.numbers.end(), name.numbers.begin()))
        return 0;
    for (const std::string& word : meant.words) {
        if (isFiller(word) && !meant.numbers.empty()) continue;  // "fase 4" and "teste 4"
        if (std::find(name.words.begin(), name.words.end(), word) == name.words.end()) return 0;
    }
    return name.words == meant.words && name.numbers == meant.numbers ? 2 : 1;
}

std::string stemOf(const std::string& path) { return fs::path(path).stem().string(); }
std::string folderOf(const std::string& path) {
    return fs::path(path).parent_path().filename().string();
}

int likenessOf(const std::string& path, const std::string& task) {
    return std::max(likeness(stemOf(path), task), likeness(folderOf(path), task));
}

/// Returns the last number of a name, its version or copy: "house (2)", "phase 4", "v3"; 0: none.
int versionOf(const std::string& text) {
    const std::vector<std::string> words = wordsOf(text);
    int version = 0;
    for (std::size_t i = 0; i < words.size(); ++i)
        if (isNumber(words[i]) && words[i].size() < 9) version = std::stoi(words[i]);
    return version;
}

/// Returns 1 for the name of a final version, -1 for that of an old or temporary one, else 0.
int stateOf(const std::string& text) {
    static const std::set<std::string> kLast{"final",  "finais",    "last", "ultimo",
                                             "ultima", "newest",    "new",  "novo",
                                             "nova",   "corrigido", "fixed"},
        kAside{"old",   "antigo",   "antiga",    "velho",   "backup", "bak", "copy",  "copia",
               "draft", "rascunho", "tentativa", "attempt", "temp",   "tmp", "antes", "wip"};
    int state = 0;
    for (const std::string& word : wordsOf(text)) {
        if (kAside.count(word) != 0) return -1;
        if (kLast.count(word) != 0) state = 1;
    }
    return state;
}

/// A candidate document, with its evidence.
struct Candidate {
    std::string path;
    int likeness = 0;
    bool isScene = false;
    long named = 0;  ///< of the reference's files
    std::size_t content = 0;
};

/// Keeps the candidates of the largest value; true if it removed some.
bool keepMost(std::vector<Candidate>& candidates, const std::function<long(const Candidate&)>& of) {
    long most = std::numeric_limits<long>::min();
    for (const Candidate& one : candidates) most = std::max(most, of(one));
    return std::erase_if(candidates, [&](const Candidate& one) { return of(one) < most; }) != 0;
}

void lookInto(Candidate& candidate, const scene::Assets& files, const Wanted& wanted) {
    if (files.size(candidate.path).value_or(0) > kMaxRead) {
        candidate.isScene = true;
        return;
    }
    const std::string text = files.read(candidate.path).value_or("");
    candidate.isScene = scene::beginsAsScene(text);
    candidate.content = std::hash<std::string>{}(text);
    const std::vector<std::string> named = filesNamedIn(text);
    const std::set<std::string> theirs(named.begin(), named.end());
    for (const std::string& file : wanted.files) candidate.named += theirs.count(file) != 0 ? 1 : 0;
}

}  // namespace

std::vector<std::string> filesNamedIn(std::string_view document) {
    std::set<std::string> names;
    for (std::size_t at = 0; names.size() < kMaxNamedFiles;) {
        const std::size_t begin = document.find_first_of("\"'", at);
        if (begin == std::string_view::npos) break;
        const std::size_t end = document.find(document[begin], begin + 1);
        if (end == std::string_view::npos) break;
        at = end + 1;
        const std::string_view value = document.substr(begin + 1, end - begin - 1);
        if (value.size() > 1024) {  // between two values
            at = begin + 1;
            continue;
        }
        const std::string ending = fileEnding(value);
        const bool isFile =
            ending.size() >= 2 && ending.size() <= 5 &&
            std::all_of(ending.begin(), ending.end(), isAlphanumeric) &&
            std::any_of(ending.begin(), ending.end(), [](char c) { return !isDigit(c); });
        if (isFile) names.insert(lowerCase(nameToUtf8(baseName(value))));
    }
    return {names.begin(), names.end()};
}

bool isNamedLike(std::string_view name, std::string_view task) { return likeness(name, task) > 0; }

Choice chooseDocument(const scene::Assets& files, std::vector<std::string> documents,
                      const Wanted& wanted, const std::string& where) {
    if (documents.empty()) return {};
    const std::size_t count = documents.size();
    Message reason;
    std::vector<Candidate> left;
    for (const std::string& path : documents) {
        const bool isOther =
            std::any_of(wanted.others.begin(), wanted.others.end(), [&](const std::string& other) {
                return likenessOf(path, other) > likenessOf(path, wanted.task);
            });
        if (!isOther) left.push_back({path, likenessOf(path, wanted.task)});
    }
    if (wanted.task.empty() && count == 1) return {documents.front(), {}};
    const std::size_t looked = std::min(left.size(), kMaxLookedInto);
    files.prefetch(documents);
    for (std::size_t i = 0; i < looked; ++i) lookInto(left[i], files, wanted);
    const auto isDecided = [&](bool hasLeftOut, const Message& why) {
        if (hasLeftOut) reason = why;
        return left.size() == 1;
    };
    const auto decide = [&]() -> bool {
        const auto likest = [](const Candidate& one) { return long{one.likeness}; };
        if (!wanted.task.empty()) {
            const bool isNamed = std::any_of(left.begin(), left.end(), likest);
            if (isNamed && isDecided(keepMost(left, likest), message<"part.chosen/name">()))
                return true;
            // If no name matches, documents that name half of the task's files are chosen.
            if (!isNamed &&
                std::erase_if(left,
                              [&](const Candidate& one) {
                                  return one.named == 0 ||
                                         2 * one.named < static_cast<long>(wanted.files.size());
                              }) != 0 &&
                isDecided(true, message<"part.chosen/files">()))
                return true;
            if (left.empty()) return true;
        }
        if (isDecided(keepMost(left, [](const Candidate& one) { return long{one.isScene}; }),
                      message<"part.chosen/scene">()))
            return true;
        long most = 0;
        for (const Candidate& one : left) most = std::max(most, one.named);
        if (isDecided(std::erase_if(
                          left, [&](const Candidate& one) { return 2 * one.named < most; }) != 0,
                      message<"part.chosen/files">()))
            return true;
        if (isDecided(keepMost(left,
                               [](const Candidate& one) {
                                   return long{lowerCase(stemOf(one.path)) == "scene"};
                               }),
                      message<"part.chosen/usual">()))
            return true;
        if (isDecided(keepMost(left,
                               [](const Candidate& one) {
                                   const std::string folder = folderOf(one.path);
                                   return long{!folder.empty() &&
                                               likeness(stemOf(one.path), folder) == 2};
                               }),
                      message<"part.chosen/folder">()))
            return true;
        // Names that differ in their numbers alone are versions of one document.
        const auto isFamily = [&] {
            const std::vector<std::string> first = nameOf(left.front().path).words;
            return std::all_of(left.begin(), left.end(), [&](const Candidate& one) {
                return nameOf(one.path).words == first;
            });
        };
        const auto newest = [](const Candidate& one) {
            return long{versionOf(fs::path(one.path).replace_extension().string())};
        };
        if (isDecided(keepMost(left, [](const Candidate& one) { return long{stateOf(one.path)}; }),
                      message<"part.chosen/newest">()) ||
            (isFamily() && isDecided(keepMost(left, newest), message<"part.chosen/newest">())))
            return true;
        if (isDecided(keepMost(left, [](const Candidate& one) { return one.named; }),
                      message<"part.chosen/files">()))
            return true;
        return isDecided(
            keepMost(left,
                     [](const Candidate& one) {
                         return -long{std::count(one.path.begin(), one.path.end(), '/')};
                     }),
            message<"part.chosen/highest">());
    };
    const bool isOne = decide();
    if (left.empty()) return {};
    const bool isSame = std::all_of(left.begin(), left.end(), [&](const Candidate& one) {
        return one.content != 0 && one.content == left.front().content;
    });
    if (!isOne && !isSame) {
        std::vector<std::string> names;
        for (const Candidate& one : left) names.push_back(nameToUtf8(one.path));
        throw Error(message<"grade.which-scene">("count"_arg = count,
                                                 "names"_arg = uncut(joined(names, ", "))),
                    {where, 0, 0});
    }
    return {left.front().path, count > 1 ? reason : Message{}};
}

}  // namespace farol::grade
