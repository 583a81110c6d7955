#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>

#include "image/format.h"
#include "image/image_file.h"
#include "render/renderer.h"
#include "tests/support/paths.h"

// Every example scene against the picture it gave when somebody last looked at it, and against a
// budget of draw calls. FAROL_UPDATE_GOLDENS=1 writes the pictures anew and fails: look at them,
// then commit them.
using namespace farol;
namespace fs = std::filesystem;

namespace {

const fs::path kSource(farol::test::kSourceDir);
const fs::path kGolden = kSource / "tests" / "golden";
constexpr int kMaxSide = 320;  // px

struct Golden {
    std::string scene;
    double timeS = 0.0;
    int drawCalls = 0;
};

std::string readFile(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void writeFile(const fs::path& path, const std::string& bytes) {
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << bytes;
}

/// Lines of `scene time draw-calls`; # begins a comment.
std::vector<Golden> goldens() {
    std::vector<Golden> all;
    std::istringstream in(readFile(kGolden / "goldens.txt"));
    for (std::string line; std::getline(in, line);) {
        if (line.empty() || line[0] == '#') continue;
        std::istringstream fields(line);
        Golden one;
        if (!(fields >> one.scene >> one.timeS >> one.drawCalls))
            throw std::runtime_error("goldens.txt has a bad line: " + line);
        all.push_back(one);
    }
    return all;
}

std::set<std::string> sceneFolders() {
    std::set<std::string> all;
    for (const auto& entry : fs::directory_iterator(kSource / "scenes"))
        if (fs::exists(entry.path() / "scene.xml")) all.insert(entry.path().filename().string());
    return all;
}

render::Job jobOf(const std::string& scene, double timeS) {
    const fs::path folder = kSource / "scenes" / scene;
    render::Job job;
    job.name = "scene.xml";
    job.xml = readFile(folder / "scene.xml");
    job.assets = std::make_shared<scene::FolderAssets>(folder.string());
    job.options.timeS = timeS;
    const render::SceneReport report = render::inspect(job);
    const double scale = static_cast<double>(kMaxSide) / std::max(report.width, report.height);
    job.options.width = static_cast<int>(std::lround(report.width * scale));
    job.options.height = static_cast<int>(std::lround(report.height * scale));
    return job;
}

}  // namespace

TEST_CASE("every example scene has a golden") {
    std::set<std::string> listed;
    for (const Golden& one : goldens()) listed.insert(one.scene);
    CHECK(sceneFolders() == listed);
}

TEST_CASE("example scenes give their golden pictures within their draw-call budgets") {
    render::Renderer renderer;
    const bool update = std::getenv("FAROL_UPDATE_GOLDENS") != nullptr;
    for (const Golden& one : goldens()) {
        std::ostringstream name;
        name << one.scene << "-t" << one.timeS << ".png";
        CAPTURE(name.str());
        const render::Picture picture = renderer.render(jobOf(one.scene, one.timeS));
        for (const Diagnostic& finding : picture.diagnostics) {
            INFO(finding.message);
            CHECK(finding.severity == Severity::info);  // our own scenes are clean
        }
        if (picture.stats.drawCalls > one.drawCalls || update)
            std::cout << name.str() << ": " << picture.stats.drawCalls << " draw calls\n";
        CHECK(picture.stats.drawCalls <= one.drawCalls);
        const fs::path path = kGolden / "images" / name.str();
        if (update) writeFile(path, picture.bytes);
        CHECK_FALSE(update);
        if (!fs::exists(path)) {
            writeFile(fs::path(farol::test::kTestOutput) / name.str(), picture.bytes);
            FAIL_CHECK(
                "there is no golden picture; run with FAROL_UPDATE_GOLDENS=1 and look at it");
            continue;
        }
        const std::string bytes = readFile(path);
        if (bytes == picture.bytes) continue;
        const image::Image want = image::decodeImage(bytes, name.str());
        const image::Image have = image::decodeImage(picture.bytes, name.str());
        REQUIRE(want.width == have.width);
        REQUIRE(want.height == have.height);
        // Another processor may round the last bit otherwise: 2 levels, 0.05 % of the pixels.
        int most = 0;
        std::size_t different = 0;
        image::Image difference = have;
        for (std::size_t i = 0; i < want.pixels.size(); i += 4) {
            int worst = 0;
            for (std::size_t c = 0; c < 3; ++c) {
                const int d = std::abs(int{want.pixels[i + c]} - int{have.pixels[i + c]});
                worst = std::max(worst, d);
                difference.pixels[i + c] = static_cast<std::uint8_t>(std::min(255, d * 16));
            }
            most = std::max(most, worst);
            different += worst > 0 ? 1 : 0;
        }
        const double share =
            100.0 * static_cast<double>(different) * 4.0 / static_cast<double>(want.pixels.size());
        if (most > 2 || share > 0.05) {
            writeFile(fs::path(farol::test::kTestOutput) / name.str(), picture.bytes);
            writeFile(fs::path(farol::test::kTestOutput) / ("diff-" + name.str()),
                      image::encodePng(difference));
        }
        CHECK(most <= 2);
        CHECK(share <= 0.05);
    }
}

TEST_CASE("the scenes that must be refused are, with the code their first comment names") {
    int files = 0;
    for (const auto& entry : fs::directory_iterator(kSource / "scenes" / "refused")) {
        if (entry.path().extension() != ".xml") continue;
        const std::string name = entry.path().filename().string();
        CAPTURE(name);
        render::Job job;
        job.name = name;
        job.xml = readFile(entry.path());
        job.assets = std::make_shared<scene::FolderAssets>(entry.path().parent_path().string());
        REQUIRE(job.xml.starts_with("<!-- "));
        const std::string code = job.xml.substr(5, job.xml.find(':') - 5);
        // A damaged picture is found only when it is drawn.
        try {
            render::Renderer().render(job);
            FAIL_CHECK("was rendered");
        } catch (const Error& error) {
            CHECK(error.code() == code);
            CHECK(error.primary().message.size() > 10);
        }
        ++files;
    }
    CHECK(files >= 10);
}
