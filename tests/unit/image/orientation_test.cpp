// The Exif orientation of JPEG, WebP and PNG files is applied.
#include "image/orientation.h"

#include <catch2/catch.hpp>

#include "image/format.h"
#include "image/image_file.h"

using namespace farol;
using namespace farol::image;
using namespace std::string_literals;

namespace {

std::string number(std::uint32_t value, int bytes, bool big) {
    std::string out;
    for (int i = 0; i < bytes; ++i)
        out += static_cast<char>(value >> (8 * (big ? bytes - 1 - i : i)) & 255U);
    return out;
}

/// A directory with another tag before the orientation.
std::string exif(std::uint32_t orientation, bool big) {
    const auto n = [big](std::uint32_t value, int bytes) { return number(value, bytes, big); };
    return (big ? "MM\0*"s : "II*\0"s) + n(8, 4) + n(2, 2) + n(0x0100, 2) + n(4, 2) + n(1, 4) +
           n(77, 4) + n(0x0112, 2) + n(3, 2) + n(1, 4) + n(orientation, 2) + n(0, 2) + n(0, 4);
}

/// Blocks of 16 x 16 px, which JPEG keeps apart: red and green over blue and white.
Image corners() {
    Image image{32, 48, {}};
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 32; ++x) {
            const bool right = x >= 16, low = y >= 32;
            image.pixels.push_back(!right && !low ? 255 : right && low ? 255 : 0);
            image.pixels.push_back(right ? 255 : 0);
            image.pixels.push_back(low ? 255 : 0);
            image.pixels.push_back(255);
        }
    return image;
}

/// The colours of the four corners, row by row: r, g, b or w.
std::string cornersOf(const Image& image) {
    std::string out;
    for (const int y : {1, image.height - 2})
        for (const int x : {1, image.width - 2}) {
            const std::uint8_t* p =
                &image.pixels[static_cast<std::size_t>(4 * (y * image.width + x))];
            const bool r = p[0] > 128, g = p[1] > 128, b = p[2] > 128;
            out += r && g && b ? 'w' : r ? 'r' : g ? 'g' : b ? 'b' : '?';
        }
    return out;
}

std::string jpegWith(const std::string& block) {
    const std::string plain = encodeJpeg(corners(), 95);
    const std::string body = "Exif\0\0"s + block;
    return plain.substr(0, 2) + "\xFF\xE1" +
           number(static_cast<std::uint32_t>(body.size() + 2), 2, true) + body + plain.substr(2);
}

std::string pngWith(const std::string& block) {
    const std::string plain = encodePng(corners());
    const std::size_t afterHead = 8 + 25;
    // The checksum of an ancillary chunk that libpng does not know is not looked at.
    return plain.substr(0, afterHead) + number(static_cast<std::uint32_t>(block.size()), 4, true) +
           "eXIf" + block + number(0, 4, true) + plain.substr(afterHead);
}

std::string webpWith(const std::string& block) {
    const std::string plain = encodeWebp(corners(), 95);
    const auto size = [](const std::string& text) {
        return number(static_cast<std::uint32_t>(text.size()), 4, false);
    };
    const std::string head = "\x08\0\0\0"s + number(31, 3, false) + number(47, 3, false);
    std::string picture = plain.substr(12);
    if (picture.substr(0, 4) == "VP8X") picture = picture.substr(18);
    std::string rest = "WEBPVP8X" + size(head) + head + picture + "EXIF" + size(block) + block;
    if (block.size() % 2 != 0) rest += '\0';
    return "RIFF" + size(rest) + rest;
}

}  // namespace

TEST_CASE("a photo is shown as its Exif orientation says") {
    // The corners as they stand in the file, and what is to be seen.
    const std::string seen[8] = {"rgbw", "grwb", "wbgr", "bwrg", "rbgw", "brwg", "wgbr", "gwrb"};
    for (std::uint32_t orientation = 1; orientation <= 8; ++orientation)
        for (const bool big : {false, true})
            for (const auto& [name, make] :
                 std::vector<std::pair<const char*, std::string (*)(const std::string&)>>{
                     {"JPEG", jpegWith}, {"PNG", pngWith}, {"WebP", webpWith}}) {
                CAPTURE(orientation, big, name);
                const std::string bytes = make(exif(orientation, big));
                const Image image = decodeImage(bytes, "photo");
                CHECK(cornersOf(image) == seen[orientation - 1]);
                const bool turned = orientation >= 5;
                CHECK(image.width == (turned ? 48 : 32));
                CHECK(image.height == (turned ? 32 : 48));
                CHECK(imageSize(bytes, "photo").width == image.width);
                CHECK(imageSize(bytes, "photo").height == image.height);
            }
}

TEST_CASE("damaged Exif data turns nothing") {
    for (const std::uint32_t orientation : {0U, 9U, 65535U})
        CHECK(orientationOf(jpegWith(exif(orientation, false))) == 1);
    const std::string whole = exif(6, false);
    for (std::size_t length = 0; length < whole.size(); ++length) {
        const int found = orientationOf(jpegWith(whole.substr(0, length)));
        CHECK((found == 1 || (found == 6 && length >= 32)));
    }
    std::string far = whole;
    far[4] = far[5] = far[6] = far[7] = '\xFF';  // a directory beyond the end
    CHECK(orientationOf(jpegWith(far)) == 1);
    std::string many = whole;
    many[8] = many[9] = '\xFF';  // 65,535 entries, of which two are there
    CHECK(orientationOf(jpegWith(many)) == 6);
    CHECK(orientationOf("") == 1);
    CHECK(orientationOf("\xFF\xD8\xFF\xE1") == 1);
    CHECK(orientationOf("GIF89a") == 1);
}
