#include "render/plan/texture_levels.h"

#include <catch2/catch.hpp>
#include <thread>

#include "tests/support/errors.h"

using namespace farol;
using image::Image;
using render::TextureLevels;
using render::TextureRef;
using render::UndecodedTexture;

namespace {

std::vector<TextureRef> refsOf(int count) {
    std::vector<TextureRef> refs(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) refs[static_cast<std::size_t>(i)].key = std::to_string(i);
    return refs;
}

std::vector<const TextureRef*> pointers(const std::vector<TextureRef>& refs) {
    std::vector<const TextureRef*> all;
    for (const TextureRef& ref : refs) all.push_back(&ref);
    return all;
}

/// One column, its rows 0 1 2 ... from the top.
Image column(int height) {
    Image image{1, height, {}};
    for (int y = 0; y < height; ++y)
        for (int c = 0; c < 4; ++c) image.pixels.push_back(static_cast<std::uint8_t>(y));
    return image;
}

}  // namespace

TEST_CASE("pictures come in their order however long each takes, bottom row first") {
    const std::vector<TextureRef> refs = refsOf(30);
    const auto open = [](const TextureRef& ref) {
        const int index = std::stoi(ref.key);
        return UndecodedTexture{
            1 << (index % 26), 1, [index](std::string&) {
                std::this_thread::sleep_for(std::chrono::milliseconds(index % 4 == 0 ? 5 : 0));
                return column(index + 2);
            }};
    };
    int next = 0, expected = 0, meanwhile = 0;
    const std::thread::id caller = std::this_thread::get_id();
    const auto take = [&](const TextureRef& ref, const TextureLevels& got) {
        CHECK(ref.key == std::to_string(next));
        CHECK(std::this_thread::get_id() == caller);
        REQUIRE(got.images.size() >= 2);
        const Image& largest = got.images[0];
        REQUIRE(largest.height == next + 2);
        CHECK(largest.pixels.front() == next + 1);
        CHECK(largest.pixels.back() == 0);
        CHECK(got.images.back().height == 1);
        ++next;
        CHECK(next <= expected);
    };
    const auto expect = [&](const TextureRef& ref, const UndecodedTexture& coming) {
        CHECK(ref.key == std::to_string(expected));
        CHECK(coming.width == 1 << (expected % 26));
        ++expected;
    };
    const auto idle = [&] {
        ++meanwhile;
        CHECK(next == 0);
        CHECK(expected > 0);
    };
    render::loadTextures(pointers(refs), open, {expect, idle, take}, render::GlFacts{});
    CHECK(meanwhile == 1);
    CHECK(next == 30);
}

TEST_CASE("without smaller levels where the filter reads none") {
    std::vector<TextureRef> refs = refsOf(1);
    for (const auto& [filter, count] : {std::pair{scene::Filter::nearest, 1},
                                        {scene::Filter::linear, 1},
                                        {scene::Filter::mipmap, 4},
                                        {scene::Filter::anisotropic, 4}}) {
        refs[0].filter = filter;
        std::size_t images = 0;
        render::loadTextures(
            pointers(refs),
            [](const TextureRef&) {
                return UndecodedTexture{1, 8, [](std::string&) { return column(8); }};
            },
            {.onDecoded = [&](const TextureRef&,
                              const TextureLevels& got) { images = got.images.size(); }},
            render::GlFacts{});
        CHECK(images == static_cast<std::size_t>(count));
    }
}

TEST_CASE("of several errors the first in order is thrown, whether of a head or of pixels") {
    const std::vector<TextureRef> refs = refsOf(6);
    for (const int head : {1, 3, 5})
        for (const int pixels : {0, 2, 4}) {
            const auto open = [&](const TextureRef& ref) {
                const int index = std::stoi(ref.key);
                if (index == head) throw test::errorOf("image.unreadable", "head");
                return UndecodedTexture{1, 1, [index, pixels](std::string&) -> Image {
                                            if (index == pixels)
                                                throw test::errorOf("image.unreadable", "pixels");
                                            return column(2);
                                        }};
            };
            std::string told;
            try {
                render::loadTextures(pointers(refs), open,
                                     {.onDecoded = [](const TextureRef&, const TextureLevels&) {}},
                                     render::GlFacts{});
            } catch (const Error& error) {
                told = error.what();
            }
            CAPTURE(head, pixels);
            CHECK(told.find(head < pixels ? "head" : "pixels") != std::string::npos);
        }
}

TEST_CASE("textures over the limits are scaled down with a note, each axis for itself") {
    std::vector<TextureRef> refs = refsOf(1);
    refs[0].filter = scene::Filter::nearest;
    TextureLevels levels;
    const auto load = [&](int height, int side) {
        render::GlFacts gl;
        gl.maxTextureSide = side;
        render::loadTextures(
            pointers(refs),
            [&](const TextureRef&) {
                return UndecodedTexture{1, height,
                                        [height](std::string&) { return column(height); }};
            },
            {.onDecoded = [&](const TextureRef&, const TextureLevels& got) { levels = got; }}, gl);
    };
    load(8, 8);
    CHECK(levels.images[0].height == 8);
    CHECK(levels.notes.empty());
    load(9, 6);
    REQUIRE(levels.images[0].height == 6);
    CHECK(levels.images[0].width == 1);
    // Rows 0..8 in six bands of 1.5 rows each, bottom first: the last is (8 + 7 / 2) / 1.5.
    CHECK(levels.images[0].pixels.front() == 8);
    CHECK(levels.images[0].pixels.back() == 0);
    REQUIRE(levels.notes.size() == 1);
    const Diagnostic warning = render::findingOf(levels.notes[0], refs[0]);
    CHECK(warning.code == "image.scaled");
    CHECK(warning.message.find("1 x 9 px") != std::string::npos);
    CHECK(warning.message.find("1 x 6 px") != std::string::npos);
}

TEST_CASE("a wide, low cross makes no faces many times its own size") {
    std::vector<TextureRef> refs = refsOf(1);
    refs[0].cube = true;
    TextureLevels levels;
    render::GlFacts gl;
    gl.maxFaceSide = 16;
    render::loadTextures(
        pointers(refs),
        [&](const TextureRef&) {
            return UndecodedTexture{400, 3, [](std::string&) {
                                        Image cross{400, 3, {}};
                                        cross.pixels.assign(std::size_t{400} * 3 * 4, 7);
                                        return cross;
                                    }};
        },
        {.onDecoded = [&](const TextureRef&, const TextureLevels& got) { levels = got; }}, gl);
    REQUIRE(levels.images.size() == 6);
    for (const Image& face : levels.images) CHECK((face.width == 16 && face.height == 16));
    CHECK(levels.notes.size() == 2);
}
