// Videos by the module of FFmpeg's libraries, and sheets of frames.
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "image/image_file.h"
#include "tests/cli/run.h"
#include "tests/support/paths.h"
#include "tests/support/skip.h"

using namespace farol::test;
using nlohmann::json;

namespace {

bool hasModule() {
    return std::filesystem::exists(std::filesystem::path(kProgram).parent_path() /
                                   "libfarol_video.so");
}

/// Facts of a video by ffprobe: its stream, and the times of its frames.
json probe(const std::string& name) {
    const std::string command =
        "ffprobe -v error -count_frames -show_streams -show_frames -of json '" +
        (folder() / name).string() + "'";
    FILE* pipe = popen(command.c_str(), "r");
    REQUIRE(pipe != nullptr);
    std::string text;
    char block[4096];
    for (std::size_t n = 0; (n = fread(block, 1, sizeof block, pipe)) > 0;) text.append(block, n);
    REQUIRE(pclose(pipe) == 0);
    return json::parse(text);
}

}  // namespace

TEST_CASE("without the video module the error names the fix, and other formats are written") {
    namespace fs = std::filesystem;
    freshFolder();
    writeFile("scene.xml", turningScene());
    fs::create_directories(folder() / "bin");
    fs::copy_file(kProgram, folder() / "bin" / "farol");
    const auto draw = [&](const std::string& output) {
        const std::string command = "cd '" + folder().string() +
                                    "' && bin/farol render scene.xml -o " + output +
                                    " --fps 4 --width 16 --height 16 2>errors";
        return WEXITSTATUS(std::system(command.c_str()));
    };
    for (const char* output : {"loop.mp4", "loop.webm"}) {
        CHECK(draw(output) == 2);
        CHECK_THAT(readFile("errors"), Catch::Contains("option.unavailable") &&
                                           Catch::Contains("FAROL_VIDEO=ON") &&
                                           Catch::Contains("libfarol_video.so"));
        CHECK_FALSE(exists(output));
    }
    CHECK(draw("loop.gif") == 0);
    REQUIRE(std::system(("'" + (folder() / "bin/farol").string() + "' version --json >'" +
                         (folder() / "version").string() + "'")
                            .c_str()) == 0);
    CHECK(json::parse(readFile("version"))["animations"] == json{"apng", "animated-webp", "gif"});
}

TEST_CASE("the version lists videos where their module is installed") {
    json formats = {"apng", "animated-webp", "gif"};
    if (hasModule()) formats.insert(formats.end(), {"mp4", "webm"});
    CHECK(json::parse(run("version --json").out)["animations"] == formats);
}

TEST_CASE("a video has the frames of one loop at a constant rate") {
    if (!hasModule()) skip("no video module (-DFAROL_VIDEO=ON)");
    if (!hasProgram("ffprobe")) skipMissing("no ffprobe (scripts/setup video)");
    freshFolder();
    writeFile("scene.xml", turningScene());
    for (const auto& [name, codec] :
         {std::pair("loop.mp4", "h264"), std::pair("loop.webm", "vp9")}) {
        const Outcome drawn = run(std::string("render scene.xml -o ") + name +
                                  " --fps 25 --width 63 --height 47 --json");
        INFO(name << drawn.err << drawn.out);
        REQUIRE(drawn.status == 0);
        CHECK(json::parse(drawn.out)["frames"] == 50);
        const json found = probe(name);
        const json& stream = found["streams"][0];
        CHECK(stream["codec_name"] == codec);
        CHECK(stream["pix_fmt"] == "yuv420p");
        CHECK(stream["color_space"] == "bt709");
        // Chroma has half the size.
        CHECK(stream["width"] == 64);
        CHECK(stream["height"] == 48);
        CHECK(stream["avg_frame_rate"] == "25/1");
        REQUIRE(found["frames"].size() == 50);
        for (std::size_t i = 0; i < 50; ++i)
            CHECK(std::stod(found["frames"][i]["best_effort_timestamp_time"].get<std::string>()) ==
                  Approx(static_cast<double>(i) / 25.0).margin(0.0006));  // WebM counts ms
        // The same frames give the same bytes.
        const std::string first = readFile(name);
        REQUIRE(run(std::string("render scene.xml -o ") + name + " --fps 25 --width 63 --height 47")
                    .status == 0);
        CHECK(readFile(name) == first);
    }
}

TEST_CASE("a video shows the frames that are drawn") {
    if (!hasModule()) skip("no video module (-DFAROL_VIDEO=ON)");
    if (!hasProgram("ffmpeg")) skipMissing("no ffmpeg (scripts/setup video)");
    freshFolder();
    writeFile("scene.xml", turningScene());
    REQUIRE(run("render scene.xml -o f-%d.png --frames 8 --width 96 --height 64").status == 0);
    for (const char* name : {"loop.mp4", "loop.webm"}) {
        REQUIRE(
            run(std::string("render scene.xml -o ") + name + " --frames 8 --width 96 --height 64")
                .status == 0);
        const std::string command = "cd '" + folder().string() + "' && ffmpeg -v error -y -i " +
                                    name + " -start_number 0 v-%d.png";
        REQUIRE(std::system(command.c_str()) == 0);
        for (const int i : {0, 3, 7}) {
            const std::string number = std::to_string(i) + ".png";
            const auto a = farol::image::decodeImage(readFile("f-" + number), "f");
            const auto b = farol::image::decodeImage(readFile("v-" + number), "v");
            REQUIRE(a.pixels.size() == b.pixels.size());
            double sum = 0.0;
            for (std::size_t k = 0; k < a.pixels.size(); ++k)
                sum += std::abs(a.pixels[k] - b.pixels[k]);
            INFO(name << " frame " << i);
            CHECK(sum / static_cast<double>(a.pixels.size()) < 3.0);
        }
    }
}

TEST_CASE("a name of a video alone asks for a loop of 24 frames a second") {
    freshFolder();
    writeFile("scene.xml", turningScene());
    const Outcome drawn = run("render scene.xml -o loop.gif --width 16 --height 16 --json");
    INFO(drawn.err);
    REQUIRE(drawn.status == 0);
    CHECK(json::parse(drawn.out)["frames"] == 48);
    writeFile("still.xml", kScene);
    CHECK(run("render still.xml -o loop.gif --width 16 --height 16").status == 2);
}

TEST_CASE("a sheet holds the frames of a loop row by row, or views from all sides") {
    using farol::image::decodeImage;
    freshFolder();
    writeFile("scene.xml", turningScene());
    REQUIRE(run("render scene.xml -o f-%d.png --frames 6 --width 40 --height 30").status == 0);
    const Outcome drawn =
        run("render scene.xml -o sheet.png --sheet 3x2 --width 40 --height 30 --json");
    INFO(drawn.err);
    REQUIRE(drawn.status == 0);
    CHECK(json::parse(drawn.out)["width"] == 120);
    const auto sheet = decodeImage(readFile("sheet.png"), "sheet");
    REQUIRE(sheet.width == 120);
    REQUIRE(sheet.height == 60);
    for (int i = 0; i < 6; ++i) {
        const auto frame = decodeImage(readFile("f-" + std::to_string(i) + ".png"), "frame");
        bool isEqual = true;
        for (int y = 0; y < 30; ++y)
            isEqual =
                isEqual &&
                std::equal(frame.pixels.begin() + y * 160, frame.pixels.begin() + (y + 1) * 160,
                           sheet.pixels.begin() + ((i / 3 * 30 + y) * 120 + i % 3 * 40) * 4);
        CHECK(isEqual);
    }
    // Views of a still scene: the first is its own, the others differ.
    std::string still = kScene;
    still.insert(still.find("<models>"), "<transform><translate x=\"0.7\"/></transform>");
    writeFile("still.xml", still);
    REQUIRE(run("render still.xml -o views.png --sheet 4x1 --width 40 --height 30").status == 0);
    REQUIRE(run("render still.xml -o one.png --width 40 --height 30").status == 0);
    const auto views = decodeImage(readFile("views.png"), "views");
    const auto one = decodeImage(readFile("one.png"), "one");
    const auto part = [&](int k, int y) { return views.pixels.begin() + (y * 160 + k * 40) * 4; };
    bool isFirst = true, isOther = false;
    for (int y = 0; y < 30; ++y) {
        isFirst = isFirst && std::equal(part(0, y), part(0, y) + 160, one.pixels.begin() + y * 160);
        isOther = isOther || !std::equal(part(1, y), part(1, y) + 160, part(0, y));
    }
    CHECK(isFirst);
    CHECK(isOther);
    for (const char* wrong : {"4", "0x3", "4x65", "4x3x2", "x"})
        CHECK(run(std::string("render still.xml -o v.png --sheet ") + wrong).status == 2);
    CHECK(run("render still.xml -o v.png --sheet 64x64 --width 512 --height 512").status == 2);
}
