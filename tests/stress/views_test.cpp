#include <catch2/catch.hpp>
#include <random>

#include "image/format.h"
#include "tests/stress/draw.h"

// Rows of the stress list about views: cracks, the largest picture, what lies beyond the far plane.
using namespace farol;
using namespace farol::stress;

namespace {

/// White all over, whatever the light.
std::string glowing(const std::string& command) {
    return "<group><models><model command=\"" + command +
           R"("><color><diffuse R="0" G="0" B="0"/><emissive R="255" G="255" B="255"/></color>
              </model></models></group>)";
}

/// Dark pixels between two lit ones of a row or of a column: a convex shape has none.
int gaps(const image::Image& image) {
    int count = 0;
    const auto along = [&](int lines, int length, auto isLit) {
        for (int line = 0; line < lines; ++line) {
            int first = length, last = -1, seen = 0;
            for (int i = 0; i < length; ++i)
                if (isLit(line, i)) {
                    first = std::min(first, i);
                    last = i;
                    ++seen;
                }
            if (last >= 0) count += last - first + 1 - seen;
        }
    };
    along(image.height, image.width, [&](int y, int x) { return lit(image, x, y); });
    along(image.width, image.height, [&](int x, int y) { return lit(image, x, y); });
    return count;
}

}  // namespace

TEST_CASE("closed shapes show no cracks to 100 jittered cameras") {
    CHECK(gaps(draw("<world>" + std::string(kCamera) + kSun + glowing("torus 1 0.2") +
                    "</world>")) > 0);  // a hole is seen
    render::Renderer renderer;
    for (const char* command : {"sphere 1", "sphere 1 17 9", "ellipsoid 1 0.5 0.7", "box 1.5 3",
                                "cone 1 1.5", "cone 1 1.5 13 4", "cylinder 0.8 1.2"}) {
        std::mt19937 random(7);
        const auto between = [&](double low, double high) {
            return low + (high - low) * (static_cast<double>(random()) / 4294967295.0);
        };
        int cracked = 0, least = 160 * 160;
        for (int i = 0; i < 100; ++i) {
            const std::string eye = "x=\"" + std::to_string(between(-3, 3)) + "\" y=\"" +
                                    std::to_string(between(-3, 3)) + "\" z=\"" +
                                    std::to_string(between(3, 4)) + "\"";
            render::Job job;
            job.xml = "<world><camera><position " + eye + "/><lookAt x=\"" +
                      std::to_string(between(-0.1, 0.1)) +
                      "\" y=\"0\" z=\"0\"/><projection fov=\"50\" near=\"0.5\" far=\"50\"/>"
                      "</camera>" +
                      kSun + glowing(command) + "</world>";
            job.assets = std::make_shared<scene::BundleAssets>();
            job.options.width = job.options.height = 160;
            job.options.samples = 1;
            image::Image image;
            renderer.draw(job, image);
            cracked += gaps(image) > 0 ? 1 : 0;
            least = std::min(least, covered(image));
        }
        INFO(command);
        CHECK(least > 500);
        CHECK(cracked == 0);
    }
}

TEST_CASE("the largest picture shows what a small one does, a larger one is refused") {
    render::PictureOptions options;
    const image::Image small = draw(still(0.0), options);
    options.width = options.height = 4096;
    const image::Image large = draw(still(0.0), options);
    REQUIRE(large.width == 4096);
    REQUIRE(large.height == 4096);
    // Each pixel of the small picture is the middle of 64 x 64 of the large one.
    int off = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const glm::ivec3 d =
                glm::abs(pixel(small, x, y) - pixel(large, 64 * x + 32, 64 * y + 32));
            off += std::max({d.r, d.g, d.b}) > 2 ? 1 : 0;
        }
    CHECK(off <= 24);  // outlines: half a pixel of the large one beside that middle
    options.scale = 2.0;
    try {
        draw(still(0.0), options);
        FAIL("a picture of 8192 px was drawn");
    } catch (const Error& error) {
        CHECK(error.code() == "limit.pixels");
    }
}

TEST_CASE("a skybox is seen however near the far plane is") {
    const auto behind = [](double far) {
        render::Job job;
        job.xml =
            "<world><camera><position x=\"0\" y=\"0\" z=\"0\"/><lookAt x=\"0\" y=\"0\" z=\"-1\"/>"
            "<projection fov=\"60\" near=\"0.5\" far=\"" +
            std::to_string(far) +
            "\"/></camera><skybox width=\"500\" texture=\"sky.png\"/></world>";
        image::Image cross{32, 24, {}};
        for (int i = 0; i < 32 * 24; ++i)
            for (const int value : {(i % 32) * 8, 90, 200, 255})
                cross.pixels.push_back(static_cast<std::uint8_t>(value));
        job.assets = std::make_shared<scene::BundleAssets>(
            std::map<std::string, std::string>{{"sky.png", image::encodePng(cross)}});
        job.options.width = job.options.height = 64;
        image::Image image;
        render::Renderer().draw(job, image);
        return image;
    };
    const image::Image near = behind(1.0);
    CHECK(covered(near) == 64 * 64);
    CHECK(behind(100'000.0).pixels == near.pixels);
}
