// Some supervisors start programs with standard descriptors closed: no file may get their numbers.
#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <cstdlib>

#include "run.h"
#include "tests/support/paths.h"

using namespace farol::test;

namespace {

/// Runs the program with the descriptors closed ("<&- >&- 2>&-"); returns its exit code.
int runWith(const std::string& closed, const std::string& arguments) {
    const std::string command = "cd '" + folder().string() + "' && exec '" + farol::test::kProgram +
                                "' " + arguments + " " + closed;
    const int result = std::system(command.c_str());
    return WIFEXITED(result) ? WEXITSTATUS(result) : 128 + WTERMSIG(result);
}

}  // namespace

TEST_CASE("files are the same with standard descriptors closed") {
    freshFolder();
    // Its warning must not end up in the picture.
    std::string scene = kScene;
    scene.insert(scene.find("<camera>"), "<unknown/>");
    writeFile("scene.xml", scene);
    REQUIRE(run("render scene.xml -o expected.png").status == 0);
    REQUIRE(run("generate box 2 1 expected.obj").status == 0);
    for (const char* const closed : {"<&-", "2>&-", "<&- 2>&-", "<&- >&- 2>&-"}) {
        INFO(closed);
        CHECK(runWith(closed, "render scene.xml -o p.png") == 0);
        CHECK(readFile("p.png") == readFile("expected.png"));
        CHECK(runWith(closed, "generate box 2 1 p.obj") == 0);
        CHECK(readFile("p.obj") == readFile("expected.obj"));
        CHECK(runWith(closed, "validate scene.xml") == 0);
        CHECK(runWith(closed, "compare p.png expected.png") == 0);
        CHECK(runWith(closed, "version") == 0);
        CHECK(runWith(closed, "render missing.xml -o p.png") == 1);
    }
}

TEST_CASE("a result that cannot be written to a closed stdout is a failure") {
    freshFolder();
    writeFile("scene.xml", kScene);
    for (const char* const closed : {">&-", "<&- >&-", "<&- >&- 2>&-"}) {
        INFO(closed);
        CHECK(runWith(closed, "generate box 2 1 -") == 3);
        CHECK(runWith(closed, "render scene.xml -o -") == 3);
    }
}
