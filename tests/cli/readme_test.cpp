#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "run.h"
#include "service.h"

/// What the README tells its readers to type works as it stands there.
namespace {

using namespace farol::test;
namespace fs = std::filesystem;

std::string slurp(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// The commands of the README's shell blocks that begin with `program`, each on one line.
std::vector<std::string> examples(const std::string& program) {
    std::istringstream in(slurp(fs::path(FAROL_SOURCE_DIR) / "README.md"));
    std::vector<std::string> all;
    bool shell = false, continues = false;
    for (std::string line; std::getline(in, line);) {
        if (line.rfind("```", 0) == 0) {
            shell = line == "```sh";
        } else if (shell) {
            const bool more = !line.empty() && line.back() == '\\';
            if (more) line.pop_back();
            if (continues)
                all.back() += line;
            else
                all.push_back(line);
            continues = more;
        }
    }
    std::erase_if(all, [&](const std::string& one) { return one.rfind(program + " ", 0) != 0; });
    return all;
}

void replaceAll(std::string& text, const std::string& what, const std::string& by) {
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
        text.replace(at, what.size(), by);
}

fs::path folderWithScenes() {
    freshFolder();
    fs::create_directory_symlink(fs::path(FAROL_SOURCE_DIR) / "scenes", folder() / "scenes");
    return folder();
}

}  // namespace

TEST_CASE("the README's commands do what it says") {
    const fs::path readers = folderWithScenes();
    fs::create_directories(readers / "submissions");
    fs::copy(readers / "scenes" / "snowman", readers / "submissions" / "ana",
             fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    const std::vector<std::string> commands = examples("farol");
    REQUIRE(commands.size() >= 10);
    for (const std::string& command : commands) {
        const Outcome found = run(command.substr(6));
        INFO(command << "\n" << found.err);
        CHECK(found.status == 0);
    }
    for (const char* made : {"system.png", "detail.webp", "house.jpg", "lines.png", "sphere.obj",
                             "teapot.png", "where.png", "report/report.html", "report/grades.csv"})
        CHECK(exists(made));
}

TEST_CASE("the README's requests get what it says") {
    if (std::system("command -v curl >/dev/null") != 0) {
        WARN("skipped: there is no curl here; scripts/setup installs it");
        return;
    }
    const std::string readers = folderWithScenes().string();
    Service service;
    const std::vector<std::string> requests = examples("curl");
    REQUIRE(requests.size() >= 5);
    for (std::string request : requests) {
        replaceAll(request, "http://127.0.0.1:8080", service.url());
        INFO(request);
        CHECK(std::system(("cd '" + readers + "' && " + request +
                           " --silent --show-error --max-time 60 >>answers.txt 2>&1")
                              .c_str()) == 0);
        INFO(readFile("answers.txt"));
    }
    CHECK(readFile("teapots.png").substr(1, 3) == "PNG");
    CHECK(readFile("house.png").substr(1, 3) == "PNG");
    CHECK(readFile("own.png").substr(1, 3) == "PNG");
    CHECK_THAT(readFile("cone.obj"), Catch::Contains("\nf "));
    CHECK_THAT(readFile("answers.txt"), Catch::Contains("solar-system"));
    CHECK(service.stop() == 0);
}

TEST_CASE("serve is healthy until it is told to end, and ends with exit code 0") {
    freshFolder();
    Service service;
    const Outcome up = run("health " + service.url());
    INFO(up.err);
    CHECK(up.status == 0);
    CHECK(run("health " + service.url() + "/ --timeout 30").status == 0);
    CHECK_THAT(run("health --json " + service.url()).out, Catch::Contains("\"ready\": true"));
    CHECK(service.stop() == 0);
    CHECK(run("health " + service.url()).status == 1);
}

TEST_CASE("links in the documents lead to files") {
    const fs::path root(FAROL_SOURCE_DIR);
    std::vector<fs::path> documents{root / "README.md", root / "CHANGELOG.md"};
    for (const char* folder : {"docs", "scenes", "api"})
        for (const auto& entry : fs::recursive_directory_iterator(root / folder))
            if (entry.path().extension() == ".md") documents.push_back(entry.path());
    static const std::regex kLink(R"(\]\(([^)#\s]+)[^)]*\))");
    int links = 0;
    for (const fs::path& document : documents) {
        const std::string text = slurp(document);
        for (std::sregex_iterator at(text.begin(), text.end(), kLink), end; at != end; ++at) {
            const std::string target = (*at)[1];
            if (target.find("://") != std::string::npos) continue;
            INFO(document.lexically_relative(root).string() << " links to " << target);
            CHECK(fs::exists(document.parent_path() / target));
            ++links;
        }
    }
    CHECK(links > 5);
}
