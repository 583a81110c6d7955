#include "image/animation.h"

#include <catch2/catch.hpp>

#include "image/format.h"
#include "image/frame_encoder.h"
#include "image/image_file.h"

using namespace farol;
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
    const auto writer = image::writeApng({3, 25.0});
    for (const int value : {10, 20, 30}) writer->add(plain(6, 4, static_cast<std::uint8_t>(value)));
    const std::string bytes = writer->finish();
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

TEST_CASE("an animated PNG is read as its first frame, however long the others are") {
    Image noise = plain(160, 160, 0);  // does not compress: 77 kB a frame
    std::uint32_t state = 1;
    for (std::size_t i = 0; i < noise.pixels.size(); ++i)
        if (i % 4 != 3)
            noise.pixels[i] =
                static_cast<std::uint8_t>((state = state * 1664525 + 1013904223) >> 24);
    const auto writer = image::writeApng({4, 25.0});
    writer->add(plain(160, 160, 10));
    for (int frame = 1; frame < 4; ++frame) writer->add(noise);
    const std::string bytes = writer->finish();
    CHECK(bytes.size() > 200 * 1000);
    CHECK(image::decodeImage(bytes, "a.png") == plain(160, 160, 10));
    CHECK_THROWS(image::decodeImage(bytes.substr(0, bytes.size() - 100), "cut.png"));
}

namespace {

std::uint16_t u16At(const std::string& bytes, std::size_t at) {
    return static_cast<std::uint16_t>(static_cast<unsigned char>(bytes[at]) |
                                      static_cast<unsigned char>(bytes[at + 1]) << 8);
}

/// The delays of a GIF's frames, 1/100 s, by their graphics control extensions.
std::vector<int> gifDelays(const std::string& bytes) {
    std::vector<int> delays;
    const std::string mark("\x21\xF9\x04", 3);
    for (std::size_t at = bytes.find(mark); at != std::string::npos; at = bytes.find(mark, at + 3))
        delays.push_back(u16At(bytes, at + 4));
    return delays;
}

}  // namespace

TEST_CASE("a GIF loops, keeps its rate without drift, and is read as its first frame") {
    const auto writer = image::writeGif({6, 30.0});
    for (int i = 0; i < 6; ++i) writer->add(plain(6, 4, static_cast<std::uint8_t>(40 * i + 10)));
    const std::string bytes = writer->finish();
    CHECK(bytes.starts_with("GIF89a"));
    CHECK(count(bytes, "NETSCAPE2.0") == 1);
    // 30 frames a second: 3.33 hundredths.
    CHECK(gifDelays(bytes) == std::vector<int>{3, 4, 3, 3, 4, 3});
    CHECK(image::decodeImage(bytes, "a.gif") == plain(6, 4, 10));
}

TEST_CASE("a GIF keeps two hundred colours exactly, and transparent pixels") {
    Image image = plain(20, 10, 0);
    for (std::size_t i = 0; i < 200; ++i) {
        image.pixels[4 * i] = static_cast<std::uint8_t>(i);
        image.pixels[4 * i + 1] = static_cast<std::uint8_t>(255 - i);
        image.pixels[4 * i + 3] = i % 3 == 0 ? 0 : 255;
    }
    const auto writer = image::writeGif({1, 10.0, true});
    writer->add(image);
    const Image back = image::decodeImage(writer->finish(), "a.gif");
    for (std::size_t i = 0; i < 200; ++i) {
        CHECK(back.pixels[4 * i + 3] == image.pixels[4 * i + 3]);
        if (i % 3 == 0) continue;
        CHECK(back.pixels[4 * i] == image.pixels[4 * i]);
        CHECK(back.pixels[4 * i + 1] == image.pixels[4 * i + 1]);
    }
}

TEST_CASE("an animated WebP holds its frames and times") {
    const auto writer = image::writeAnimatedWebp({3, 24.0, false, 90});
    for (const int value : {10, 120, 230})
        writer->add(plain(32, 16, static_cast<std::uint8_t>(value)));
    const std::string bytes = writer->finish();
    CHECK(bytes.starts_with("RIFF"));
    CHECK(count(bytes, "ANMF") == 3);
    // A frame's duration: 24 bits, 12 bytes into its chunk.
    std::vector<int> times;
    for (std::size_t at = bytes.find("ANMF"); at != std::string::npos;
         at = bytes.find("ANMF", at + 4))
        times.push_back(u16At(bytes, at + 8 + 12));
    CHECK(times == std::vector<int>{42, 41, 42});
}

TEST_CASE("frames that are encoded beside their drawing give the same bytes, and their errors") {
    const auto frameOf = [](int i) { return plain(24, 16, static_cast<std::uint8_t>(11 * i)); };
    const auto alone = image::writeApng({20, 25.0});
    for (int i = 0; i < 20; ++i) alone->add(frameOf(i));
    const auto beside = image::writeApng({20, 25.0});
    {
        image::FrameEncoder encoder(*beside);
        for (int i = 0; i < 20; ++i) encoder.add(frameOf(i));
        encoder.finish();
    }
    CHECK(beside->finish() == alone->finish());

    const auto few = image::writeApng({2, 25.0});
    image::FrameEncoder encoder(*few);
    const auto addAll = [&] {
        for (int i = 0; i < 20; ++i) encoder.add(frameOf(i));
        encoder.finish();
    };
    CHECK_THROWS_AS(addAll(), std::invalid_argument);
}

TEST_CASE("every writer refuses frames of another size, and too few or too many") {
    for (const image::AnimationSpec& format : image::kAnimations) {
        INFO(format.name);
        std::unique_ptr<image::AnimationWriter> writer;
        try {
            writer = format.write({2, 10.0, true, 80});
        } catch (const Error& error) {
            CHECK(error.code() == "option.unavailable");  // the module is built on request
            CHECK(format.mime.starts_with("video/"));
            continue;
        }
        writer->add(plain(6, 4, 0));
        CHECK_THROWS_AS(writer->add(plain(4, 6, 0)), std::invalid_argument);
        CHECK_THROWS_AS(writer->finish(), std::logic_error);
        writer->add(plain(6, 4, 200));
        CHECK_THROWS_AS(writer->add(plain(6, 4, 2)), std::invalid_argument);
        CHECK(image::matches(writer->finish(), format.signature));
    }
}

TEST_CASE("a GIF of more colours than it can have is off by a step of its quantizer at most") {
    Image image = plain(64, 64, 0);
    for (std::size_t i = 0; i < 64 * 64; ++i) {
        image.pixels[4 * i] = static_cast<std::uint8_t>(i % 64);
        image.pixels[4 * i + 1] = static_cast<std::uint8_t>(i / 64);
    }
    const auto writer = image::writeGif({1, 10.0});
    writer->add(image);
    const Image back = image::decodeImage(writer->finish(), "a.gif");
    int farthest = 0;
    for (std::size_t i = 0; i < back.pixels.size(); ++i)
        farthest = std::max(farthest, std::abs(back.pixels[i] - image.pixels[i]));
    CHECK(farthest <= 8);  // five bits a channel
}
