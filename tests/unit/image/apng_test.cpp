#include "image/apng.h"

#include <catch2/catch.hpp>

#include "image/image_file.h"

using namespace farol;
using image::ApngWriter;
using image::Image;

namespace {

Image plain(int width, int height, std::uint8_t value) {
    Image image{width, height, {}};
    image.pixels.assign(static_cast<std::size_t>(width * height * 4), value);
    for (std::size_t i = 3; i < image.pixels.size(); i += 4) image.pixels[i] = 255;
    return image;
}

int count(const std::string& bytes, const std::string& chunk) {
    int found = 0;
    for (std::size_t at = bytes.find(chunk); at != std::string::npos;
         at = bytes.find(chunk, at + 4))
        ++found;
    return found;
}

}  // namespace

TEST_CASE("an animated PNG holds its frames, and shows the first to those who know no animation") {
    ApngWriter writer(3, 25.0, false);
    for (const int value : {10, 20, 30}) writer.add(plain(6, 4, static_cast<std::uint8_t>(value)));
    const std::string bytes = writer.finish();
    CHECK(count(bytes, "acTL") == 1);
    CHECK(count(bytes, "fcTL") == 3);
    CHECK(count(bytes, "IDAT") == 1);
    CHECK(count(bytes, "fdAT") == 2);
    CHECK(image::decodeImage(bytes, "a.png") == plain(6, 4, 10));
    // Sequence numbers run through control and data chunks: 0 | 1 2 | 3 4.
    std::size_t at = 0;
    for (const auto& [chunk, number] :
         {std::pair{"fcTL", 0}, {"fcTL", 1}, {"fdAT", 2}, {"fcTL", 3}, {"fdAT", 4}}) {
        at = bytes.find(chunk, at) + 4;
        CHECK(bytes[at + 3] == number);
    }
    // 25 frames a second: a delay of 1/25.
    const std::size_t delay = bytes.find("fcTL") + 4 + 20;
    CHECK(bytes[delay + 1] == 1);
    CHECK(bytes[delay + 3] == 25);
}

TEST_CASE("an animated PNG refuses frames of another size, and too few or too many") {
    ApngWriter writer(2, 10.0, true);
    writer.add(plain(6, 4, 0));
    CHECK_THROWS_AS(writer.add(plain(4, 6, 0)), std::invalid_argument);
    CHECK_THROWS_AS(writer.finish(), std::logic_error);
    writer.add(plain(6, 4, 1));
    CHECK_THROWS_AS(writer.add(plain(6, 4, 2)), std::invalid_argument);
}

TEST_CASE("an animated PNG is read as its first frame, however long the others are") {
    Image noise = plain(160, 160, 0);  // does not compress: 77 kB a frame
    std::uint32_t state = 1;
    for (std::size_t i = 0; i < noise.pixels.size(); ++i)
        if (i % 4 != 3)
            noise.pixels[i] =
                static_cast<std::uint8_t>((state = state * 1664525 + 1013904223) >> 24);
    ApngWriter writer(4, 25.0, false);
    writer.add(plain(160, 160, 10));
    for (int frame = 1; frame < 4; ++frame) writer.add(noise);
    const std::string bytes = writer.finish();
    CHECK(bytes.size() > 200 * 1000);
    CHECK(image::decodeImage(bytes, "a.png") == plain(160, 160, 10));
    CHECK_THROWS(image::decodeImage(bytes.substr(0, bytes.size() - 100), "cut.png"));
}
