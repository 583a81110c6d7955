#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>

#include "image/image_file.h"
#include "render/renderer.h"
#include "tests/support/paths.h"
#include "tests/support/skip.h"

// Course scenes against the pictures handed out with them. Nobody here made either, so these
// figures say whether the conventions are right. docs/benchmarks/accuracy.md holds what was
// measured.
using namespace farol;
namespace fs = std::filesystem;

namespace {

const fs::path kShared = fs::path(farol::test::kSourceDir) / ".." / "shared";

void requireData() {
    if (!fs::exists(kShared / "data" / "course")) test::skip("no folder ../shared/data/course");
    if (!fs::exists(kShared / "tools" / "picture.py")) test::skip("no ../shared/tools/picture.py");
    if (!test::hasProgram("python3")) test::skipMissing("no python3 (package python3)");
}

std::string readFile(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Renders a scene file and writes the picture for the comparison; returns its path.
fs::path renderTo(const fs::path& scene,
                  const std::vector<std::pair<const char*, const char*>>& options) {
    render::Job job;
    job.name = scene.filename().string();
    job.xml = readFile(scene);
    job.assets = std::make_shared<scene::FolderAssets>(scene.parent_path().string());
    for (const auto& [name, value] : options) render::applyOption(job.options, name, value);
    render::Renderer renderer;
    const render::Picture picture = renderer.render(job);
    fs::create_directories(farol::test::kTestOutput);
    const fs::path out = fs::path(farol::test::kTestOutput) / (scene.stem().string() + ".png");
    std::ofstream(out, std::ios::binary) << picture.bytes;
    return out;
}

/// The share in per cent of the pixels chosen by `counts` that are within `tolerance` of the
/// nearest in value of the 3x3 pixels of `b` around them; axis-like pixels do not count.
template <typename Counts>
double share(const image::Image& a, const image::Image& b, int tolerance, Counts counts) {
    const auto at = [](const image::Image& image, int x, int y) {
        return &image.pixels[static_cast<std::size_t>(y * image.width + x) * 4];
    };
    const auto axisLike = [](const std::uint8_t* p) {
        std::array<std::uint8_t, 3> v{p[0], p[1], p[2]};
        std::sort(v.begin(), v.end());
        return v[2] > 60 && v[1] < 40;
    };
    int hit = 0;
    int all = 0;
    for (int y = 1; y + 1 < a.height; ++y)
        for (int x = 1; x + 1 < a.width; ++x) {
            if (!counts(x, y)) continue;
            bool masked = false;
            bool met = false;
            for (int j = -1; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i) {
                    const std::uint8_t* p = at(a, x, y);
                    const std::uint8_t* q = at(b, x + i, y + j);
                    masked |= axisLike(at(a, x + i, y + j)) || axisLike(q);
                    met |= std::abs(p[0] - q[0]) <= tolerance &&
                           std::abs(p[1] - q[1]) <= tolerance && std::abs(p[2] - q[2]) <= tolerance;
                }
            if (masked) continue;
            ++all;
            hit += met ? 1 : 0;
        }
    return all ? 100.0 * hit / all : 0.0;
}

image::Image cropped(const image::Image& image, int left, int top, int width, int height) {
    image::Image out{width, height, {}};
    for (int y = 0; y < height; ++y) {
        const auto* row =
            &image.pixels[static_cast<std::size_t>((top + y) * image.width + left) * 4];
        out.pixels.insert(out.pixels.end(), row, row + width * 4);
    }
    return out;
}

/// Runs picture.py and reads the one number that it prints.
double measure(const std::string& arguments) {
    const std::string command =
        "python3 '" + (kShared / "tools" / "picture.py").string() + "' " + arguments;
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"),
                                                               &pclose);
    REQUIRE(pipe);
    double value = -1.0;
    REQUIRE(std::fscanf(pipe.get(), "%lf", &value) == 1);
    return value;
}

std::string shellQuoted(const fs::path& path) { return "'" + path.string() + "' "; }

}  // namespace

TEST_CASE("course phases 1 and 2: the wireframes are those of the course") {
    requireData();
    struct Case {
        const char* scene;
        const char* crop;
        double least;
    };
    // 1_1 and 1_2: the cone's base and the axes fight for depth. 1_4: clip edges of the far plane.
    const Case one = GENERATE(values<Case>({
        {"phase_1/test_1_1", "1,31,512,512", 91.0},
        {"phase_1/test_1_2", "1,31,512,512", 93.0},
        {"phase_1/test_1_3", "1,31,512,512", 99.5},
        {"phase_1/test_1_4", "1,31,512,512", 96.0},
        {"phase_1/test_1_5", "1,31,512,512", 99.5},
        {"phase_2/test_2_1", "1,31,512,512", 99.5},
        {"phase_2/test_2_2", "1,31,512,512", 99.5},
        {"phase_2/test_2_3", "1,30,512,510", 99.5},
        {"phase_2/test_2_4", "0,31,512,511", 99.5},
    }));
    const fs::path base = kShared / "data" / "course" / one.scene;
    const fs::path ours = renderTo(base.string() + ".xml", {{"axes", "1"}, {"aa", "1"}});
    const double met = measure("lines " + shellQuoted(ours) + shellQuoted(base.string() + ".png") +
                               "--crop-b " + one.crop);
    std::cout << one.scene << ": " << met << " % of lines met\n";
    CHECK(met >= one.least);
}

TEST_CASE("course phase 4: lit and textured scenes are those of the course") {
    requireData();
    struct Case {
        const char* scene;
        const char* picture;
        const char* measure;
        double least;
    };
    // 4_6: the plane's rows stand in a wrong order in the expected picture: 95 % can be met.
    const Case one = GENERATE(values<Case>({
        {"test_4_1.xml", "4_1.png", " 6", 99.9},
        {"test_4_2.xml", "4_2.png", " 6", 99.9},
        {"test_4_6.xml", "4_6.png", " 24 --mask-axes", 94.0},
    }));
    const fs::path folder = kShared / "data" / "course" / "phase_4";
    const fs::path ours =
        renderTo(folder / one.scene,
                 {{"axes", "1"}, {"aa", "1"}, {"shading", "gouraud"}, {"filter", "linear"}});
    const double met = measure("fill " + shellQuoted(ours) + shellQuoted(folder / one.picture) +
                               one.measure + " --crop-b 1,31,512,512");
    std::cout << one.scene << ": " << met << " % of pixels met\n";
    CHECK(met >= one.least);
}

TEST_CASE("course scene 4_6, object by object") {
    requireData();
    const fs::path folder = kShared / "data" / "course" / "phase_4";
    const image::Image ours = image::decodeImage(
        readFile(
            renderTo(folder / "test_4_6.xml",
                     {{"axes", "1"}, {"aa", "1"}, {"shading", "gouraud"}, {"filter", "linear"}})),
        "ours");
    const image::Image theirs =
        cropped(image::decodeImage(readFile(folder / "4_6.png"), "4_6.png"), 1, 31, 512, 512);
    const image::Image ids =
        image::decodeImage(readFile(renderTo(folder / "test_4_6.xml", {{"layer", "id"}})), "ids");
    const auto idAt = [&](int x, int y) {
        return static_cast<int>(ids.pixels[static_cast<std::size_t>(y * 512 + x) * 4 + 2]);
    };
    const char* names[] = {"background", "plane", "cone", "sphere", "teapot", "box"};
    for (int id = 0; id <= 5; ++id) {
        const auto counts = [&](int x, int y) { return idAt(x, y) == id; };
        const double worst =
            std::min(share(ours, theirs, 24, counts), share(theirs, ours, 24, counts));
        std::cout << "4_6 " << names[id] << ": " << worst << " % of pixels met\n";
        // The expected plane has its rows of texture in a wrong order: the mesh's fault there.
        CHECK(worst >= (id == 1 ? 85.0 : 99.0));
    }
    const auto outside = [&](int x, int y) { return idAt(x, y) != 1; };
    const double rest =
        std::min(share(ours, theirs, 24, outside), share(theirs, ours, 24, outside));
    std::cout << "4_6 outside the plane: " << rest << " % of pixels met\n";
    CHECK(rest >= 99.0);
}
