#include <catch2/catch.hpp>

#include "image/format.h"
#include "image/image_file.h"
#include "render/renderer.h"

// Whole scenes, from XML to pixels.
using namespace farol;
using image::Image;

namespace {

Image picture(const std::string& xml,
              const std::vector<std::pair<const char*, const char*>>& options = {},
              std::map<std::string, std::string> files = {}) {
    render::Job job;
    job.xml = xml;
    job.assets = std::make_shared<scene::BundleAssets>(std::move(files));
    job.options.width = job.options.height = 64;
    job.options.samples = 1;
    for (const auto& [name, value] : options) render::applyOption(job.options, name, value);
    render::Renderer renderer;
    Image image;
    renderer.draw(job, image);
    return image;
}

glm::ivec3 at(const Image& image, int x, int y) {
    const std::size_t i = static_cast<std::size_t>(y * image.width + x) * 4;
    return {image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]};
}

int different(const Image& a, const Image& b, int tolerance) {
    int count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); i += 4)
        for (std::size_t c = 0; c < 3; ++c)
            if (std::abs(int{a.pixels[i + c]} - int{b.pixels[i + c]}) > tolerance) {
                ++count;
                break;
            }
    return count;
}

std::string litSphere(const std::string& light) {
    return "<world><camera><position x='0' y='0' z='4'/><lookAt x='0' y='0' z='0'/></camera>"
           "<lights>" +
           light +
           "</lights><group><models><model file='sphere_1_64_64.3d'><color>"
           "<diffuse R='200' G='100' B='50'/></color></model></models></group></world>";
}

}  // namespace

TEST_CASE("a light fixed to the camera lights the same side of the picture from anywhere") {
    const std::string camera =
        litSphere("<light type='directional' space='camera' alpha='60' beta='20'/>");
    const std::string world =
        litSphere("<light type='directional' space='world' alpha='60' beta='20'/>");
    const Image front = picture(camera);
    const Image side = picture(camera, {{"azimuth", "90"}});
    // The sphere's facets stand otherwise; its shading does not.
    CHECK(different(front, side, 8) < 40);
    CHECK(at(front, 44, 30).r > at(front, 20, 30).r + 50);
    CHECK(different(picture(world), picture(world, {{"azimuth", "90"}}), 8) > 500);
    CHECK(different(picture(world), front, 2) == 0);  // at azimuth 0 both mean the same
}

TEST_CASE("an entity stays before the camera while the world turns") {
    const std::string xml =
        "<scene camera='engine'><entity file='ship.xml'/>"  // 45 degrees
        "<models><model file='box_6_2.3d' diffR='0' diffG='1' diffB='0'/></models></scene>";
    const std::map<std::string, std::string> files{
        {"ship.xml",
         "<scene><models><model file='sphere_0.4_32_32.3d' diffR='1' diffG='0' "
         "diffB='0'/></models></scene>"}};
    const auto view = [&](const char* eye) {
        return picture(xml, {{"eye", eye}, {"target", "0.5,0,0"}, {"shading", "solid"}}, files);
    };
    const Image first = view("9,3,9");
    const Image second = view("-12,0,8");
    int entity = 0;
    int moved = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const glm::ivec3 a = at(first, x, y);
            const glm::ivec3 b = at(second, x, y);
            const bool redA = a.r > 200 && a.g < 50;
            const bool redB = b.r > 200 && b.g < 50;
            CHECK(redA == redB);
            entity += redA ? 1 : 0;
            moved += a != b ? 1 : 0;
        }
    // A disc of radius 0.4 at distance 3, seen with 45 degrees on 64 px.
    CHECK(entity == Approx(3.14159 * 10.4 * 10.4).epsilon(0.12));
    CHECK(moved > 20);
}

TEST_CASE("a texture stands upright: its top row is the top of a box's face") {
    Image texture{2, 2, {}};
    for (const int value : {255, 0, 0, 255, 255, 0, 0, 255, 0, 0, 255, 255, 0, 0, 255, 255})
        texture.pixels.push_back(static_cast<std::uint8_t>(value));
    const Image image = picture(
        "<world><camera><position x='0' y='0' z='3'/><lookAt x='0' y='0' z='0'/></camera><group>"
        "<models><model file='box_2_1.3d'><texture file='t.png'/></model></models></group></world>",
        {{"filter", "nearest"}}, {{"t.png", image::encodePng(texture)}});
    CHECK(at(image, 32, 20) == glm::ivec3(255, 0, 0));
    CHECK(at(image, 32, 44) == glm::ivec3(0, 0, 255));
}

TEST_CASE("a skybox surrounds the scene, in the layout of the cross") {
    // Cells of the 4x3 cross in plain colours: right is red, left green, top blue, bottom yellow,
    // front white, back grey.
    constexpr int kSide = 8;
    const std::map<int, glm::ivec3> cells{{6, {255, 0, 0}},     {4, {0, 255, 0}},
                                          {1, {0, 0, 255}},     {9, {255, 255, 0}},
                                          {5, {255, 255, 255}}, {7, {128, 128, 128}}};
    Image cross{4 * kSide, 3 * kSide, {}};
    for (int y = 0; y < cross.height; ++y)
        for (int x = 0; x < cross.width; ++x) {
            const auto cell = cells.find((y / kSide) * 4 + x / kSide);
            const glm::ivec3 color = cell == cells.end() ? glm::ivec3(0) : cell->second;
            for (const int value : {color.r, color.g, color.b, 255})
                cross.pixels.push_back(static_cast<std::uint8_t>(value));
        }
    const std::map<std::string, std::string> files{{"sky.png", image::encodePng(cross)}};
    const std::string xml =
        "<scene><skybox width='500' texture='sky.png'/>"
        "<models><model command='sphere 0.001 4 4'/></models></scene>";
    struct Case {
        const char* target;
        int cell;
    };
    const Case one = GENERATE(values<Case>({{"10,0,0", 6},
                                            {"-10,0,0", 4},
                                            {"0,10,0", 1},
                                            {"0,-10,0", 9},
                                            {"0,0,-10", 5},
                                            {"0,0,10", 7}}));
    CAPTURE(one.target);
    const Image image = picture(
        xml, {{"eye", "0,0,0.1"}, {"target", one.target}, {"far", "5"}, {"fov", "60"}}, files);
    CHECK(at(image, 32, 33) == cells.at(one.cell));  // however near the far plane is
    CHECK(at(image, 10, 50) == cells.at(one.cell));
}

TEST_CASE("spherical mapping has no mirrored strip at its seam") {
    // A ramp in u: across the seam it falls from 255 to 0 within a pixel or two.
    Image ramp{256, 1, {}};
    for (int x = 0; x < 256; ++x)
        for (const int value : {x, x, x, 255})
            ramp.pixels.push_back(static_cast<std::uint8_t>(value));
    const Image image = picture(
        "<world><camera><position x='-3' y='0' z='0'/><lookAt x='0' y='0' z='0'/></camera><group>"
        "<models><model file='sphere_1_32_32.3d'><texture file='r.png' mapping='sphere'/></model>"
        "</models></group></world>",
        {}, {{"r.png", image::encodePng(ramp)}});
    // From -X the seam (u = 0 and 1) runs down the middle. The linear filter blends the last texel
    // with the first, so the fall takes up to three pixels; a strip would take more, or rise again.
    int first = 64;
    int last = 0;
    for (int x = 20; x < 43; ++x) {
        if (std::abs(at(image, x + 1, 32).r - at(image, x, 32).r) < 12) continue;
        first = std::min(first, x);
        last = std::max(last, x);
    }
    CHECK(first >= 29);
    CHECK(last <= 33);
    CHECK(last - first <= 2);
    CHECK(std::abs(at(image, 28, 32).r - at(image, 36, 32).r) > 200);
}

TEST_CASE("chess shading alternates faces, flat and points differ from it") {
    const std::string xml =
        "<world><camera><position x='0' y='0' z='3'/><lookAt x='0' y='0' z='0'/></camera><group>"
        "<models><model file='box_2_1.3d'><color><diffuse R='200' G='200' B='200'/></color></model>"
        "</models></group></world>";
    const Image chess = picture(xml, {{"shading", "chess"}});
    const int a = at(chess, 24, 26).r;
    const int b = at(chess, 40, 38).r;
    CHECK(std::max(a, b) == 200);
    CHECK(std::min(a, b) == 50);
    const Image points = picture(xml, {{"shading", "points"}});
    int lit = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) lit += at(points, x, y).r > 0 ? 1 : 0;
    CHECK(lit >= 4);
    CHECK(lit <= 16);
}

TEST_CASE("texture generation by eye planes moves with the camera, by object planes does not") {
    Image stripes{2, 1, {}};
    for (const int value : {255, 255, 255, 255, 0, 0, 0, 255})
        stripes.pixels.push_back(static_cast<std::uint8_t>(value));
    const auto view = [&](const std::string& mode, const char* eye) {
        return picture(
            "<world><camera><position x='0' y='0' z='3'/><lookAt x='0' y='0' "
            "z='0'/></camera><group>"
            "<models><model file='box_2_1.3d'><texture file='s.png'/><texgen mode='" +
                mode + "' s='0.5 0 0 0' t='0 1 0 0'/></model></models></group></world>",
            {{"filter", "nearest"}, {"eye", eye}, {"target", "0.5,0,0"}},
            {{"s.png", image::encodePng(stripes)}});
    };
    // The object's stripe edge is at x = 0 of the box; the eye's is in the middle of the picture.
    const Image object = view("object", "0.5,0,3");
    const Image eye = view("eye", "0.5,0,3");
    const auto edge = [](const Image& image) {
        for (int x = 8; x < 56; ++x)
            if (at(image, x, 32) != at(image, x + 1, 32)) return x;
        return -1;
    };
    CHECK(edge(object) < 25);
    CHECK(std::abs(edge(eye) - 31) <= 1);
}

TEST_CASE(
    "a scene kept under its identity gives the same picture, and another identity a new one") {
    render::Renderer renderer;
    const auto job = [](const std::string& identity, const char* color) {
        render::Job made;
        made.xml =
            std::string("<world><group><models><model file='sphere_1_8_8.3d'><color><diffuse ") +
            color + "/></color></model></models></group></world>";
        made.options.width = made.options.height = 32;
        made.identity = identity;
        return made;
    };
    const render::Picture first = renderer.render(job("a", "R='200' G='0' B='0'"));
    CHECK(renderer.render(job("a", "R='200' G='0' B='0'")).bytes == first.bytes);
    CHECK(renderer.render(job("", "R='200' G='0' B='0'")).bytes == first.bytes);
    CHECK(renderer.render(job("b", "R='0' G='200' B='0'")).bytes != first.bytes);
    render::Job broken = job("c", "");
    broken.xml = "<world>";
    CHECK_THROWS_AS(renderer.render(broken), Error);
    broken.xml = job("c", "R='1'").xml;
    CHECK_NOTHROW(renderer.render(broken));  // refusals are not cached
}
