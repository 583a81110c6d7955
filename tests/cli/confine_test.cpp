// The command line reads files in a closed-in child process: its crash, its limits, its outputs.
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "run.h"
#include "tests/support/paths.h"
#include "tests/support/skip.h"

namespace {

using namespace farol::test;
using namespace std::chrono_literals;

std::string textOf(const std::string& path) {
    std::ifstream in(path);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

/// `farol` with these arguments in the test's folder, while it runs.
class Running {
  public:
    explicit Running(std::vector<std::string> words) {
        words.insert(words.begin(), farol::test::kProgram);
        std::vector<char*> arguments;
        for (std::string& word : words) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        const std::string out = (folder() / "stdout").string(),
                          err = (folder() / "stderr").string();
        pid_ = fork();
        REQUIRE(pid_ >= 0);
        if (pid_ == 0) {
            dup2(open(out.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600), 1);
            dup2(open(err.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600), 2);
            if (chdir(folder().c_str()) == 0) execv(arguments[0], arguments.data());
            _exit(127);
        }
    }
    ~Running() {
        if (pid_ > 0) {
            kill(pid_, SIGKILL);
            waitpid(pid_, nullptr, 0);
        }
    }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

    pid_t pid() const { return pid_; }
    /// The process that reads the files; waits for it to exist and to be closed in by seccomp.
    pid_t confined() const {
        const std::string children =
            "/proc/" + std::to_string(pid_) + "/task/" + std::to_string(pid_) + "/children";
        for (;;) {
            REQUIRE(waitpid(pid_, nullptr, WNOHANG) == 0);
            std::istringstream list(textOf(children));
            pid_t child = 0;
            if (list >> child && statusOf(child).find("Seccomp:\t2") != std::string::npos)
                return child;
            std::this_thread::sleep_for(1ms);
        }
    }
    static std::string statusOf(pid_t process) {
        return textOf("/proc/" + std::to_string(process) + "/status");
    }
    /// Waits for the end: the exit code, or 128 and the signal's number.
    int end() {
        int status = 0;
        waitpid(pid_, &status, 0);
        pid_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }

  private:
    pid_t pid_ = -1;
};

// Takes seconds, so that the signal arrives before the end.
const std::vector<std::string> kLongRender = {"render", "scene.xml", "-o", "picture.png", "--width",
                                              "4096",   "--aa",      "16", "--height",    "4096"};

std::vector<std::string> with(std::vector<std::string> words, const std::string& more) {
    words.push_back(more);
    return words;
}

/// Names of the files in the test's folder that are neither its scene nor its streams.
std::vector<std::string> leftFiles() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder())) {
        const std::string name = entry.path().filename().string();
        if (name != "scene.xml" && name != "stdout" && name != "stderr") names.push_back(name);
    }
    return names;
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
