// Images of valid parts that are made to exhaust memory or time, or to break the next request.
#include <zlib.h>

#include <catch2/catch.hpp>

#include "image/format.h"
#include "image/image_file.h"
#include "render/gl/api.h"
#include "render/gl/library.h"
#include "render/renderer.h"

using namespace farol;
using namespace std::string_literals;

namespace {

std::string be(std::uint32_t value, int bytes) {
    std::string out;
    for (int i = bytes; i-- > 0;) out.push_back(static_cast<char>(value >> (8U * unsigned(i))));
    return out;
}

std::string chunk(const std::string& type, const std::string& data) {
    const std::string body = type + data;
    const auto sum =
        crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
    return be(static_cast<std::uint32_t>(data.size()), 4) + body +
           be(static_cast<std::uint32_t>(sum), 4);
}

std::string packed(const std::string& raw) {
    std::string out(compressBound(raw.size()), '\0');
    uLongf size = out.size();
    compress2(reinterpret_cast<Bytef*>(out.data()), &size,
              reinterpret_cast<const Bytef*>(raw.data()), raw.size(), 9);
    out.resize(size);
    return out;
}

/// RGB, all of one colour.
std::string png(std::uint32_t width, std::uint32_t height, const std::string& more = {},
                const std::string& rawAfter = {}) {
    std::string row(1, '\0'), raw;
    for (std::uint32_t x = 0; x < width; ++x) row += "\x80\x40\xff";
    for (std::uint32_t y = 0; y < height; ++y) raw += row;
    return "\x89PNG\r\n\x1a\n"s + chunk("IHDR", be(width, 4) + be(height, 4) + "\x08\x02\0\0\0"s) +
           more + chunk("IDAT", packed(raw + rawAfter)) + chunk("IEND", "");
}

/// A progressive grey JPEG of one DC scan and `scans` empty ones.
std::string progressiveJpeg(std::uint32_t side, int scans) {
    const auto segment = [](char marker, const std::string& body) {
        return "\xff"s + marker + be(static_cast<std::uint32_t>(body.size()) + 2, 2) + body;
    };
    std::string table = "\0\1"s + std::string(14, '\0') + '\0';
    std::string out = "\xff\xd8"s + segment('\xdb', '\0' + std::string(64, '\1')) +
                      segment('\xc2', "\x08"s + be(side, 2) + be(side, 2) + "\1\1\x11\0"s) +
                      segment('\xc4', '\0' + table) + segment('\xc4', '\x10' + table) +
                      segment('\xda', "\1\1\0\0\0\0"s);
    for (int i = 0; i < scans; ++i) out += segment('\xda', "\1\1\0\1\x3f\0"s);
    return out + "\xff\xd9";
}

std::string failure(const std::string& bytes) {
    std::string damage;  // empty scans count as damage
    try {
        image::decodeImage(bytes, "a", {}, &damage);
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

render::Job textured(const std::string& name, const std::string& bytes) {
    render::Job job;
    job.xml = "<world><group><models><model file=\"plane_2_1.3d\"><texture file=\"" + name +
              "\"/></model></models></group></world>";
    job.options.width = job.options.height = 32;
    job.assets = std::make_shared<scene::BundleAssets>(scene::BundleAssets::Files{{name, bytes}});
    return job;
}

int countOf(const Diagnostics& all, const std::string& code) {
    int count = 0;
    for (const Diagnostic& one : all) count += one.code == code ? 1 : 0;
    return count;
}

}  // namespace

TEST_CASE("scans of a progressive JPEG are bounded") {
    CHECK(failure(progressiveJpeg(64, 30)).empty());
    CHECK(failure(progressiveJpeg(64, 5000)).find("scans") != std::string::npos);
}

TEST_CASE("text of a PNG is not decompressed, data after the last pixel little") {
    const std::string bomb(std::size_t{64} << 20, '\0');
    CHECK(failure(png(4, 4, chunk("zTXt", "Comment\0\0"s + packed(bomb)))).empty());
    CHECK(failure(png(4, 4, {}, std::string(1000, '\0'))).empty());
    // 64 KiB of compressed data are 64 MiB; twice that is refused.
    CHECK(failure(png(4, 4, {}, bomb + bomb)).find("goes on") != std::string::npos);
}

TEST_CASE("a JPEG that is cut off is drawn with a warning, and refused when strict") {
    image::Image image{64, 64, {}};
    for (int i = 0; i < 64 * 64 * 4; ++i)
        image.pixels.push_back(i % 4 == 3 ? std::uint8_t{255} : static_cast<std::uint8_t>(i * 37));
    const std::string whole = image::encodeJpeg(image, 90);
    render::Renderer renderer;
    CHECK(countOf(renderer.render(textured("whole.jpg", whole)).diagnostics, "image.damaged") == 0);
    render::Job job = textured("cut.jpg", whole.substr(0, whole.size() / 3));
    for (int i = 0; i < 2; ++i) {  // the second from the cache
        const render::Picture picture = renderer.render(job);
        REQUIRE(countOf(picture.diagnostics, "image.damaged") == 1);
        CHECK(picture.diagnostics.back().message.find("cut.jpg") != std::string::npos);
        CHECK(picture.diagnostics.back().where.line == 1);
    }
    job.strict = true;
    CHECK_THROWS_AS(renderer.render(job), Error);
}

TEST_CASE("a texture larger than the GL's limit is drawn, scaled down, with a warning") {
    render::Renderer renderer;
    for (const auto& [width, height] : {std::pair{20000U, 2U}, {65536U, 1U}, {1U, 40000U}}) {
        const render::Picture picture = renderer.render(textured("wide.png", png(width, height)));
        CHECK(countOf(picture.diagnostics, "image.scaled") == 1);
        CHECK(picture.bytes == renderer.render(textured("wide.png", png(4, 4))).bytes);
    }
}

TEST_CASE("a failed job, and errors that it leaves in the GL, do not fail the next") {
    render::Renderer renderer;
    const render::Job good = textured("good.png", png(4, 4));
    const std::string expected = renderer.render(good).bytes;
    CHECK_THROWS_AS(renderer.render(textured("cut.ppm", "P6\n65536 1\n255\nab")), Error);
    CHECK(renderer.render(good).bytes == expected);
    using Enable = void (*)(unsigned);
    // Of the GL that the renderer's context, current in this thread, belongs to.
    const bool isOsMesa =
        render::gl::resolveSource(render::GlSource::automatic) == render::GlSource::osmesa;
    const render::gl::Library library(isOsMesa ? render::gl::kOsMesaLibrary
                                               : render::gl::kEglLibrary);
    const auto find = library.function<render::gl::GetProcAddress>(isOsMesa ? "OSMesaGetProcAddress"
                                                                            : "eglGetProcAddress");
    const auto enable = reinterpret_cast<Enable>(find("glEnable"));
    REQUIRE(enable != nullptr);
    enable(0xFFFF);  // GL_INVALID_ENUM is pending
    constexpr unsigned kScissorTest = 0x0C11;
    enable(kScissorTest);
    CHECK(renderer.render(good).bytes == expected);
}
