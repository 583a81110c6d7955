// A test that cannot run ends with the code that ctest counts as skipped, and never as passed.
#include <sys/wait.h>

#include <array>
#include <catch2/catch.hpp>
#include <cstdio>
#include <string>

namespace {

struct Outcome {
    int code = -1;
    std::string text;
};

/// Runs cases of the program of planted skips.
Outcome run(const std::string& environment, const std::string& cases) {
    const std::string command =
        "env " + environment + " '" FAROL_PLANTED_SKIPS "' " + cases + " 2>&1";
    FILE* pipe = popen(command.c_str(), "r");
    REQUIRE(pipe != nullptr);
    Outcome outcome;
    std::array<char, 4096> block{};
    for (std::size_t n = 0; (n = fread(block.data(), 1, block.size(), pipe)) > 0;)
        outcome.text.append(block.data(), n);
    outcome.code = WEXITSTATUS(pclose(pipe));
    return outcome;
}

}  // namespace

TEST_CASE("a test without its data is skipped, under CI too") {
    for (const char* environment : {"-u CI", "CI=true"}) {
        const Outcome outcome = run(environment, "'without data'");
        INFO(outcome.text);
        CHECK(outcome.code == 77);
        CHECK(outcome.text.find("SKIPPED: no data\n") != std::string::npos);
    }
}

TEST_CASE("a test without its tool is skipped, and fails under CI") {
    CHECK(run("-u CI", "'without a tool'").code == 77);
    const Outcome outcome = run("CI=true", "'without a tool'");
    INFO(outcome.text);
    CHECK(outcome.code == 1);
    CHECK(outcome.text.find("SKIPPED") == std::string::npos);
}

TEST_CASE("a failure before a skip is a failure, and a skip beside passed tests hides nothing") {
    CHECK(run("-u CI", "'fails before it is skipped'").code == 1);
    CHECK(run("-u CI", "'without data',runs").code == 0);
    CHECK(run("-u CI", "'without data','without a tool'").code == 77);
    CHECK(run("-u CI", "runs").code == 0);
}
