#include <catch2/catch.hpp>
#include <sstream>

#include "tests/cli/run.h"

using namespace farol::test;

TEST_CASE("completions offer each subcommand, its flags and the words of a choice") {
    freshFolder();
    const Outcome bash = run("completion bash");
    REQUIRE(bash.status == 0);
    writeFile("completion.bash", bash.out);
    writeFile("ask.bash", R"(source ./completion.bash
offer() { COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _farol; echo "${COMPREPLY[*]}"; }
offer farol va
offer farol render --form
offer farol render --format j
offer farol serve --isolate ''
)");
    const Outcome offered = run("version >ignored && bash ask.bash");
    CHECK(offered.out == "validate\n--format\njpeg\nnone uploads\n");
    CHECK(offered.err.empty());
    for (const char* shell : {"zsh", "fish"}) {
        const Outcome other = run(std::string("completion ") + shell);
        CHECK(other.status == 0);
        CHECK_THAT(other.out, Catch::Contains("validate") && Catch::Contains("isolate"));
    }
    CHECK(run("completion tcsh").status == 2);
}

TEST_CASE("each subcommand of the help has a man page") {
    freshFolder();
    std::istringstream names(run("man --list").out);
    const std::string help = run("--help").out, program = run("man").out;
    int count = 0;
    for (std::string name; std::getline(names, name); ++count) {
        INFO(name);
        CHECK_THAT(help, Catch::Contains("\n  " + name + " "));
        CHECK_THAT(program, Catch::Contains("farol\\-" + name));
        const Outcome page = run("man " + name);
        CHECK(page.status == 0);
        CHECK_THAT(page.out, Catch::StartsWith(".TH FAROL-"));
        CHECK_THAT(page.out, Catch::Contains("\n.SH NAME\nfarol-" + name + " \\- "));
    }
    CHECK(count >= 8);
    CHECK(run("man nothing").status == 2);
}
