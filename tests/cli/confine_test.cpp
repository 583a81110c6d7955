// The command line reads files in a closed-in child process: its crash, its limits, its outputs.
#include <signal.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "run.h"
#include "running.h"
#include "tests/support/paths.h"
#include "tests/support/skip.h"

namespace {

using namespace farol::test;
using namespace std::chrono_literals;

// Takes seconds, so that the signal arrives before the end.
const std::vector<std::string> kLongRender = {"render", "scene.xml", "-o", "picture.png", "--width",
                                              "4096",   "--aa",      "16", "--height",    "4096"};

std::vector<std::string> with(std::vector<std::string> words, const std::string& more) {
    words.push_back(more);
    return words;
}

}  // namespace

TEST_CASE("a crash in the process that reads the files is reported, and leaves no output") {
    freshFolder();
    writeFile("scene.xml", kScene);
    {
        Running farol(kLongRender);
        const pid_t child = farol.confined();
        CHECK_THAT(Running::statusOf(child), Catch::Contains("NoNewPrivs:\t1"));
        kill(child, SIGABRT);  // sanitizers handle SIGSEGV themselves
        CHECK(farol.end() == 3);
        CHECK_THAT(readFile("stderr"),
                   Catch::Contains("crashed by signal 6") && Catch::Contains("[worker.crashed]"));
        CHECK(leftFiles().empty());
    }
    {
        Running farol(with(kLongRender, "--json"));
        kill(farol.confined(), SIGABRT);
        CHECK(farol.end() == 3);
        const auto report = nlohmann::json::parse(readFile("stdout"));
        CHECK(report["status"] == 3);
        CHECK(report["diagnostics"][0]["code"] == "worker.crashed");
        CHECK(leftFiles().empty());
    }
    {
        Running farol(kLongRender);
        kill(farol.confined(), SIGKILL);
        CHECK(farol.end() == 3);
        CHECK_THAT(readFile("stderr"), Catch::Contains("[worker.killed]"));
        CHECK(leftFiles().empty());
    }
}

TEST_CASE("signals that users send end the whole command") {
    freshFolder();
    writeFile("scene.xml", kScene);
    {
        Running farol(kLongRender);  // as a shell's pipe or `timeout` does
        kill(farol.confined(), SIGTERM);
        CHECK(farol.end() == 128 + SIGTERM);
    }
    Running farol(kLongRender);
    const pid_t child = farol.confined();
    kill(farol.pid(), SIGTERM);
    CHECK(farol.end() == 128 + SIGTERM);
    while (kill(child, 0) == 0) std::this_thread::sleep_for(1ms);  // ends with its parent
    CHECK(leftFiles().empty());
}

TEST_CASE("the sandbox of the command line can be switched off") {
    freshFolder();
    writeFile("scene.xml", kScene);
    Running farol(with(kLongRender, "--no-sandbox"));
    std::this_thread::sleep_for(50ms);
    kill(farol.pid(), SIGSEGV);  // nobody reports it
    CHECK(farol.end() == 128 + SIGSEGV);
    CHECK(run("render scene.xml -o closed.png").status == 0);
    CHECK(run("render scene.xml -o open.png --no-sandbox").status == 0);
    CHECK(readFile("closed.png") == readFile("open.png"));
    CHECK(run("compare closed.png open.png --no-sandbox --json").status == 0);
}

TEST_CASE("the process that reads the files has a bounded memory") {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    skip("a build with sanitizers has no memory limit");
#else
    freshFolder();
    writeFile("scene.xml", kScene);
    const Outcome small =
        run("render scene.xml -o picture.png --width 4096 --height 4096 --worker-memory 128");
    INFO(small.err);
    CHECK((small.status == 1 || small.status == 3));  // where the GL does not survive it
    CHECK_THAT(small.err, Catch::Contains("[limit.memory]") || Catch::Contains("[worker.crashed]"));
    CHECK_FALSE(exists("picture.png"));
    CHECK(run("render scene.xml -o picture.png --width 4096 --height 4096 --worker-memory 0")
              .status == 0);
#endif
}

TEST_CASE("an OpenEXR file is read closed in, without a word from the module's libraries") {
    freshFolder();
    std::filesystem::copy_file(
        std::filesystem::path(farol::test::kSourceDir) / "docker" / "grey.exr",
        folder() / "grey.exr");
    const Outcome found = run("compare grey.exr grey.exr --json");
    CHECK(found.status == 0);
    CHECK(found.err.empty());
}

TEST_CASE("farol version names the layers of the sandbox") {
    freshFolder();
    const Outcome found = run("version --json");
    REQUIRE(found.status == 0);
    const auto layers = nlohmann::json::parse(found.out)["sandbox"];
    for (const char* name : {"noNewPrivileges", "limits", "landlock", "seccomp"})
        CHECK(layers.contains(name));
    CHECK_THAT(run("version").out, Catch::Contains("sandbox: "));
}
