#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "render/renderer.h"

// The same request gives the same bytes, whoever draws it and with however many threads.
using namespace farol;

namespace {

std::string readFile(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("bytes do not depend on threads, repetition, or whether the command line drew them") {
    const std::filesystem::path folder =
        std::filesystem::path(FAROL_SOURCE_DIR) / "scenes/primitives";
    render::Job job;
    job.name = "scene.xml";
    job.xml = readFile(folder / "scene.xml");
    job.assets = std::make_shared<scene::FolderAssets>(folder.string());
    job.options.width = 320;
    job.options.height = 200;
    render::Renderer renderer;
    const std::string bytes = renderer.render(job).bytes;
    REQUIRE(bytes.size() > 1000);
    CHECK(renderer.render(job).bytes == bytes);
    std::filesystem::create_directories(FAROL_TEST_OUTPUT);
    const std::string out = std::string(FAROL_TEST_OUTPUT) + "/threads.png";
    for (const char* threads : {"0", "1", "2", "5"}) {
        INFO(threads);
        std::filesystem::remove(out);
        const std::string command = std::string("LP_NUM_THREADS=") + threads + " '" + FAROL_BINARY +
                                    "' render --width 320 --height 200 '" +
                                    (folder / "scene.xml").string() + "' -o '" + out + "'";
        REQUIRE(std::system(command.c_str()) == 0);
        CHECK(readFile(out) == bytes);
    }
}
