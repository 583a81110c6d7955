// Diagnostics are made from the message catalogue alone (docs/how-to/contributor-extend.md, "A
// message").
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <regex>

#include "tests/support/paths.h"

namespace fs = std::filesystem;

namespace {

/// Folders whose messages are not rows of a table yet, and the constructor that they use.
constexpr const char* kNotConverted[] = {"core/error.h", "grade/"};

std::string readFile(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// The first text that makes a diagnostic without a row; "" where there is none.
std::string handmade(const std::string& source) {
    static const std::regex kHandmade(
        "\\b(Error|Busy|UsageError|OutputError)\\(\\s*(\"|std::string\\(|code,)"
        "|\\b(info|warn|error|fail)\\(\\s*\"[a-z]+[.\"]"
        "|\\{\\s*Severity::[a-z]+,\\s*(\"|code|std::move)");
    std::smatch match;
    return std::regex_search(source, match, kHandmade) ? match.str() : "";
}

}  // namespace

TEST_CASE("no diagnostic is made outside the message catalogue") {
    int files = 0;
    for (const char* floor : {"core", "image", "scene", "generator", "render", "interchange",
                              "grade", "worker", "server", "cli"})
        for (const auto& entry :
             fs::recursive_directory_iterator(fs::path(farol::test::kSourceDir) / floor)) {
            const std::string ending = entry.path().extension().string();
            if (ending != ".cpp" && ending != ".h") continue;
            const std::string name =
                fs::relative(entry.path(), farol::test::kSourceDir).generic_string();
            if (std::any_of(std::begin(kNotConverted), std::end(kNotConverted),
                            [&](const char* prefix) { return name.starts_with(prefix); }))
                continue;
            ++files;
            INFO(name);
            CHECK(handmade(readFile(entry.path())) == "");
        }
    CHECK(files > 100);
}

TEST_CASE("each table of messages is in the list of all tables") {
    const fs::path root = farol::test::kSourceDir;
    const std::string list = readFile(root / "cli" / "message_tables.h");
    static const std::regex kTable("constexpr MessageRow (k[A-Za-z0-9]+)\\[\\]");
    int tables = 0;
    for (const char* floor : {"core", "image", "scene", "generator", "render", "interchange",
                              "grade", "worker", "server", "cli"})
        for (const auto& entry : fs::recursive_directory_iterator(root / floor)) {
            if (entry.path().extension() != ".h") continue;
            const std::string source = readFile(entry.path());
            for (std::sregex_iterator at(source.begin(), source.end(), kTable), end; at != end;
                 ++at) {
                INFO(entry.path());
                CHECK(list.find((*at)[1].str()) != std::string::npos);
                ++tables;
            }
        }
    CHECK(tables >= 6);
}

TEST_CASE("the check of sources finds handmade diagnostics") {
    for (const char* wrong :
         {"throw Error(\"a.b\", text)", "Error(code, text)", "findings.warn(\n  \"xml.x\", at)",
          "{Severity::info, \"a.b\"", "throw Busy(\"busy.queue\", \"x\", 1)", "UsageError(\"x\")"})
        CHECK(handmade(wrong) != "");
    for (const char* right :
         {"throw Error(message<\"a.b\">(), where)", "report.fail(message<\"x\">())",
          "diagnosticOf(Severity::info, message<\"x\">())"})
        CHECK(handmade(right) == "");
}
