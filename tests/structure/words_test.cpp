// The words that docs/reference/style.md bans, in comments and string literals of the sources.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <regex>

#include "tests/support/paths.h"

namespace fs = std::filesystem;

namespace {

/// Files that list or quote the words.
constexpr const char* kLists[] = {"tests/messages/messages_test.cpp",
                                  "tests/structure/words_test.cpp"};

/// The comment of a line without its quotations, and its string literals of several words: one word
/// is a key or a name.
struct Prose {
    std::string comment, literals;
};

Prose proseOf(const std::string& line) {
    static const std::regex kLiteral("\"((?:[^\"\\\\]|\\\\.)*)\""), kQuoted("\"[^\"]*\"|`[^`]*`");
    Prose prose;
    std::string code = line;
    const auto quotesBefore = [&](std::size_t end) {
        return std::count(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(end), '"');
    };
    std::size_t slashes = line.find("//");
    while (slashes != std::string::npos && quotesBefore(slashes) % 2 != 0)
        slashes = line.find("//", slashes + 2);  // within a literal
    if (slashes != std::string::npos) {
        code = line.substr(0, slashes);
        prose.comment = std::regex_replace(line.substr(slashes), kQuoted, "");
    }
    if (code.starts_with("#include")) return prose;
    for (std::sregex_iterator at(code.begin(), code.end(), kLiteral), end; at != end; ++at)
        if ((*at)[1].str().find(' ') != std::string::npos) prose.literals += " " + (*at)[1].str();
    return prose;
}

/// The first banned word of a line; "" where there is none.
std::string bannedIn(const std::string& line) {
    static const std::regex kBanned(
        "(^|[^-.\\w])(told|said|says of|mend(s|ed|ing)?|cures?|lends?|lent|(is|are) taken|cannot "
        "be "
        "had|of "
        "(its|their) own|by hand of|aloud|hold to|the likes|so that it)\\b",
        std::regex::icase);
    const Prose prose = proseOf(line);
    std::smatch match;
    for (const std::string& text : {prose.comment, prose.literals})
        if (std::regex_search(text, match, kBanned)) return match.str(2);
    return "";
}

/// Whether a comment line begins with a clause whose subject is "what" or "who".
bool beginsWithWhat(const std::string& line) {
    static const std::regex kWhat("//+[!<]*\\s*(what|who|whoever|whatever)\\b", std::regex::icase);
    return std::regex_search(line, kWhat);
}

}  // namespace

TEST_CASE("comments and literals have no banned word, and few begin with \"what\"") {
    for (const char* folder : {"bench", "cli", "core", "generator", "grade", "image", "interchange",
                               "render", "scene", "server", "tests", "worker"}) {
        int comments = 0, whats = 0;
        for (const auto& entry :
             fs::recursive_directory_iterator(fs::path(farol::test::kSourceDir) / folder)) {
            const std::string ending = entry.path().extension().string();
            if (ending != ".cpp" && ending != ".h") continue;
            const std::string name =
                fs::relative(entry.path(), farol::test::kSourceDir).generic_string();
            const auto isPrefix = [&](const char* prefix) { return name.starts_with(prefix); };
            if (std::any_of(std::begin(kLists), std::end(kLists), isPrefix)) continue;
            std::ifstream in(entry.path());
            int number = 0;
            for (std::string line; std::getline(in, line);) {
                ++number;
                comments += line.find("//") != std::string::npos ? 1 : 0;
                whats += beginsWithWhat(line) ? 1 : 0;
                INFO(name << ":" << number << ": " << line);
                if (bannedIn(line) != "") CHECK(bannedIn(line) == "");
            }
        }
        INFO(folder << ": " << whats << " of " << comments);
        CHECK(50 * whats <= comments);  // at most 2 %
    }
}

TEST_CASE("the check of words finds them outside quotations alone") {
    CHECK(bannedIn("// It is told here.") == "told");
    CHECK(bannedIn("log(\"is taken\");") == "is taken");
    CHECK(bannedIn("// The word \"told\" is banned, and so is `lent`.").empty());
    CHECK(bannedIn("#include \"worker/worker.h\"").empty());
    CHECK(bannedIn("codes.insert(\"grade.lent\");").empty());
    CHECK(bannedIn("url = \"http://a\";  // of its own") == "of its own");
    CHECK(beginsWithWhat("    /// What a worker keeps."));
    CHECK_FALSE(beginsWithWhat("// Somewhat else."));
}
