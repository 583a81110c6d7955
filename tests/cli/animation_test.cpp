// Animations drawn by several processes: the same bytes, progress, a lost process, and a cancel.
#include <signal.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "run.h"
#include "running.h"
#include "tests/support/paths.h"

using namespace farol::test;
using nlohmann::json;

namespace {

json drawn(const std::string& arguments) {
    const Outcome found = run("render scene.xml --width 48 --height 32 --json " + arguments);
    INFO(arguments << "\n" << found.out << found.err);
    REQUIRE(found.status == 0);
    CHECK(found.err.empty());
    return json::parse(found.out);
}

bool hasVideos() {
    return std::filesystem::exists(
        std::filesystem::path(kProgram).replace_filename("libfarol_video.so"));
}

// Takes seconds, so that the signal arrives before the end.
const std::vector<std::string> kLongLoop = {"render", "scene.xml", "-o",     "loop.gif", "--frames",
                                            "40",     "--width",   "1024",   "--height", "1024",
                                            "--aa",   "16",        "--jobs", "3"};

/// Waits for the end of all processes of the group.
void awaitGroup(pid_t group) {
    while (kill(-group, 0) == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace

TEST_CASE("an animation has the same bytes whatever the number of processes") {
    freshFolder();
    writeFile("scene.xml", turningScene());
    std::vector<std::string> endings = {"png", "webp", "gif"};
    if (hasVideos()) endings.insert(endings.end(), {"mp4", "webm"});
    for (const std::string& ending : endings) {
        INFO(ending);
        json warnings;
        for (const int jobs : {1, 2, 3, 9}) {
            const std::string number = std::to_string(jobs);
            const json report =
                drawn("-o " + number + "." + ending + " --frames 7 --jobs " + number);
            CHECK(report["processes"] == jobs);
            if (jobs == 1) warnings = report["diagnostics"];
            CHECK(report["diagnostics"] == warnings);
            CHECK(readFile(number + "." + ending) == readFile("1." + ending));
        }
    }
    for (const int jobs : {1, 3})
        drawn("-o f" + std::to_string(jobs) + "-%02d.jpg --frames 7 --jobs " +
              std::to_string(jobs));
    for (int i = 0; i < 7; ++i) {
        const std::string number = "-0" + std::to_string(i) + ".jpg";
        CHECK(readFile("f3" + number) == readFile("f1" + number));
    }
    CHECK(readFile("f3-00.jpg") != readFile("f3-03.jpg"));
}

TEST_CASE("few frames are drawn by one process, and all of them where the sandbox is off") {
    freshFolder();
    writeFile("scene.xml", turningScene());
    CHECK(drawn("-o a.gif --frames 6")["processes"] == 1);
    CHECK(drawn("-o a.gif --frames 6 --jobs 2 --no-sandbox")["processes"] == 1);
    CHECK(run("render scene.xml -o a.gif --frames 6 --jobs 0").status == 2);
}

TEST_CASE("a fault of the scene is reported once by an animation of several processes") {
    freshFolder();
    writeFile("scene.xml", "<world>");
    const Outcome found = run("render scene.xml -o a.gif --frames 20 --jobs 3");
    CHECK(found.status == 1);
    CHECK(found.err.find("xml.") != std::string::npos);
    CHECK(found.err.find("xml.") == found.err.rfind("xml."));
    CHECK_FALSE(exists("a.gif"));
}

TEST_CASE("the frames of a process that ends early are drawn by the others") {
    freshFolder();
    writeFile("scene.xml", turningScene());
    std::vector<std::string> words = {"render", "scene.xml", "-o", "loop.gif", "--frames", "40"};
    words.insert(words.end(), {"--width", "256", "--height", "256", "--jobs", "2"});
    {
        Running farol(words);
        // The helper is started first; it may be closed in after the other.
        kill(farol.confined(2).front(), SIGKILL);
        CHECK(farol.end() == 0);
        CHECK_THAT(readFile("stderr"), Catch::Contains("[worker.crashed]") &&
                                           Catch::Contains("warning: one of the processes"));
    }
    words.back() = "1";
    const std::string lost = readFile("loop.gif");
    Running farol(words);
    CHECK(farol.end() == 0);
    CHECK(readFile("loop.gif") == lost);
}

TEST_CASE("an animation shows its progress in tenths, and none beside JSON") {
    freshFolder();
    writeFile("scene.xml", turningScene());
    const Outcome found =
        run("render scene.xml -o a.gif --width 16 --height 16 --frames 20 --jobs 1");
    CHECK(found.status == 0);
    CHECK(std::count(found.err.begin(), found.err.end(), '\n') == 10);
    CHECK(found.err.starts_with("drawing 2/20  10 %  "));
    CHECK_THAT(found.err, Catch::Contains("\ndrawing 20/20  100 %  0:00 left\n"));
    const Outcome sheet = run("render scene.xml -o a.png --width 16 --height 16 --sheet 2x1");
    CHECK_THAT(sheet.err, Catch::Contains("drawing 2/2  100 %"));
    drawn("-o a.gif --frames 20");  // checks that stderr is empty
}

TEST_CASE("an animation that is cancelled leaves no file and no process") {
    freshFolder();
    writeFile("scene.xml", turningScene());
    for (const int number : {SIGINT, SIGTERM, SIGKILL}) {
        for (const bool isGroup : {true, false}) {
            INFO("signal " << number << (isGroup ? " to all" : " to the first process"));
            Running farol(kLongLoop);
            farol.confined(3);
            const pid_t group = farol.pid();
            kill(isGroup ? -group : group, number);
            CHECK(farol.end() == 128 + number);
            awaitGroup(group);
            CHECK(leftFiles().empty());
        }
    }
}
