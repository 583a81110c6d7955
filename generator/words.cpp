#include "generator/words.h"

#include <algorithm>
#include <iterator>

#include "core/text.h"
#include "generator/messages.h"
#include "generator/registry.h"

namespace farol::generator {
namespace {

constexpr std::ptrdiff_t kMaxWords = 16;
constexpr std::string_view kSeparators = " \t\r\n,\"'";

bool isNumber(const std::string& word) {
    double value = 0;
    return parseNumber(word, value) || word == "auto";
}

std::vector<std::string> split(const std::string& text, std::string_view separators) {
    const auto words = farol::split(text, separators);
    return {words.begin(), words.begin() + std::min<std::ptrdiff_t>(kMaxWords, std::ssize(words))};
}

/// "box" of "box_2_3.3d": the name up to its first underscore, digit or dot.
std::string leadingWord(const std::string& fileName) {
    const std::string base(baseName(fileName));
    return base.substr(0, base.find_first_of("_-.0123456789 "));
}

/// "teapot" of "teapot.patch".
std::string_view stemOf(std::string_view fileName) {
    return fileName.substr(0, std::min(fileName.rfind('.'), fileName.size()));
}

/// The shape whose built-in file the word means by its stem: "teapot" is patch.
const ShapeEntry* shapeOfBuiltin(const std::string& word) {
    for (const ShapeEntry& shape : shapes())
        if (!shape.builtinFile.empty() && sameWord(word, stemOf(shape.builtinFile))) return &shape;
    return nullptr;
}

/// Without its ending: of "sphere_1.5_8_8" the dot is a number's.
std::string withoutEnding(const std::string& name) {
    const std::size_t dot = name.rfind('.');
    if (dot == std::string::npos) return name;
    const std::string ending = name.substr(dot + 1);
    const bool fraction = ending.find_first_not_of("0123456789_") == std::string::npos;
    return fraction ? name : name.substr(0, dot);
}

/// Parses "bezier_10", "teapot_10", "bezier_comet_10", "teapot_patch_10": numbers, and the name of
/// a patch file, by default the built-in one.
std::optional<std::vector<std::string>> fileShapeOfName(const ShapeEntry& shape,
                                                        const std::vector<std::string>& words) {
    std::vector<std::string> numbers;
    std::string file;
    for (const std::string& word : words) {
        if (isNumber(word))
            numbers.push_back(word);
        else if (findShape(word) == &shape)
            continue;
        else if (file.empty())
            file = shapeOfBuiltin(word) == &shape ? shape.builtinFile : word + shape.fileEnding;
        else
            return std::nullopt;
    }
    std::vector<std::string> out = {shape.name, file.empty() ? shape.builtinFile : file};
    out.insert(out.end(), numbers.begin(), numbers.end());
    return out;
}

/// Parses counts first, then lengths: the order of some older generators.
std::optional<ShapeCall> parseCountsFirst(const std::vector<std::string>& words,
                                          const ShapeEntry& shape, std::vector<Message>& notes) {
    const auto counts =
        std::count_if(shape.arguments.begin(), shape.arguments.end(),
                      [](const Argument& argument) { return argument.isInteger(); });
    if (shape.takesFile || counts == 0 || words.size() - 1 != shape.arguments.size())
        return std::nullopt;
    std::vector<std::string> turned = words;
    std::rotate(turned.begin() + 1, turned.begin() + 1 + counts, turned.end());
    try {
        return parseCall(turned, &notes);
    } catch (const Error&) {
        return std::nullopt;  // the caller reports the order as written
    }
}

/// Normalises a file's name for splitting into words: removes its ending and the suffixes of copies
/// ("box_2 (1).3d", "box_2 - Copia.3d", "box_2.3d.3d"), and puts "_" for the marks in
/// "sphere-1-16-8" and "sphere(1,16,8)".
std::string plainName(std::string_view base) {
    std::string name(withoutEnding(std::string(base)));
    if (fileEnding(name) == "3d") name.resize(name.size() - 3);
    for (const std::string_view mark : {" - cop", " - c\xC3\xB3p"})
        if (const std::size_t copy = lowerCase(name).find(mark); copy != std::string::npos)
            name.resize(copy);
    const std::size_t open = name.find('(');
    const bool isCall = open != std::string::npos && open > 0 && name.back() == ')';
    if (isCall && name[open - 1] == ' ') {
        name.resize(open - 1);
    } else if (isCall) {
        name.pop_back();
        std::replace_if(
            name.begin(), name.end(), [](char c) { return c == '(' || c == ','; }, '_');
    }
    for (std::size_t i = 1; i + 1 < name.size(); ++i)
        if (name[i] == '-' && isAlphanumeric(name[i - 1]) && isDigit(name[i + 1]) &&
            !(i > 1 && name[i - 1] == 'e' && isDigit(name[i - 2])))
            name[i] = '_';
    return name;
}

}  // namespace

std::vector<std::string> splitWords(const std::string& text) { return split(text, kSeparators); }

bool isOneWord(const std::string& text) {
    return !text.empty() && text.find_first_of(kSeparators) == std::string::npos;
}

std::optional<std::vector<std::string>> wordsOfName(const std::string& fileName) {
    const std::string base(baseName(fileName));
    std::vector<std::string> words = split(plainName(base), "_ ");
    if (words.empty() || (words.size() == 1 && words[0] == base)) return std::nullopt;
    const ShapeEntry* builtin = shapeOfBuiltin(words[0]);
    const ShapeEntry* shape = builtin != nullptr ? builtin : findShape(words[0]);
    if (shape == nullptr) return std::nullopt;
    if (!shape->builtinFile.empty()) return fileShapeOfName(*shape, words);
    if (shape->takesFile) return std::nullopt;  // a profile's name cannot stand in it
    for (std::size_t i = 1; i < words.size(); ++i)
        if (!isNumber(words[i])) return std::nullopt;
    return words;
}

const ShapeEntry* shapeOfFile(const std::string& fileName) {
    const std::string ending = "." + fileEnding(fileName);
    for (const ShapeEntry& shape : shapes())
        if (shape.fileEnding == ending) return &shape;
    return nullptr;
}

ShapeCall parseComment(std::vector<std::string> words, const std::string& fileName,
                       const Location& where, Diagnostics& diagnostics) {
    if (words.size() > 1 && sameWord(words[0], "generator")) words.erase(words.begin());
    if (!words.empty()) {
        const ShapeEntry* builtin = shapeOfBuiltin(words[0]);
        const ShapeEntry* meant = builtin != nullptr ? builtin : shapeOfFile(words[0]);
        if (meant != nullptr) words.insert(words.begin(), meant->name);
    }
    if (words.empty() || findShape(words[0]) == nullptr) {
        const std::string named = leadingWord(fileName);
        // Any other word is an unknown shape's name: parsing reports it.
        if ((words.empty() || isNumber(words[0])) && findShape(named) != nullptr)
            words.insert(words.begin(), named);
    }
    const ShapeEntry* shape = words.empty() ? nullptr : findShape(words[0]);
    if (shape != nullptr && shape->takesFile) {
        if (words.size() > 1 && shapeOfBuiltin(words[1]) == shape) words[1] = shape->builtinFile;
        const auto file = std::find_if_not(words.begin() + 1, words.end(), isNumber);
        if (file != words.end())
            std::rotate(words.begin() + 1, file, file + 1);
        else if (!shape->builtinFile.empty())
            words.insert(words.begin() + 1, shape->builtinFile);
    }
    const auto report = [&](std::vector<Message>& notes) {
        for (Message& note : notes)
            diagnostics.push_back(diagnosticOf(Severity::warning, std::move(note), where));
    };
    std::vector<Message> notes;
    try {
        const ShapeCall call = parseCall(words, &notes);
        report(notes);
        return call;
    } catch (const Error&) {
        notes.clear();
        auto turned = shape != nullptr ? parseCountsFirst(words, *shape, notes) : std::nullopt;
        if (!turned) throw;
        report(notes);
        diagnostics.push_back(diagnosticOf(
            Severity::warning,
            message<"shape.order">("call"_arg = joined(words, " "), "used"_arg = textOf(*turned)),
            where));
        return *turned;
    }
}

}  // namespace farol::generator
