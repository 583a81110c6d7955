// The decoders of PNG, JPEG and WebP against OpenImageIO, which reads all formats.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "render/decoder.h"
#include "render/encode.h"
#include "render/image_file.h"

using namespace farol;
using namespace farol::render;

namespace {

std::string bytesOf(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

Image painted(int width, int height, bool opaque) {
    Image image{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (const int value : {x * 7, y * 5, x * y, opaque ? 255 : 40 + x + y})
                image.pixels.push_back(static_cast<std::uint8_t>(value));
    return image;
}

int largestDifference(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
    int largest = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

/// Colours without alpha get one of 255.
void addAlpha(Decoded& picture) {
    if (picture.channels != 3) return;
    std::vector<std::uint8_t> wider;
    for (std::size_t i = 0; i < picture.samples.size(); i += 3) {
        wider.insert(wider.end(), &picture.samples[i], &picture.samples[i] + 3);
        wider.push_back(255);
    }
    picture.samples = std::move(wider);
    picture.channels = 4;
}

void checkAgainstModule(const char* format, const std::string& bytes,
                        void (*read)(std::string_view, bool, Decoded&)) {
    Decoded ours, theirs, head;
    read(bytes, true, ours);
    read(bytes, false, head);
    readByModule(format, bytes, true, theirs);
    CHECK(ours.width == theirs.width);
    CHECK(ours.height == theirs.height);
    CHECK(head.width == ours.width);
    CHECK(head.channels == ours.channels);
    addAlpha(ours);
    addAlpha(theirs);
    REQUIRE(ours.channels == theirs.channels);
    REQUIRE(ours.samples.size() == theirs.samples.size());
    CHECK(head.samples.empty());
    CHECK(largestDifference(ours.samples, theirs.samples) == 0);
}

}  // namespace

TEST_CASE("pictures are decoded as OpenImageIO decodes them") {
    for (const bool opaque : {true, false})
        checkAgainstModule("png", encodePng(painted(37, 23, opaque)), readPng);
    checkAgainstModule("jpeg", encodeJpeg(painted(37, 23, true), 80), readJpeg);
    checkAgainstModule("webp", encodeWebp(painted(37, 23, true), 80), readWebp);
}

TEST_CASE("the pictures of the example scenes are decoded as OpenImageIO decodes them") {
    int pngs = 0, jpegs = 0;
    for (const char* root : {"/scenes", "/docs", "/tests/golden", "/tests/fuzz/seeds/image"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(
                 std::string(FAROL_SOURCE_DIR) + root,
                 std::filesystem::directory_options::skip_permission_denied)) {
            const std::string ending = entry.path().extension().string();
            const bool png = ending == ".png", jpeg = ending == ".jpg" || ending == ".jpeg";
            if (!png && !jpeg) continue;
            const std::string bytes = bytesOf(entry.path());
            INFO(entry.path().string());
            Decoded probe;
            try {
                png ? readPng(bytes, true, probe) : readJpeg(bytes, true, probe);
            } catch (const std::exception&) {
                Decoded theirs;
                CHECK_THROWS(readByModule(png ? "png" : "jpeg", bytes, true, theirs));
                continue;
            }
            checkAgainstModule(png ? "png" : "jpeg", bytes, png ? readPng : readJpeg);
            ++(png ? pngs : jpegs);
        }
    CHECK(pngs > 0);
    WARN(pngs << " PNG and " << jpegs << " JPEG files compared");
}

TEST_CASE("a format that nobody reads is refused by the module with its reason") {
    Decoded out;
    CHECK_THROWS_WITH(readByModule("nosuchformat", "abc", true, out),
                      Catch::Contains("nosuchformat"));
}
