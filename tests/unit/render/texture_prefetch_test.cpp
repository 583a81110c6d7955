#include "render/texture_prefetch.h"

#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <future>
#include <string>

#include "render/renderer.h"
#include "tests/support/errors.h"

using namespace farol;
using image::Image;
using render::TexturePrefetch;
using render::TextureRef;
using render::UndecodedTexture;

namespace {

TextureRef refOf(const std::string& key) {
    TextureRef ref;
    ref.key = ref.path = key;
    return ref;
}

/// Files of one size, whose openings and decodings are counted.
struct Files {
    int width = 1, height = 1;
    int opened = 0;
    std::atomic<int> decoded = 0;

    UndecodedTexture open(const TextureRef& ref) {
        ++opened;
        if (ref.key == "absent") throw test::errorOf("asset.missing", "absent");
        return {width, height, false, [this, key = ref.key](std::string& damage) {
                    ++decoded;
                    if (key == "broken") throw test::errorOf("image.unreadable", "broken");
                    damage = "cut off";
                    return Image{1, 1, {7, 8, 9, 255}};
                }};
    }
};

}  // namespace

TEST_CASE("an image is decoded before its plan, once") {
    Workers workers(2);
    Files files;
    const std::vector<TextureRef> refs{refOf("a"), refOf("a")};
    TexturePrefetch prefetch(
        refs, [&](const TextureRef& ref) { return files.open(ref); }, workers);
    const UndecodedTexture texture = prefetch.open(refs[0]);
    CHECK(texture.width == 1);
    std::string damage;
    CHECK(texture.decode(damage).pixels == std::vector<std::uint8_t>{7, 8, 9, 255});
    CHECK(damage == "cut off");
    CHECK(files.opened == 1);
    CHECK(files.decoded == 1);
    // The second time it is decoded anew.
    prefetch.open(refs[1]).decode(damage);
    CHECK(files.decoded == 2);
}

TEST_CASE("faults of images that are decoded early appear where the images are used") {
    Workers workers(2);
    Files files;
    const std::vector<TextureRef> refs{refOf("absent"), refOf("broken")};
    TexturePrefetch prefetch(
        refs, [&](const TextureRef& ref) { return files.open(ref); }, workers);
    CHECK_THROWS_AS(prefetch.open(refs[0]), Error);
    const UndecodedTexture broken = prefetch.open(refs[1]);
    std::string damage;
    CHECK_THROWS_AS(broken.decode(damage), Error);
    CHECK(files.decoded == 1);
}

TEST_CASE("images over the bound of pixels at once, and chess boards, are not decoded early") {
    Workers workers(2);
    Files files;
    files.width = files.height = 4097;
    std::vector<TextureRef> refs{refOf("wide"), refOf("chess")};
    refs[1].chess.emplace();
    {
        const std::vector<TextureRef> chess{refs[1]};
        TexturePrefetch none(
            chess, [&](const TextureRef& ref) { return files.open(ref); }, workers);
        CHECK(files.opened == 0);
    }
    TexturePrefetch prefetch(
        refs, [&](const TextureRef& ref) { return files.open(ref); }, workers);
    CHECK(files.decoded == 0);
}

TEST_CASE("more images than threads are decoded early, but none that the plan leaves out") {
    Workers workers(1);
    std::promise<void> planned;
    const std::shared_future<void> plan = planned.get_future().share();
    std::atomic<int> decoded = 0;
    const std::vector<TextureRef> refs{refOf("a"), refOf("b"), refOf("c"), refOf("d")};
    TexturePrefetch prefetch(
        refs,
        [&](const TextureRef&) {
            return UndecodedTexture{1, 1, false, [&decoded, plan](std::string&) {
                                        plan.wait();
                                        ++decoded;
                                        return Image{1, 1, {7, 8, 9, 255}};
                                    }};
        },
        workers);
    prefetch.keepOnly({refs[0], refs[2]});
    planned.set_value();
    workers.add([] {}).wait();  // behind all images
    CHECK(decoded == 2);
    std::string damage;
    CHECK(prefetch.open(refs[2]).decode(damage).width == 1);
    CHECK(decoded == 2);
    CHECK(prefetch.open(refs[3]).decode(damage).width == 1);
    CHECK(decoded == 3);
}

TEST_CASE("without threads nothing is decoded early") {
    Workers workers(0);
    Files files;
    const std::vector<TextureRef> refs{refOf("a")};
    TexturePrefetch prefetch(
        refs, [&](const TextureRef& ref) { return files.open(ref); }, workers);
    CHECK(files.opened == 0);
    std::string damage;
    CHECK(prefetch.open(refs[0]).decode(damage).width == 1);
}

TEST_CASE("the environment stays in its place while a renderer lives: decoders read it beside") {
    unsetenv("GALLIVM_PERF");
    unsetenv("LIBGL_ALWAYS_SOFTWARE");
    render::Renderer renderer;
    const auto variables = [] {
        std::vector<const char*> all;
        for (char** one = environ; *one != nullptr; ++one) all.push_back(*one);
        return all;
    };
    char** const place = environ;
    const std::vector<const char*> before = variables();
    renderer.gl();  // makes the context
    CHECK(environ == place);
    CHECK(variables() == before);
    CHECK(std::getenv("GALLIVM_PERF") == std::string("no_aos_sampling"));
}
