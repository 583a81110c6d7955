#include "run.h"

#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/support/paths.h"

namespace farol::test {
namespace {
namespace fs = std::filesystem;

fs::path current;

std::string quoted(const fs::path& path) { return "'" + path.string() + "'"; }

}  // namespace

const fs::path& folder() { return current; }

void freshFolder() {
    std::string name = Catch::getResultCapture().getCurrentTestName();
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '-';
    current = fs::path(farol::test::kTestOutput) / "cli" / name;
    fs::remove_all(current);
    fs::create_directories(current);
}

void writeFile(const std::string& name, const std::string& bytes) {
    fs::create_directories((folder() / name).parent_path());
    std::ofstream out(folder() / name, std::ios::binary);
    out << bytes;
    REQUIRE(out.good());
}

std::string readFile(const std::string& name) {
    std::ifstream in(folder() / name, std::ios::binary);
    INFO(name);
    REQUIRE(in.good());
    return {std::istreambuf_iterator<char>(in), {}};
}

bool exists(const std::string& name) { return fs::exists(fs::symlink_status(folder() / name)); }

Outcome run(const std::string& arguments, const std::string& input) {
    const fs::path streams =
        fs::path(farol::test::kTestOutput) / "cli" / "streams" / folder().filename();
    fs::create_directories(streams);
    std::ofstream(streams / "in", std::ios::binary) << input;
    const std::string command = "cd " + quoted(folder()) + " && " + quoted(farol::test::kProgram) +
                                " " + arguments + " <" + quoted(streams / "in") + " >" +
                                quoted(streams / "out") + " 2>" + quoted(streams / "err");
    const int result = std::system(command.c_str());
    const auto slurp = [](const fs::path& path) {
        std::ifstream in(path, std::ios::binary);
        return std::string{std::istreambuf_iterator<char>(in), {}};
    };
    const int status = WIFEXITED(result) ? WEXITSTATUS(result) : 128 + WTERMSIG(result);
    return {status, slurp(streams / "out"), slurp(streams / "err")};
}

const char* const kScene = R"(<world>
  <window width="96" height="64" />
  <camera>
    <position x="0" y="0" z="4" />
    <lookAt x="0" y="0" z="0" />
    <up x="0" y="1" z="0" />
    <projection fov="60" near="1" far="100" />
  </camera>
  <lights><light type="directional" dirx="0" diry="0" dirz="1" /></lights>
  <group>
    <models>
      <model file="sphere_1_24_12.3d">
        <color>
          <diffuse R="200" G="0" B="0" />
          <ambient R="50" G="0" B="0" />
          <specular R="0" G="0" B="0" />
          <emissive R="0" G="0" B="0" />
          <shininess value="0" />
        </color>
      </model>
    </models>
  </group>
</world>
)";

std::string turningScene() {
    std::string scene = kScene;
    scene.insert(scene.find("<models>"),
                 "<transform><rotate time=\"2\" y=\"1\"/><translate x=\"0.5\"/></transform>");
    return scene;
}

}  // namespace farol::test
