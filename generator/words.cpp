#include "generator/words.h"

#include <algorithm>

#include "generator/call.h"
#include "generator/sources.h"
#include "scene/words.h"

namespace farol::generator {
namespace {

using scene::sameWord;

constexpr std::size_t kMaxWords = 16;

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

bool isNumber(const std::string& word) {
    double value = 0;
    return parseNumber(word, value) || word == "auto";
}

std::vector<std::string> split(const std::string& text, const std::string& separators) {
    std::vector<std::string> words;
    for (std::size_t at = 0; at < text.size() && words.size() < kMaxWords;) {
        const std::size_t begin = text.find_first_not_of(separators, at);
        if (begin == std::string::npos) break;
        at = std::min(text.find_first_of(separators, begin), text.size());
        words.push_back(text.substr(begin, at - begin));
    }
    return words;
}

/// "box" of "box_2_3.3d": the name up to its first underscore, digit or dot.
std::string leadingWord(const std::string& fileName) {
    const std::string base = baseNameOf(fileName);
    return base.substr(0, base.find_first_of("_-.0123456789 "));
}

constexpr std::string_view kTeapot = "teapot";
constexpr const char* kTeapotFile = "teapot.patch";

bool isPatch(const std::string& word) {
    const Shape* shape = findShape(word);
    return shape != nullptr && shape->name == "patch";
}

bool isPatchFile(const std::string& word) {
    const std::size_t dot = word.rfind('.');
    return dot != std::string::npos && sameWord(word.substr(dot), ".patch");
}

/// Without its ending: of "sphere_1.5_8_8" the dot is a number's.
std::string withoutEnding(const std::string& name) {
    const std::size_t dot = name.rfind('.');
    if (dot == std::string::npos) return name;
    const std::string ending = name.substr(dot + 1);
    const bool fraction = ending.find_first_not_of("0123456789_") == std::string::npos;
    return fraction ? name : name.substr(0, dot);
}

/// "bezier_10", "teapot_10", "bezier_comet_10", "teapot_patch_10": numbers, and the name of a
/// file of patches, which is the teapot's where none is.
std::optional<std::vector<std::string>> patchOfName(const std::vector<std::string>& words) {
    std::vector<std::string> numbers;
    std::string file;
    for (const std::string& word : words) {
        if (isNumber(word))
            numbers.push_back(word);
        else if (isPatch(word))
            continue;
        else if (file.empty())
            file = sameWord(word, kTeapot) ? kTeapotFile : word + ".patch";
        else
            return std::nullopt;
    }
    std::vector<std::string> out = {"patch", file.empty() ? kTeapotFile : file};
    out.insert(out.end(), numbers.begin(), numbers.end());
    return out;
}

/// Counts first, then lengths: the order of some older generators.
std::optional<std::vector<std::string>> countsLast(const std::vector<std::string>& words,
                                                   const Shape& shape) {
    const auto counts =
        static_cast<std::ptrdiff_t>(std::count_if(shape.arguments.begin(), shape.arguments.end(),
                                                  [](const Argument& one) { return one.integer; }));
    const auto given = static_cast<std::ptrdiff_t>(words.size()) - 1;
    if (shape.takesFile || counts == 0 || given != std::ptrdiff_t(shape.arguments.size()))
        return std::nullopt;
    std::vector<std::string> turned = words;
    std::rotate(turned.begin() + 1, turned.begin() + 1 + counts, turned.end());
    try {
        parseCall(turned);
        return turned;
    } catch (const Error&) {
        return std::nullopt;  // the caller reports the order as written
    }
}

}  // namespace

std::vector<std::string> splitWords(const std::string& text) { return split(text, " \t\r\n,\"'"); }

std::optional<std::vector<std::string>> wordsOfName(const std::string& fileName) {
    const std::string base = baseNameOf(fileName);
    std::vector<std::string> words = split(withoutEnding(base), "_ ");
    if (words.empty() || (words.size() == 1 && words[0] == base)) return std::nullopt;
    if (sameWord(words[0], kTeapot) || isPatch(words[0])) return patchOfName(words);
    const Shape* shape = findShape(words[0]);
    if (shape == nullptr || shape->takesFile)  // a profile's name cannot stand in it
        return std::nullopt;
    for (std::size_t i = 1; i < words.size(); ++i)
        if (!isNumber(words[i])) return std::nullopt;
    return words;
}

std::vector<std::string> wordsOfComment(std::vector<std::string> words, const std::string& fileName,
                                        const Location& where, Diagnostics& diagnostics) {
    if (words.size() > 1 && sameWord(words[0], "generator")) words.erase(words.begin());
    if (!words.empty() && (sameWord(words[0], kTeapot) || isPatchFile(words[0])))
        words.insert(words.begin(), "patch");
    if (words.size() > 1 && isPatch(words[0]) && sameWord(words[1], kTeapot))
        words[1] = kTeapotFile;
    if (words.empty() || findShape(words[0]) == nullptr) {
        const std::string named = leadingWord(fileName);
        // A word that is no number is a shape's name that does not exist: let it be reported.
        if ((words.empty() || isNumber(words[0])) && findShape(named) != nullptr)
            words.insert(words.begin(), named);
    }
    const Shape* shape = words.empty() ? nullptr : findShape(words[0]);
    if (shape != nullptr && shape->takesFile) {
        const auto file = std::find_if_not(words.begin() + 1, words.end(), isNumber);
        if (file == words.end() && shape->name == "patch")
            words.insert(words.begin() + 1, kTeapotFile);
        else if (file != words.end())
            std::rotate(words.begin() + 1, file, file + 1);
    }
    try {
        parseCall(words);
    } catch (const Error&) {
        const auto turned = shape != nullptr ? countsLast(words, *shape) : std::nullopt;
        if (!turned) throw;
        diagnostics.push_back({Severity::warning, "shape.order", where,
                               "\"" + joined(words) + "\" gives counts before lengths: read as \"" +
                                   joined(*turned) + "\"",
                               ""});
        return *turned;
    }
    return words;
}

}  // namespace farol::generator
