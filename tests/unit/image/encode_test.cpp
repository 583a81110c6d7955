#include <sched.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <memory>

#include "image/format.h"
#include "image/image_file.h"

using namespace farol;
using image::Image;

namespace {

Image noise(int width, int height, bool opaque) {
    Image image{width, height, {}};
    unsigned state = 12345;
    for (int i = 0; i < width * height * 4; ++i) {
        state = state * 1664525U + 1013904223U;
        image.pixels.push_back(i % 4 == 3 && opaque ? std::uint8_t{255}
                                                    : static_cast<std::uint8_t>(state >> 24));
    }
    return image;
}

}  // namespace

TEST_CASE("a PNG holds exactly the pixels that went in") {
    const auto width = GENERATE(1, 2, 33, 512);
    const auto opaque = GENERATE(true, false);
    const Image image = noise(width, 17, opaque);
    const std::string png = image::encodePng(image);
    CHECK(png[25] == (opaque ? 2 : 6));  // colour type of IHDR
    CHECK(image::decodeImage(png, "a.png") == image);
}

TEST_CASE("a PNG of several stripes holds its pixels, in the same bytes on one processor") {
    const auto [width, height, opaque] = GENERATE(table<int, int, bool>(
        {{512, 512, true}, {701, 613, false}, {3, 90'001, true}, {140'000, 3, true}}));
    CAPTURE(width, height);
    Image image = noise(width, height, opaque);
    for (std::size_t i = 0; i < image.pixels.size() / 2; ++i)  // compressible in part
        if (i % 4 != 3) image.pixels[i] = static_cast<std::uint8_t>(i / 4096);
    const std::string png = image::encodePng(image);
    std::string damage;
    CHECK(image::decodeImage(png, "a.png", {}, &damage) == image);
    CHECK(damage.empty());  // the checksum of the whole is right

    cpu_set_t all, first;
    REQUIRE(sched_getaffinity(0, sizeof all, &all) == 0);
    CPU_ZERO(&first);
    for (int i = 0; i < CPU_SETSIZE && CPU_COUNT(&first) == 0; ++i)
        if (CPU_ISSET(i, &all)) CPU_SET(i, &first);
    REQUIRE(sched_setaffinity(0, sizeof first, &first) == 0);
    const std::string alone = image::encodePng(image);
    REQUIRE(sched_setaffinity(0, sizeof all, &all) == 0);
    CHECK(alone == png);
}

TEST_CASE("JPEG and WebP are read back as nearly the same picture") {
    Image image{64, 64, {}};
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            for (const int value : {x * 4, y * 4, 128, 255})
                image.pixels.push_back(static_cast<std::uint8_t>(value));
    const std::string bytes =
        GENERATE_REF(image::encodeJpeg(image, 90), image::encodeWebp(image, 90));
    const Image back = image::decodeImage(bytes, "a");
    REQUIRE(back.width == 64);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        REQUIRE(std::abs(int{image.pixels[i]} - int{back.pixels[i]}) <= 12);  // lossy at 90
}

TEST_CASE("bytes that are no picture are refused by name and place") {
    const std::string png = image::encodePng(noise(40, 40, true));
    const std::string bytes =
        GENERATE_COPY(std::string(), std::string("not a picture"), png.substr(0, 20),
                      png.substr(0, png.size() / 2), std::string("\xff\xd8\xff") + "junk",
                      std::string("GIF89a"), std::string("BM"), std::string("P6 -1 99999 255\n"),
                      std::string("RIFF____WEBP"), std::string("RIFF"));
    CAPTURE(bytes.size());
    try {
        image::decodeImage(bytes, "wood.png", {"scene.xml", 3, 7});
        FAIL("was taken for a picture");
    } catch (const Error& error) {
        CHECK(error.code() == "image.unreadable");
        CHECK(error.primary().where == Location{"scene.xml", 3, 7});
        CHECK(std::string(error.what()).find("wood.png") != std::string::npos);
    }
}

TEST_CASE("a canvas that decoders take memory for at once is refused by the head") {
    using namespace std::string_literals;
    const auto [name, bytes] = GENERATE(table<const char*, std::string>({
        {"a.gif", "GIF89a\xff\xff\xff\xff\0\0\0;"s},
        {"x.webp", "RIFF\x16\0\0\0WEBPVP8X\x0a\0\0\0\0\0\0\0\xff\xff\0\xff\xff\0"s},
        {"l.webp", "RIFF\x16\0\0\0WEBPVP8L\x0a\0\0\0\x2f\xff\xff\xff\x0f\0\0\0\0\0"s},
        {"s.webp", "RIFF\x16\0\0\0WEBPVP8 \x0a\0\0\0\0\0\0\x9d\x01\x2a\xff\x3f\xff\x3f"s},
    }));
    CAPTURE(name);
    try {
        image::decodeImage(bytes, name);
        FAIL("was taken for a picture");
    } catch (const Error& error) {
        CHECK(error.code() == "limit.texture");
    }
}

TEST_CASE("an image that claims to be huge is refused before memory is allocated") {
    std::string png = image::encodePng(noise(1, 1, true));
    const std::string width("\x00\x01\x86\xa0", 4);  // 100000
    png.replace(16, 4, width).replace(20, 4, width);
    CHECK_THROWS_AS(image::decodeImage(png, "a.png"), Error);
}

TEST_CASE("the same image gives the same bytes 10,000 times, whatever memory held before") {
    const std::vector<Image> images{noise(16, 16, true), noise(5, 3, false), Image{16, 16, {}}};
    Image plain = images[2];
    plain.pixels.assign(std::size_t{16} * 16 * 4, 255);
    const std::string first = image::encodePng(plain), second = image::encodePng(images[0]);
    int differing = 0;
    for (int i = 0; i < 10'000; ++i) {
        // Leaves other bytes in memory of the sizes that an encoder takes next.
        for (const std::size_t size : {1U << 12U, 1U << 16U, 1U << 17U, 1U << 18U, 1U << 19U}) {
            const auto dirty = std::make_unique<std::uint8_t[]>(size);
            std::fill_n(dirty.get(), size, static_cast<std::uint8_t>(i));
        }
        differing += image::encodePng(plain) == first ? 0 : 1;
        if (i % 10 == 0) differing += image::encodePng(images[0]) == second ? 0 : 1;
    }
    CHECK(differing == 0);
}

TEST_CASE("the encoders read no memory that they have not written", "[valgrind]") {
    const Image image = noise(40, 24, false);
    for (int i = 0; i < 3; ++i) {
        CHECK(!image::encodePng(image).empty());
        CHECK(!image::encodeJpeg(image, 80).empty());
        CHECK(!image::encodeWebp(image, 80).empty());
    }
}

TEST_CASE("each format's files begin as its row says and keep its bound") {
    using image::Format, image::FormatSpec, image::hasSignature;
    const Image dots = noise(64, 48, false);
    for (std::size_t i = 0; i < image::kFormats.size(); ++i) {
        const Format format{static_cast<std::uint8_t>(i)};
        const FormatSpec& spec = image::specOf(format);
        CAPTURE(spec.name);
        const std::string bytes = image::encode(dots, format, 100);
        for (std::size_t other = 0; other < image::kFormats.size(); ++other)
            CHECK(hasSignature(bytes, Format{static_cast<std::uint8_t>(other)}) == (other == i));
        CHECK_FALSE(hasSignature(bytes.substr(0, spec.signature.size() - 1), format));
        CHECK(static_cast<double>(bytes.size()) <= 65'536 + 64 * 48 * spec.maxBytesPerPixel);
    }
    CHECK(image::contentType(Format::jpeg) == "image/jpeg");
    CHECK(image::listFormats(&FormatSpec::mime, ", ", " or ").starts_with("image/png, "));
    CHECK(image::listFormats(&FormatSpec::endings, " ", " ", ".").starts_with(".png .jpg .jpeg"));
}
