// OpenEXR files, written byte by byte: without compression a chunk is a row's place, its size and
// its samples, channel after channel in the order of their names.
#include <bit>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "image/image_file.h"
#include "render/renderer.h"

using namespace farol;
using namespace farol::render;
using namespace std::string_literals;

namespace {

std::string le(std::uint64_t value, int bytes) {
    std::string out;
    for (; bytes > 0; --bytes, value >>= 8U) out.push_back(static_cast<char>(value & 255U));
    return out;
}

std::string attribute(const std::string& name, const std::string& type, const std::string& value) {
    return name + '\0' + type + '\0' + le(value.size(), 4) + value;
}

struct Box {
    int left, top, right, bottom;
    std::string bytes() const {
        std::string out;
        for (const int value : {left, top, right, bottom})
            out += le(static_cast<std::uint32_t>(value), 4);
        return out;
    }
};

/// 32-bit floats without compression.
struct Exr {
    Box data, display = data;
    std::string channels;                  ///< names of one letter, in the order of the alphabet
    std::vector<std::vector<float>> rows;  ///< of each row first all samples of the first channel
    unsigned flags = 0, compression = 0, sampling = 1;
    std::string more = {};  ///< attributes

    std::string head() const {
        std::string list;
        for (const char c : channels)
            list += c + "\0"s + le(2, 4) + le(0, 4) + le(sampling, 4) + le(sampling, 4);
        return attribute("channels", "chlist", list + '\0') +
               attribute("compression", "compression", le(compression, 1)) +
               attribute("dataWindow", "box2i", data.bytes()) +
               attribute("displayWindow", "box2i", display.bytes()) +
               attribute("lineOrder", "lineOrder", "\0"s) +
               attribute("pixelAspectRatio", "float", "\0\0\x80\x3f"s) +
               attribute("screenWindowCenter", "v2f", std::string(8, '\0')) +
               attribute("screenWindowWidth", "float", "\0\0\x80\x3f"s) + more + '\0';
    }
    /// `parts`: heads of further parts.
    std::string bytes(const std::string& parts = {}) const {
        std::string out = "\x76\x2f\x31\x01"s + le(2 | flags, 4) + head() + parts, chunks;
        const bool isTiled = (flags & 0x200U) != 0;
        for (std::size_t y = 0; y < rows.size(); ++y) {
            out += le(0, 8);
            if ((flags & 0x1000U) != 0) chunks += le(0, 4);
            chunks +=
                isTiled ? le(y, 4) + le(0, 12) : le(static_cast<std::uint32_t>(data.top) + y, 4);
            chunks += le(rows[y].size() * 4, 4);
            for (const float value : rows[y]) chunks += le(std::bit_cast<std::uint32_t>(value), 4);
        }
        // The table holds where each chunk begins.
        std::size_t at = out.size();
        for (std::size_t y = 0; y < rows.size(); ++y) {
            out.replace(out.size() - (rows.size() - y) * 8, 8, le(at, 8));
            at += chunks.size() / rows.size();
        }
        return out + chunks;
    }
};

std::string show(const image::Image& image) {
    std::string out;
    char text[12];
    for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
        std::snprintf(text, sizeof text, "%02x%02x%02x%02x", image.pixels[i], image.pixels[i + 1],
                      image.pixels[i + 2], image.pixels[i + 3]);
        const bool isRow = i > 0 && i / 4 % static_cast<std::size_t>(image.width) == 0;
        out += (i == 0 ? "" : isRow ? "/" : " ") + std::string(text);
    }
    return out;
}

std::string decoded(const std::string& bytes) { return show(image::decodeImage(bytes, "a.exr")); }

std::string refusal(const std::string& bytes) {
    try {
        return "an image of " + decoded(bytes);
    } catch (const Error& error) {
        return error.code() + ": " + error.what();
    }
}

bool isRefused(const std::string& bytes, const std::string& reason) {
    const std::string text = refusal(bytes);
    INFO(text);
    CHECK(text.find(reason) != std::string::npos);
    return text.rfind("image.unreadable: ", 0) == 0;
}

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

}  // namespace

TEST_CASE("OpenEXR: values from 0 to 1, others clamped") {
    CHECK(decoded(Exr{{0, 0, 1, 1},
                      {0, 0, 1, 1},
                      "BGR",
                      {{0.2F, 0, 0.4F, kNan, 0.6F, 1}, {-1, 2, -kInfinity, 0, kInfinity, 1}}}
                      .bytes()) == "996633ff ff0000ff/ff0000ff ff00ffff");
    CHECK(decoded(Exr{{0, 0, 1, 0}, {0, 0, 1, 0}, "Y", {{0.2F, 7}}}.bytes()) ==
          "333333ff ffffffff");
    // Alpha is multiplied in.
    CHECK(decoded(Exr{{0, 0, 2, 0},
                      {0, 0, 2, 0},
                      "ABGR",
                      {{0.4F, 0, kNan, 0.2F, 1, 0, 0.4F, 0, 0, 0.1F, 0.6F, 1}}}
                      .bytes()) == "40ff8066 9900ff00 ff000000");
    // Channels that are not drawn.
    CHECK(decoded(Exr{{0, 0, 0, 0}, {0, 0, 0, 0}, "BGRXZ", {{0.2F, 0.4F, 0.6F, 9, 9}}}.bytes()) ==
          "996633ff");
}

TEST_CASE("OpenEXR: the display window is the image, black outside the data window") {
    const std::vector<std::vector<float>> rows{{0.2F, 0.4F}, {0.6F, 0.8F}};
    CHECK(decoded(Exr{{5, 6, 6, 7}, {4, 5, 7, 8}, "Y", rows}.bytes()) ==
          "000000ff 000000ff 000000ff 000000ff/000000ff 333333ff 666666ff 000000ff/"
          "000000ff 999999ff ccccccff 000000ff/000000ff 000000ff 000000ff 000000ff");
    CHECK(decoded(Exr{{-1, -1, 0, 0}, {0, 0, 0, 0}, "Y", rows}.bytes()) == "ccccccff");
    CHECK(decoded(Exr{{9, 9, 10, 10}, {0, 0, 0, 0}, "Y", rows}.bytes()) == "000000ff");
}

TEST_CASE("OpenEXR: tiles, and the first of several parts") {
    const std::string tiles = attribute("tiles", "tiledesc", le(2, 4) + le(2, 4) + le(0, 1));
    Exr tiled{{0, 0, 3, 1}, {0, 0, 3, 1}, "Y", {{0, 0.2F, 0.4F, 0.6F}, {0.8F, 1, 0.2F, 0}}, 0x200};
    tiled.more = tiles;
    CHECK(decoded(tiled.bytes()) ==
          "000000ff 333333ff ccccccff ffffffff/666666ff 999999ff 333333ff 000000ff");

    const auto partOf = [](const std::string& name, const std::string& type) {
        return attribute("name", "string", name) + attribute("type", "string", type) +
               attribute("chunkCount", "int", le(1, 4));
    };
    // Each part has one chunk; the second's is left out of the file, and never read.
    Exr first{{0, 0, 0, 0}, {0, 0, 0, 0}, "Y", {{0.4F}}, 0x1000};
    Exr second = first;
    first.more = partOf("a", "scanlineimage");
    second.more = partOf("b", "scanlineimage");
    const std::string file = first.bytes(second.head() + '\0');
    const std::size_t chunk = file.size() - 16;
    const std::string whole = file.substr(0, chunk - 8) + le(chunk + 8, 8) + le(chunk + 8, 8) +
                              file.substr(chunk) + le(1, 4) + file.substr(chunk + 4);
    CHECK(decoded(whole) == "666666ff");
    second.more = partOf("b", "deepscanline");
    CHECK(isRefused(first.bytes(second.head() + '\0'), "deep images are not read"));
}

TEST_CASE("OpenEXR that is not read says why") {
    const Exr grey{{0, 0, 1, 1}, {0, 0, 1, 1}, "Y", {{0, 1}, {1, 0}}};
    Exr exr = grey;
    exr.flags = 0x800;
    CHECK(isRefused(exr.bytes(), "deep images are not read"));
    exr = grey;
    exr.channels = "Z";
    CHECK(isRefused(exr.bytes(), "no channels R, G and B or Y"));
    exr = grey;
    exr.sampling = 2;
    CHECK(isRefused(exr.bytes(), "no channels R, G and B or Y of full size"));
    exr = grey;
    exr.compression = 10;
    CHECK(isRefused(exr.bytes(), "compression 10 is not read"));
    exr = grey;
    exr.more = attribute("preview", "preview", le(9, 4) + le(9, 4) + "123");
    CHECK(isRefused(exr.bytes(), "preview"));
    exr = grey;
    exr.data = {5, 5, 4, 4};
    CHECK(isRefused(exr.bytes(), "no pixels"));
    exr = grey;
    exr.rows.pop_back();
    CHECK(isRefused(exr.bytes(), "OpenEXR"));
    const std::string whole = grey.bytes();
    for (std::size_t size = 4; size < whole.size(); ++size)
        if (!isRefused(whole.substr(0, size), "OpenEXR")) FAIL(size << " bytes");
}

TEST_CASE("OpenEXR: sizes are bounded before memory is allocated") {
    Exr exr{{0, 0, 8191, 8191}, {0, 0, 8191, 8191}, "Y", {{1}}};
    CHECK(isRefused(exr.bytes(), "too much memory"));
    exr.data = {0, 0, 4095, 4095};
    CHECK(isRefused(exr.bytes(), "cut off"));  // no room for 4096 chunks
    exr.data = {0, 0, 0, 0};
    CHECK(refusal(exr.bytes()).rfind("limit.texture: ", 0) == 0);
    exr.display = {-0x7fffffff - 1, 0, 0x7fffffff, 0};
    CHECK(isRefused(exr.bytes(), "size is out of range"));
    exr.display = exr.data;
    exr.data = {0, 0, 99999, 0};
    CHECK(isRefused(exr.bytes(), "at most 65536"));
    exr.data = {0, 0, 0, 0};
    exr.flags = 0x200;
    exr.more = attribute("tiles", "tiledesc", le(65536, 4) + le(65536, 4) + le(0, 1));
    CHECK(isRefused(exr.bytes(), "too much memory"));
}

TEST_CASE("a skybox from an OpenEXR file") {
    Exr sky{{0, 0, 7, 5}, {0, 0, 7, 5}, "BGR", {}};
    for (int y = 0; y < 6; ++y) {
        std::vector<float> row(8, 0.0F);
        row.resize(16, 0.2F);
        row.resize(24, 4.0F);
        sky.rows.push_back(row);
    }
    Job job;
    job.xml =
        "<scene><skybox width='500' texture='sky.exr'/><models><model command='sphere 0.001 4 "
        "4'/></models></scene>";
    job.options.width = job.options.height = 16;
    applyOption(job.options, "eye", "0,0,0.1");
    applyOption(job.options, "target", "10,0,0.1");
    job.assets =
        std::make_shared<scene::BundleAssets>(scene::BundleAssets::Files{{"sky.exr", sky.bytes()}});
    const Picture picture = Renderer().render(job);
    const image::Image image = image::decodeImage(picture.bytes, "a.png");
    for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
        REQUIRE(image.pixels[i] == 255);
        REQUIRE(image.pixels[i + 1] == 51);
        REQUIRE(image.pixels[i + 2] == 0);
    }
}
