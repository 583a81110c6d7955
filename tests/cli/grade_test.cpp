#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>
#include <vector>

#include "core/text.h"
#include "run.h"
#include "tests/support/paths.h"
#include "tests/support/skip.h"

// A class graded by the program itself: sandboxed workers, reports, going on after an interruption.
using namespace farol::test;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

constexpr const char* kReference = R"(<world><window width="96" height="96"/>
<camera><position x="4" y="3" z="5"/><lookAt x="0" y="0" z="0"/><projection fov="50" near="1" far="50"/></camera>
<lights><light type="directional" dirx="1" diry="2" dirz="1"/></lights>
<group>
 <transform>
  <translate x="1" y="0" z="0"/>
  <rotate angle="40" x="0" y="0" z="1"/>
 </transform>
 <models><model file="box_1_2.3d"/></models>
</group></world>)";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    text.replace(text.find(what), what.size(), by);
    return text;
}

void makeClass() {
    freshFolder();
    writeFile("reference.xml", kReference);
    writeFile("class/Ana Alves_101_assignsubmission_file_/scene.xml", kReference);
    writeFile("class/Bento_102_assignsubmission_file_/work/s.xml",
              replaced(kReference, "angle=\"40\"", "angle=\"-40\""));
    writeFile("class/carla.xml", replaced(kReference, "</world>", ""));
    writeFile("class/duarte/notes.txt", "nothing to see");
    writeFile("class/eva.zip", "PK\x03\x04 this is no archive");
    // More than may be drawn; nested deeper than may be read.
    writeFile("class/filipe.xml", replaced(kReference, "box_1_2", "sphere_1_3000_3000"));
    std::string deep = "<world>";
    for (int i = 0; i < 5000; ++i) deep += "<group>";
    writeFile("class/gil.xml", deep);
    writeFile("class/=1+1/scene.xml", kReference);
}

json reportOf(const std::string& folder) { return json::parse(readFile(folder + "/report.json")); }

json gradeOf(const json& report, const std::string& id) {
    for (const json& one : report.at("submissions"))
        if (one.at("id") == id) return one;
    FAIL("no submission " << id);
    return {};
}

constexpr const char* kReports[] = {"report.html", "grades.csv", "junit.xml", "report.json"};

std::size_t resultsIn(const std::string& output) {
    std::error_code none;
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(folder() / output / "results", none))
        count += entry.path().extension() == ".grade" ? 1 : 0;
    return count;
}

/// The program, running beside the test.
class Running {
  public:
    explicit Running(std::vector<std::string> arguments) : pid_(::fork()) {
        if (pid_ != 0) return;
        arguments.insert(arguments.begin(), farol::test::kProgram);
        std::vector<char*> raw;
        for (std::string& one : arguments) raw.push_back(one.data());
        raw.push_back(nullptr);
        if (::chdir(folder().c_str()) == 0 && ::freopen("/dev/null", "w", stdout) &&
            ::freopen("/dev/null", "w", stderr))
            ::execv(raw[0], raw.data());
        ::_exit(127);
    }
    ~Running() {
        if (pid_ > 0) end();
    }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

    pid_t pid() const { return pid_; }
    /// Waits for it; its status as waitpid() tells it.
    int wait() {
        int status = 0;
        ::waitpid(pid_, &status, 0);
        pid_ = 0;
        return status;
    }
    /// Ends it at once, as a machine that goes down does.
    int end() {
        ::kill(pid_, SIGKILL);
        return wait();
    }
    /// False where the program ended before.
    template <typename Condition>
    bool waitUntil(Condition condition) const {
        while (!condition()) {
            siginfo_t ended{};
            ::waitid(P_PID, static_cast<id_t>(pid_), &ended, WEXITED | WNOHANG | WNOWAIT);
            if (ended.si_pid != 0) return false;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return true;
    }
    std::vector<pid_t> children() const {
        std::vector<pid_t> found;
        for (const auto& entry : fs::directory_iterator("/proc")) {
            if (std::atoi(entry.path().filename().c_str()) <= 0) continue;  // no process
            std::ifstream file(entry.path() / "stat");
            const std::string text{std::istreambuf_iterator<char>(file), {}};
            const std::size_t name = text.rfind(')');  // then: state, parent
            if (name != std::string::npos && text.size() > name + 4 &&
                std::atoi(text.c_str() + name + 4) == pid_)
                found.push_back(std::atoi(entry.path().filename().c_str()));
        }
        return found;
    }

  private:
    pid_t pid_;
};

/// Many that are no other's double: `count` of them, in `class`.
void makeMany(int count) {
    freshFolder();
    writeFile("reference.xml", kReference);
    for (int i = 0; i < count; ++i)
        writeFile("class/student-" + std::to_string(100 + i) + ".xml",
                  replaced(kReference, "angle=\"40\"", "angle=\"" + std::to_string(40 + i) + "\""));
}

}  // namespace

TEST_CASE("a run that was ended in its midst goes on to the same reports") {
    makeMany(24);
    Running first({"grade", "--reference", "reference.xml", "class", "-o", "out", "--jobs", "1"});
    REQUIRE(first.waitUntil([] { return resultsIn("out") >= 3; }));
    const int status = first.end();
    REQUIRE(WIFSIGNALED(status));
    const std::size_t before = resultsIn("out");
    CHECK(before < 24);
    CHECK_FALSE(exists("out/report.json"));
    // A file as a power failure leaves it.
    for (const auto& entry : fs::directory_iterator(folder() / "out" / "results"))
        if (entry.path().extension() == ".grade") {
            fs::resize_file(entry.path(), fs::file_size(entry.path()) / 2);
            break;
        }
    const Outcome second = run("grade --reference reference.xml class -o out --jobs 2 --json");
    INFO(second.err);
    REQUIRE(second.status == 0);
    CHECK(json::parse(second.out).at("kept") == before - 1);
    CHECK(json::parse(second.out).at("graded") == 24 - (before - 1));
    REQUIRE(run("grade --reference reference.xml class -o whole --jobs 2").status == 0);
    for (const char* file : kReports)
        CHECK(readFile(std::string("out/") + file) == readFile(std::string("whole/") + file));
}

TEST_CASE("a submission that takes all memory, or no end, stops no other") {
    const std::size_t many = 24;
    makeMany(static_cast<int>(many));
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    WARN("without the hungry one: a sanitizer's build has no memory cap");
    const std::string hungry;
#else
    // Just as many triangles as may be drawn. Last by name, so it is not yet begun when a
    // worker is stopped.
    const std::string hungry = "student-999-hungry.xml";
    writeFile("class/" + hungry, replaced(kReference, "box_1_2", "sphere_1_1580_1580"));
#endif
    Running grading({"grade", "--reference", "reference.xml", "class", "-o", "out", "--jobs", "2",
                     "--worker-memory", "448", "--deadline", "12"});
    // A worker that stands still is late with whatever it is given.
    REQUIRE(grading.waitUntil([] { return resultsIn("out") >= 1; }));
    const std::vector<pid_t> workers = grading.children();
    REQUIRE_FALSE(workers.empty());
    REQUIRE(::kill(workers.front(), SIGSTOP) == 0);
    const int status = grading.wait();
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
    std::size_t graded = 0, late = 0;
    const json report = reportOf("out");
    for (const json& one : report.at("submissions")) {
        const json& task = one.at("tasks").at(0);
        INFO(task.dump().substr(0, 300));
        if (one.at("id") == hungry) {
            CHECK(task.at("failure").at("code") == "limit.memory");
            CHECK(one.at("points") == 0.0);
        } else if (task.contains("failure")) {
            CHECK(task.at("failure").at("code") == "busy.deadline");
            ++late;
        } else {
            ++graded;
        }
    }
    CHECK(late <= 1);
    CHECK(graded + late == many);
}

TEST_CASE("a mistake without a place in the document is reported like any other") {
    freshFolder();
    writeFile("reference.xml", kReference);
    const std::string light =
        "<lights><light type=\"directional\" dirx=\"1\" diry=\"2\" dirz=\"1\"/></lights>";
    writeFile("class/dark.xml", replaced(kReference, light, ""));
    REQUIRE(run("grade --reference reference.xml class -o out").status == 0);
    const json task = gradeOf(reportOf("out"), "dark.xml").at("tasks").at(0);
    INFO(task.dump());
    REQUIRE(task.contains("grade"));
    CHECK(task.at("grade").at("findings").at(0).at("code") == "light.missing");
}

TEST_CASE("what was handed out with the task need not be handed in") {
    freshFolder();
    const auto textured = [](const std::string& texture) {
        return replaced(kReference, "<model file=\"box_1_2.3d\"/>",
                        "<model file=\"box_1_2.3d\"><texture file=\"" + texture +
                            "\"/></model><model file=\"lid.obj\"/>");
    };
    const std::string lid = "v 0 2 0\nv 1 2 0\nv 0 2 1\nf 1 3 2\n";
    writeFile("task/scene.xml", textured("wood.png"));
    writeFile("task/lid.obj", lid);
    writeFile("checks.xml", replaced(kReference, "box_1_2.3d", "sphere_1_4_4.3d"));
    REQUIRE(run("render checks.xml -o task/wood.png --width 16 --height 16").status == 0);
    REQUIRE(
        run("render checks.xml -o other.png --width 16 --height 16 --background white").status ==
        0);
    writeFile("class/without.xml", textured("textures/wood.png"));
    writeFile("class/own/scene.xml", textured("wood.png"));
    writeFile("class/own/wood.png", readFile("other.png"));
    REQUIRE(run("grade --reference task class -o out").status == 0);
    const json report = reportOf("out");
    CHECK(gradeOf(report, "without.xml").at("points") == 100.0);
    std::set<std::string> noted;
    const json without = gradeOf(report, "without.xml").at("tasks").at(0).at("grade");
    for (const json& one : without.at("diagnostics"))
        if (one.at("code") == "grade.lent") noted.insert(one.at("message"));
    CHECK(noted.size() == 2);
    // Its own file of that name is used, and it is another image.
    CHECK(gradeOf(report, "own").at("points") < 100.0);

    writeFile("strict.json", R"({"lend": false})");
    const std::string strict = "grade --reference task class -o strict --rubric strict.json";
    REQUIRE(run(strict + " --missing error").status == 0);
    CHECK_THAT(gradeOf(reportOf("strict"), "without.xml").dump(),
               Catch::Contains("\"refused\":true"));
    REQUIRE(run(strict).status == 0);  // with placeholders, and the errors in the list
    CHECK_THAT(gradeOf(reportOf("strict"), "without.xml").dump(),
               Catch::Contains("asset.missing") && Catch::Contains("\"refused\":false"));
    CHECK(gradeOf(reportOf("strict"), "without.xml").at("points") < 100.0);
}

TEST_CASE("a class is graded, whatever is in it") {
    makeClass();
    const Outcome first =
        run("grade --reference reference.xml class -o out --jobs 2 --deadline 20");
    INFO(first.err);
    REQUIRE(first.status == 0);
    const json report = reportOf("out");
    REQUIRE(report.at("submissions").size() == 8);
    const json ana = gradeOf(report, "Ana Alves_101_assignsubmission_file_");
    CHECK(ana.at("points") == 100.0);
    CHECK(ana.at("name") == "Ana Alves");
    CHECK(ana.at("identifier") == "Participant 101");
    const json bento = gradeOf(report, "Bento_102_assignsubmission_file_").at("tasks").at(0);
    const json finding = bento.at("grade").at("findings").at(0);
    CHECK(finding.at("code") == "transform.angle-sign");
    CHECK(finding.at("line") == 7);
    CHECK_THAT(finding.at("message").get<std::string>(),
               Catch::StartsWith("group 1: ") && Catch::Contains("(line 7)"));
    CHECK_THAT(finding.at("excerpt").get<std::string>(), Catch::Contains("7 > "));
    CHECK_THAT(gradeOf(report, "carla.xml").dump(), Catch::Contains("xml.unclosed"));
    CHECK(gradeOf(report, "carla.xml").at("points") == 60.0);
    CHECK(gradeOf(report, "carla.xml").at("graded") == true);
    CHECK(gradeOf(report, "duarte").at("graded") == false);
    CHECK_THAT(readFile("out/grades.csv"), Catch::Contains("\"\",\"\",,100.00,,,\"duarte\""));
    CHECK(gradeOf(report, "duarte").at("tasks").at(0).at("failure").at("code") == "grade.no-scene");
    CHECK(gradeOf(report, "eva.zip").at("points") == 0.0);
    CHECK(gradeOf(report, "filipe.xml").at("points") < 100.0);
    CHECK_THAT(readFile("out/grades.csv"), Catch::Contains("\"'=1+1\""));

    // Again, and elsewhere with other jobs: the same bytes; what was graded is kept.
    const Outcome again = run("grade --reference reference.xml class -o out --json");
    REQUIRE(again.status == 0);
    CHECK(json::parse(again.out).at("kept").get<int>() >= 5);
    REQUIRE(run("grade --reference reference.xml class -o other --jobs 1").status == 0);
    for (const char* file : kReports)
        CHECK(readFile(std::string("out/") + file) == readFile(std::string("other/") + file));
}

namespace {

/// Entries that hold nothing to grade, and the code of each row.
std::map<std::string, std::string> makeUseless() {
    const auto path = [](const std::string& name) { return (folder() / "class" / name).string(); };
    std::map<std::string, std::string> codes;
    for (const char* ending : {"xml", "zip", "tar", "tgz", "png", "jpg", "webp", "tga"}) {
        const std::string name = std::string("empty.") + ending;
        writeFile("class/" + name, "");
        codes[name] = "grade.empty-file";
    }
    writeFile("class/emptied/scene.xml", "");
    codes["emptied"] = "grade.empty-file";
    fs::create_directories(path("nothing"));
    codes["nothing"] = "grade.no-scene";
    fs::create_directories(path("folder.xml"));
    codes["folder.xml"] = "grade.no-scene";
    REQUIRE(::mkfifo(path("pipe.xml").c_str(), 0600) == 0);
    REQUIRE(::mkfifo(path("pipe.zip").c_str(), 0600) == 0);
    fs::create_symlink("nowhere", path("dangling.xml"));
    fs::create_symlink("loop.png", path("loop.png"));
    fs::create_symlink("/dev/zero", path("device.xml"));
    fs::create_directory_symlink("..", path("up"));
    for (const char* name :
         {"pipe.xml", "pipe.zip", "dangling.xml", "loop.png", "device.xml", "up"})
        codes[name] = "asset.unreadable";
    fs::create_directories(path("piped"));
    REQUIRE(::mkfifo(path("piped/scene.xml").c_str(), 0600) == 0);
    codes["piped"] = "grade.no-scene";
    writeFile("class/huge.xml", "<world/>");
    fs::resize_file(path("huge.xml"), std::uintmax_t{1} << 40U);  // sparse
    codes["huge.xml"] = "limit.file-bytes";
    fs::create_directories(path("stuffed"));
    writeFile("class/stuffed/scene.xml", "<world><background texture=\"huge.png\"/></world>");
    writeFile("class/stuffed/huge.png", "");
    fs::resize_file(path("stuffed/huge.png"), std::uintmax_t{1} << 40U);
    codes["stuffed"] = "limit.bundle";
    return codes;
}

}  // namespace

TEST_CASE("an entry that holds nothing to grade is one row, again and again") {
    freshFolder();
    writeFile("reference.xml", kReference);
    writeFile("class/ana.xml", kReference);
    writeFile("class/Ana.xml", kReference);
    writeFile("class/torn.zip", std::string("PK\x03\x04\x14\x00", 6));
    writeFile("class/torn.png", "\x89PNG\r\n");
    const std::map<std::string, std::string> useless = makeUseless();
    for (int round = 0; round < 2; ++round) {
        const Outcome outcome = run("grade --reference reference.xml class -o out --jobs 2 --json");
        INFO(outcome.err);
        REQUIRE(outcome.status == 0);
        const json report = reportOf("out");
        CHECK(report.at("submissions").size() == useless.size() + 4);
        for (const auto& [id, code] : useless) {
            INFO(id);
            const json row = gradeOf(report, id);
            CHECK(row.at("points") == 0.0);
            REQUIRE(row.at("tasks").at(0).contains("failure"));
            CHECK(row.at("tasks").at(0).at("failure").at("code") == code);
        }
        for (const char* id : {"ana.xml", "Ana.xml"})
            CHECK(gradeOf(report, id).at("points") == 100.0);
        for (const char* id : {"torn.zip", "torn.png"})
            CHECK(gradeOf(report, id).at("tasks").at(0).at("grade").at("refused") == true);
        // The cache entry of an earlier version for an empty submission, and one that is no grade.
        for (const auto& entry : fs::directory_iterator(folder() / "out" / "results"))
            std::ofstream(entry.path(), std::ios::binary) << (round == 0 ? "\n" : "[]\n");
    }
}

TEST_CASE("results that are no grades are graded again, and do not end the run") {
    freshFolder();
    writeFile("reference.xml", kReference);
    writeFile("class/ana.xml", kReference);
    for (const char* kept : {"", "\n", "null\n", "{}\n", "{\"points\":\"x\"}\n", "[1]\n", "{\n"}) {
        REQUIRE(run("grade --reference reference.xml class -o out --jobs 1").status == 0);
        CHECK(gradeOf(reportOf("out"), "ana.xml").at("points") == 100.0);
        for (const auto& entry : fs::directory_iterator(folder() / "out" / "results"))
            std::ofstream(entry.path(), std::ios::binary) << kept;
    }
}

TEST_CASE("names of any bytes are in all reports, which are well-formed") {
    freshFolder();
    writeFile("reference.xml", kReference);
    const std::string names[] = {
        "Jo\xE3o.xml",  // Latin-1, and the same in UTF-8
        "Jo\xC3\xA3o.xml",
        "\xFF\xFE_7_assignsubmission_file_/scene.xml",
        "line\nfeed\x01\x7F.xml",
        "quotes \"'<&>.xml",
        "=1+1,2.xml",
        "-folder\xE9/\xE9.xml",
        std::string(251, '\xE9') + ".xml",
        std::string(255, 'n') + "/scene.xml",
    };
    for (const std::string& name : names) writeFile("class/" + name, kReference);
    writeFile("class/br\xE9k.xml", replaced(kReference, "</world>", ""));
    const Outcome outcome = run("grade --reference reference.xml class -o out --jobs 2");
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(outcome.out.find('\x01') == std::string::npos);
    for (const char* file : kReports) CHECK(farol::isUtf8(readFile(std::string("out/") + file)));
    const json report = reportOf("out");
    std::set<std::string> ids;
    for (const json& row : report.at("submissions")) {
        ids.insert(row.at("id"));
        const bool isBroken = row.at("id") == "br\xC3\xA9k.xml";
        CHECK((row.at("points") == 100.0) != isBroken);
    }
    CHECK(ids.size() == std::size(names) + 1);
    CHECK(ids.count("Jo\xC3\xA3o.xml") == 1);
    CHECK(ids.count("Jo\xC3\xA3o.xml (2)") == 1);
    if (hasProgram("xmllint"))
        CHECK(std::system(
                  ("xmllint --noout '" + (folder() / "out/junit.xml").string() + "'").c_str()) ==
              0);
    REQUIRE(run("grade --reference reference.xml class -o out --json").status == 0);
}

TEST_CASE("a reference that cannot be used ends the run with its reason") {
    freshFolder();
    writeFile("class/ana.xml", kReference);
    for (const char* name : {"empty.xml", "empty.png", "empty.zip", "folder/scene.xml"})
        writeFile(name, "");
    writeFile("torn.zip", "PK\x03\x04 torn");
    fs::create_directories(folder() / "nothing");
    REQUIRE(::mkfifo((folder() / "pipe.xml").c_str(), 0600) == 0);
    fs::create_symlink("nowhere", folder() / "dangling.xml");
    struct Case {
        const char* reference;
        const char* code;
    };
    for (const Case& one : {Case{"empty.xml", "[grade.empty-file]"},
                            {"empty.png", "[grade.empty-file]"},
                            {"empty.zip", "[grade.empty-file]"},
                            {"folder", "[grade.empty-file]"},
                            {"torn.zip", "["},
                            {"nothing", "[grade.no-scene]"},
                            {"pipe.xml", "[asset.unreadable]"},
                            {"/dev/zero", "[asset.unreadable]"},
                            {"dangling.xml", "[asset.missing]"}}) {
        INFO(one.reference);
        const Outcome outcome =
            run(std::string("grade --reference ") + one.reference + " class -o out");
        CHECK(outcome.status == 1);
        CHECK_THAT(outcome.err, Catch::Contains(one.code));
        CHECK_FALSE(exists("out/report.json"));
    }
}

TEST_CASE("tasks of a folder are found by their names, and pictures are references too") {
    makeClass();
    writeFile("tasks/one.xml", kReference);
    writeFile("tasks/two.xml", replaced(kReference, "box_1_2", "sphere_1_8_8"));
    writeFile("work/ana/ONE.xml", kReference);
    writeFile("work/ana/two/scene.xml", replaced(kReference, "box_1_2", "sphere_1_8_8"));
    writeFile("work/bento/one.xml", kReference);
    REQUIRE(run("grade --reference tasks work -o tasked").status == 0);
    const json report = reportOf("tasked");
    CHECK(gradeOf(report, "ana").at("points") == 100.0);
    CHECK(gradeOf(report, "bento").at("points") == 50.0);

    REQUIRE(run("render reference.xml -o expected.png --aa 1").status == 0);
    REQUIRE(run("grade --reference expected.png class -o pictured").status == 0);
    const json pictured = reportOf("pictured");
    CHECK(gradeOf(pictured, "Ana Alves_101_assignsubmission_file_").at("points") == 100.0);
    CHECK(gradeOf(pictured, "Bento_102_assignsubmission_file_").at("points") < 90.0);
}

TEST_CASE("wrong arguments of grade are reported, with their exit code") {
    makeClass();
    writeFile("rubric.json", R"({"criteria": [{"measure": "beauty"}]})");
    fs::create_directories(folder() / "empty");
    const auto [arguments, status, text] = GENERATE(table<const char*, int, const char*>({
        {"class -o out", 2, "--reference"},
        {"--reference nosuch.xml class -o out", 1, "[asset.missing]"},
        {"--reference reference.xml nosuch -o out", 1, "[asset.missing]"},
        {"--reference reference.xml empty -o out", 1, "[grade.no-submissions]"},
        {"--reference reference.xml class -o out --rubric rubric.json", 1, "/criteria/0/measure"},
        {"--reference class/carla.xml class -o out", 1, "[xml."},
        {"--reference reference.xml class -o out --jobs 99", 2, "--jobs"},
    }));
    INFO(arguments);
    const Outcome outcome = run(std::string("grade ") + arguments);
    CHECK(outcome.status == status);
    CHECK_THAT(outcome.err, Catch::Contains(text));
}
