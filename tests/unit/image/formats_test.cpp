// Files of every format that is decoded, written byte by byte, against the pixels they stand for.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "image/format.h"
#include "image/image_file.h"
#include "tests/support/paths.h"

using namespace farol;
using namespace farol::image;
using namespace std::string_literals;

namespace {

std::string le(std::uint64_t value, int bytes) {
    std::string out;
    for (; bytes > 0; --bytes, value >>= 8U) out.push_back(static_cast<char>(value & 255U));
    return out;
}

/// "rrggbb rrggbb" per row, rows parted by '/'; two more digits are alpha.
std::string show(const image::Image& image) {
    std::string out;
    char text[12];
    for (int y = 0; y < image.height; ++y) {
        if (y > 0) out += '/';
        for (int x = 0; x < image.width; ++x) {
            const std::uint8_t* p =
                &image.pixels[(static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                               static_cast<std::size_t>(x)) *
                              4];
            std::snprintf(text, sizeof text, p[3] == 255 ? "%02x%02x%02x" : "%02x%02x%02x%02x",
                          p[0], p[1], p[2], p[3]);
            out += (x > 0 ? " " : "") + std::string(text);
        }
    }
    return out;
}

std::string decoded(const std::string& bytes, const std::string& name = "a.tga") {
    return show(image::decodeImage(bytes, name));
}

std::string refusal(const std::string& bytes, const std::string& name = "a.tga") {
    try {
        return "an image of " + show(image::decodeImage(bytes, name));
    } catch (const Error& error) {
        CHECK(error.code() == "image.unreadable");
        return error.what();
    }
}

struct Bmp {
    int width = 2, height = 2;
    unsigned depth = 24, compression = 0, colors = 0;
    std::string palette = {}, masks = {}, pixels = {};

    std::string bytes() const {
        return "BM" + le(0, 8) + le(54 + palette.size() + masks.size(), 4) + le(40, 4) +
               le(static_cast<std::uint32_t>(width), 4) +
               le(static_cast<std::uint32_t>(height), 4) + le(1, 2) + le(depth, 2) +
               le(compression, 4) + le(0, 12) + le(colors, 4) + le(0, 4) + masks + palette + pixels;
    }
};

const std::string kRedGreen = "\0\0\xff\0\0\xff\0\0"s;

std::string tga(unsigned type, unsigned colors, unsigned paletteBits, unsigned depth,
                unsigned flags, const std::string& rest, int width = 2, int height = 1) {
    return le(0, 1) + le(colors > 0, 1) + le(type, 1) + le(0, 2) + le(colors, 2) +
           le(paletteBits, 1) + le(0, 4) + le(static_cast<unsigned>(width), 2) +
           le(static_cast<unsigned>(height), 2) + le(depth, 1) + le(flags, 1) + rest;
}

}  // namespace

TEST_CASE("BMP of direct colours") {
    const std::string rows = "\x01\x02\x03\x04\x05\x06zz\x11\x12\x13\x14\x15\x16zz"s;
    CHECK(decoded(Bmp{.pixels = rows}.bytes()) == "131211 161514/030201 060504");
    CHECK(decoded(Bmp{.height = -2, .pixels = rows}.bytes()) == "030201 060504/131211 161514");
    // The last row's padding may be missing.
    CHECK(decoded(Bmp{.pixels = rows.substr(0, 14)}.bytes()) == "131211 161514/030201 060504");
    CHECK(refusal(Bmp{.pixels = rows.substr(0, 13)}.bytes()).find("cut off") != std::string::npos);
    CHECK(decoded(Bmp{.height = 1, .depth = 16, .pixels = "\0\x7c\x1f\0"s}.bytes()) ==
          "ff0000 0000ff");
    CHECK(decoded(Bmp{.height = 1,
                      .depth = 16,
                      .compression = 3,
                      .masks = le(0xF800, 4) + le(0x7E0, 4) + le(0x1F, 4),
                      .pixels = "\xe0\x07\xff\xff"s}
                      .bytes()) == "00ff00 ffffff");
    CHECK(
        decoded(Bmp{.height = 1, .depth = 32, .pixels = "\x01\x02\x03\0\x04\x05\x06\0"s}.bytes()) ==
        "030201 060504");
    CHECK(decoded(
              Bmp{.height = 1, .depth = 32, .pixels = "\x01\x02\x03\x80\x04\x05\x06\0"s}.bytes()) ==
          "03020180 06050400");
    CHECK(refusal(Bmp{.depth = 32, .compression = 3, .masks = le(5, 4) + le(0, 8)}.bytes())
              .find("mask") != std::string::npos);
}

TEST_CASE("BMP of palettes and runs") {
    const auto bmp = [](unsigned depth, unsigned compression, const std::string& pixels,
                        unsigned colors = 2) {
        return Bmp{.width = 3,
                   .height = 1,
                   .depth = depth,
                   .compression = compression,
                   .colors = colors,
                   .palette = kRedGreen,
                   .pixels = pixels}
            .bytes();
    };
    CHECK(decoded(bmp(1, 0, "\x40\0\0\0"s)) == "ff0000 00ff00 ff0000");
    CHECK(decoded(bmp(4, 0, "\x01\x10\0\0"s)) == "ff0000 00ff00 00ff00");
    CHECK(decoded(bmp(8, 0, "\x01\0\x01\0"s)) == "00ff00 ff0000 00ff00");
    CHECK(decoded(bmp(8, 1, "\x02\x01\0\0\0\x01"s)) == "00ff00 00ff00 ff0000");
    CHECK(decoded(bmp(8, 1, "\0\x03\0\x01\0\0\0\x01"s)) == "ff0000 00ff00 ff0000");
    CHECK(decoded(bmp(4, 2, "\x03\x01\0\x01"s)) == "ff0000 00ff00 ff0000");
    CHECK(decoded(bmp(8, 1, "\0\x02\x02\0\x01\x01\0\x01"s)) == "ff0000 ff0000 00ff00");
    for (const std::string& pixels : {"\x02\x01\x02\0"s, "\x07\x07\x07\x07"s})
        CHECK(refusal(bmp(8, 0, pixels)).find("not in its palette of 2") != std::string::npos);
    CHECK(refusal(bmp(8, 1, "\x7f\x01\0\x01"s)).find("leaves its row") != std::string::npos);
    CHECK(refusal(bmp(8, 1, "\x02\x01"s)).find("cut off") != std::string::npos);
    CHECK(refusal(bmp(24, 1, "\x02\x01\0\x01"s)).find("not read") != std::string::npos);
    CHECK(refusal(bmp(8, 0, "\0\0\0\0"s, 200)) != "");  // more colours than the file has
}

TEST_CASE("TGA") {
    CHECK(decoded(tga(2, 0, 0, 24, 0x20, "\x01\x02\x03\x04\x05\x06")) == "030201 060504");
    CHECK(decoded(tga(2, 0, 0, 24, 0x30, "\x01\x02\x03\x04\x05\x06")) == "060504 030201");
    CHECK(decoded(tga(3, 0, 0, 8, 0, "\x10\x20", 1, 2)) == "202020/101010");
    CHECK(decoded(tga(10, 0, 0, 24, 0x20, "\x81\x01\x02\x03")) == "030201 030201");
    CHECK(decoded(tga(1, 2, 24, 8, 0x20, "\0\0\xff\0\xff\0\x01\0"s)) == "00ff00 ff0000");
    CHECK(refusal(tga(2, 0, 0, 24, 0x20, "\x01\x02\x03\x04\x05")).find("cut off") !=
          std::string::npos);
    CHECK(refusal(tga(10, 0, 0, 24, 0x20, "\x80\x01\x02\x03")).find("cut off") !=
          std::string::npos);
    CHECK(refusal(tga(9, 0, 0, 32, 0x20, "\x80\x01\x02\x03")).find("TGA") != std::string::npos);
    // Indices of 32 bits, and a palette without colours.
    CHECK(refusal(tga(1, 1, 24, 32, 0x20, "\1\2\3\xff\xff\xff\xff\xff\xff\xff\xff")) != "");
}

TEST_CASE("PNM in its six kinds") {
    CHECK(decoded("P1\n# a comment\n3 1\n0 1 0\n") == "ffffff 000000 ffffff");
    CHECK(decoded("P1 3 1 010") == "ffffff 000000 ffffff");
    CHECK(decoded("P2 2 1 4\n0 3") == "000000 bfbfbf");
    CHECK(decoded("P3 1 1 255 1 2 3") == "010203");
    CHECK(decoded("P4 3 1\n\x40") == "ffffff 000000 ffffff");
    CHECK(decoded("P5 2 1 15\n\x0f\x01") == "ffffff 111111");
    CHECK(decoded("P5 1 1 65535\n\x80\x80") == "808080");
    CHECK(decoded("P6 1 1 255\n\x01\x02\x03") == "010203");
    CHECK(refusal("P5 2 1 15\n\x10\x01").find("above the maximum of 15") != std::string::npos);
    for (const char* cut :
         {"P6\n65536 1\n255\nab", "P1 3 1 01", "P2 2 1 4\n0", "P4 9 1\n1", "P5 9"})
        CHECK(refusal(cut).find("cut off") != std::string::npos);
    CHECK(refusal("P6 1 1 0\n1").find("1 to 65535") != std::string::npos);
}

TEST_CASE("Radiance: values from 0 to 1, others clamped") {
    const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
    CHECK(decoded(head + "\x80\x40\0\x80\xff\xff\0\x90"s) == "804000 ffff00");
    CHECK(refusal(head + "\x80\x40\0\x80\xff\xff\0"s).find("cut off") != std::string::npos);
}

TEST_CASE("GIF: the first image on its canvas") {
    const std::string bytes =
        "GIF89a\x02\0\x01\0\x80\0\0\xff\0\0\0\xff\0,\0\0\0\0\x02\0\x01\0\0\x02"
        "\x02\x44\x0a\0;"s;
    CHECK(decoded(bytes) == "ff0000 00ff00");
    CHECK(refusal(bytes.substr(0, bytes.size() - 5)).find("cut off") != std::string::npos);
    std::string small = bytes;
    small[34] = '\x0b';
    small.replace(33, 1, "\x54");  // colours 2 and 1
    CHECK(refusal(small).find("GIF") != std::string::npos);
}

TEST_CASE("TIFF without compression, and codecs that are not read") {
    const auto tiff = [](unsigned compression, const std::string& pixels) {
        const auto field = [](unsigned tag, unsigned value) {
            return le(tag, 2) + le(3, 2) + le(1, 4) + le(value, 4);
        };
        return "II*\0"s + le(8, 4) + le(9, 2) + field(256, 2) + field(257, 1) + field(258, 8) +
               field(259, compression) + field(262, 1) + field(273, 122) + field(277, 1) +
               field(278, 1) + field(279, 2) + le(0, 4) + pixels;
    };
    CHECK(decoded(tiff(1, "\x10\x20")) == "101010 202020");
    CHECK(refusal(tiff(1, "\x10")).find("TIFF") != std::string::npos);
    CHECK(refusal(tiff(32809, "\x10\x20")).find("compression 32809 is not read") !=
          std::string::npos);
}

// libtiff 4.5.0 refused them where the file was not mapped.
TEST_CASE("TIFF in tiles without compression") {
    const auto field = [](unsigned tag, unsigned value) {
        return le(tag, 2) + le(3, 2) + le(1, 4) + le(value, 4);
    };
    const std::string head = "II*\0"s + le(8, 4) + le(10, 2) + field(256, 2) + field(257, 1) +
                             field(258, 8) + field(259, 1) + field(262, 1) + field(277, 1) +
                             field(322, 16) + field(323, 16) + field(324, 134) + field(325, 256) +
                             le(0, 4);
    CHECK(decoded(head + "\x10\x20" + std::string(254, '\0')) == "101010 202020");
    CHECK(refusal(head + "\x10\x20").find("TIFF") != std::string::npos);
}

TEST_CASE("other formats are refused with the list of those that are read") {
    for (const std::string& bytes : {"DDS |\0\0\0"s, "8BPS\0\1"s, "\0\0\1\0\1\0"s, "SDPX\0\0"s,
                                     "SIMPLE  ="s, "\x01\xda\x01\x01"s, "FOR4"s})
        CHECK(refusal(bytes, "a.dds").find("expected PNG, JPEG, WebP, GIF, BMP, TGA") !=
              std::string::npos);
}

TEST_CASE("a pointer of Git LFS and a web page are named as what they are") {
    CHECK(refusal("version https://git-lfs.github.com/spec/v1\noid sha256:4d\n", "a.jpg")
              .find("git lfs pull") != std::string::npos);
    CHECK(refusal("<!doctype html><html>", "a.jpg").find("a web page") != std::string::npos);
}

TEST_CASE("a file that is cut off anywhere is an error, a warning or the whole image") {
    int files = 0, prefixes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(
             std::string(farol::test::kSourceDir) + "/tests/fuzz/seeds/image")) {
        std::ifstream in(entry.path(), std::ios::binary);
        const std::string bytes(std::istreambuf_iterator<char>(in), {});
        // The last number of an ASCII file shows no end.
        if (bytes.size() > 1 && bytes[0] == 'P' && bytes[1] <= '3') continue;
        image::Image whole;
        std::string damage;
        try {
            whole = image::decodeImage(bytes, "a.tga", {}, &damage);
        } catch (const Error&) {
            continue;
        }
        INFO(entry.path().string());
        ++files;
        // Each OpenEXR file takes a thread; exr_test.cpp cuts one everywhere.
        const std::size_t step = entry.path().extension() == ".exr" ? 37 : 1;
        for (std::size_t size = 0; size < bytes.size(); size += step, ++prefixes) {
            std::string cut;
            try {
                const image::Image part =
                    image::decodeImage(bytes.substr(0, size), "a.tga", {}, &cut);
                if (cut.empty() && !(part == whole)) FAIL("silent after " << size << " bytes");
            } catch (const Error& error) {
                if (error.code() != "image.unreadable") FAIL(error.code());
            }
        }
    }
    CHECK(files > 20);
    CHECK(prefixes > 1000);
}
