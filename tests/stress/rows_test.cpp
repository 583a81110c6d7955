#include <catch2/catch.hpp>
#include <cmath>

#include "tests/stress/draw.h"

// The stress list, one named test a row: numbers, places and files at which renderers fail. Rows
// about reading, curves, mipmaps and mesh files alone are held by the unit tests of those folders.
using namespace farol;
using namespace farol::stress;

TEST_CASE("world coordinates of 1e6 and 1e7 draw what the origin draws") {
    const image::Image home = draw(still(0.0));
    REQUIRE(covered(home) > 1000);
    for (const double away : {1e6, 1e7, 3e8}) {
        INFO(away);
        CHECK(shareOff(home, draw(still(away)), 2) <= 1e-4);
    }
    // Powers of two round nothing: the same bytes.
    for (const int power : {20, 24})
        CHECK(draw(still(std::ldexp(1.0, power))).pixels == home.pixels);
}

TEST_CASE("a ground quad of half-size 1e7 reaches the horizon") {
    const image::Image image =
        draw(world("<model command=\"plane 20000000\"/>", R"(<position x="0" y="2" z="0"/>
            <lookAt x="0" y="2" z="-1"/><projection fov="60" near="0.1" far="10000000"/>)"));
    // The horizon of an eye two units high is at the middle of the picture.
    CHECK(lit(image, 32, 60));
    CHECK(lit(image, 5, 40));
    CHECK(lit(image, 32, 34));
    CHECK_FALSE(lit(image, 32, 30));
}

TEST_CASE("near 0.1 and far 1e7 tell surfaces one part in a million apart") {
    const auto pair = [&](double front, double back, const char* order) {
        const auto quad = [](double z, const char* color) {
            return "<group><transform><translate x=\"0\" y=\"0\" z=\"" + std::to_string(-z) +
                   R"("/><rotate angle="90" x="1" y="0" z="0"/></transform><models><model
                   command="plane )" +
                   std::to_string(z) +
                   "\"><color><diffuse R=\"0\" G=\"0\" B=\"0\"/>"
                   "<ambient R=\"0\" G=\"0\" B=\"0\"/><emissive " +
                   color + "/></color></model></models></group>";
        };
        const std::string red = quad(front, R"(R="255" G="0" B="0")");
        const std::string blue = quad(back, R"(R="0" G="0" B="255")");
        return draw(
            "<world><camera><position x=\"0\" y=\"0\" z=\"0\"/><lookAt x=\"0\" y=\"0\" z=\"-1\"/>"
            "<projection fov=\"30\" near=\"0.1\" far=\"10000000\"/></camera><lights>"
            "<light type=\"directional\" dirx=\"0\" diry=\"0\" dirz=\"1\"/></lights>" +
            (*order == 'f' ? red + blue : blue + red) + "</world>");
    };
    for (const double depth : {1.0, 1e3, 1e6})
        for (const char* order : {"front first", "back first"}) {
            INFO(depth << ' ' << order);
            const image::Image image = pair(depth, depth * (1.0 + 1e-6), order);
            CHECK(pixel(image, 32, 32).r > 200);
            CHECK(pixel(image, 32, 32).b == 0);
        }
}

TEST_CASE("non-uniform, negative and singular scales keep finite, outward normals") {
    for (const char* scale :
         {R"(x="3" y="0.1" z="1")", R"(x="-1" y="1" z="1")", R"(x="-1" y="-0.5" z="-2")",
          R"(x="1" y="0" z="1")", R"(x="1" y="0.0000001" z="1")"}) {
        INFO(scale);
        const image::Image image =
            draw("<world>" + std::string(kCamera) + kSun +
                 "<group><transform><rotate angle=\"30\" x=\"1\" y=\"0\" z=\"1\"/><scale " + scale +
                 "/></transform><models><model command=\"sphere 1\" "
                 "twoSided=\"true\"/></models></group></world>");
        CHECK(covered(image) > 100);
    }
    // Flattened twice: nothing but a line is left, and nothing fails.
    draw("<world>" + std::string(kCamera) + kSun +
         "<group><transform><scale x=\"1\" y=\"0\" z=\"0\"/></transform><models>"
         "<model command=\"torus 1 0.4\"/></models></group></world>");
}

TEST_CASE("a mirrored scene gives the mirrored picture") {
    const auto half = [](double sign, const char* command) {
        const auto x = [&](double value) { return std::to_string(sign * value); };
        return draw("<world><window width=\"64\" height=\"64\"/><camera><position x=\"" + x(1) +
                    "\" y=\"2\" z=\"4\"/><lookAt x=\"0\" y=\"0\" z=\"0\"/><projection fov=\"50\" "
                    "near=\"0.5\" "
                    "far=\"50\"/></camera><lights><light type=\"directional\" dirx=\"" +
                    x(1) +
                    "\" diry=\"2\" dirz=\"1.5\"/></lights><group><transform><translate x=\"" +
                    x(0.4) + "\" y=\"0\" z=\"0\"/><scale x=\"" + x(1) +
                    "\" y=\"1\" z=\"1\"/></transform><models><model command=\"" + command +
                    "\"/></models></group></world>");
    };
    for (const char* command :
         {"sphere 1", "cone 1 1.5", "torus 1 0.3", "box 1", "patch teapot.patch"}) {
        const image::Image right = half(1, command), left = half(-1, command);
        int off = 0;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x) {
                const glm::ivec3 d = glm::abs(pixel(right, x, y) - pixel(left, 63 - x, y));
                off += std::max({d.r, d.g, d.b}) > 2 ? 1 : 0;
            }
        INFO(command);
        // A pixel's centre on an outline falls to one side in both: left edges are in, right ones
        // out.
        CHECK(off <= 8);
    }
}

TEST_CASE("up along the view is replaced, eye on target refused") {
    const auto looking = [](const char* up) {
        return draw(world("<model command=\"box 1\"/>",
                          "<position x=\"0\" y=\"5\" z=\"0\"/><lookAt x=\"0\" y=\"0\" z=\"0\"/>" +
                              std::string(up) +
                              "<projection fov=\"40\" near=\"0.1\" far=\"100\"/>"));
    };
    CHECK(covered(looking("<up x=\"0\" y=\"1\" z=\"0\"/>")) > 100);
    CHECK(covered(looking("<up x=\"0\" y=\"-1\" z=\"0.000000001\"/>")) > 100);
    CHECK(codeOf(world("", R"(<position x="1" y="1" z="1"/><lookAt x="1" y="1" z="1"/>)")) != "");
}

TEST_CASE("numbers that are none, and zero directions, are refused where they stand") {
    for (const char* bad : {"nan", "inf", "1e999", "abc"})
        CHECK(codeOf(world("<model command=\"box 1\"/>",
                           "<position x=\"" + std::string(bad) + "\" y=\"0\" z=\"5\"/>")) != "");
    CHECK(codeOf("<world><lights><light type=\"directional\" dirx=\"0\" diry=\"0\" dirz=\"0\"/>"
                 "</lights></world>") == "scene.zero-direction");
}

TEST_CASE("a light at the very place of a pixel leaves its ambient, no NaN") {
    // The sphere's nearest point is (0, 0, 1): the picture's middle, where a pixel's centre is.
    const image::Image image = draw(
        R"(<world><window width="65" height="65"/><camera><position x="0" y="0" z="5"/>
        <lookAt x="0" y="0" z="0"/><projection fov="40" near="0.1" far="100"/></camera><lights>
        <light type="point" posx="0" posy="0" posz="1"/></lights><group><models>
        <model command="sphere 1"/></models></group></world>)");
    CHECK(lit(image, 32, 32));
}

TEST_CASE("shininess 0 and exponent 0 are 1 within the cone") {
    const image::Image image =
        draw("<world>" + std::string(kCamera) +
             R"(<lights><light type="spot" posx="0" posy="0" posz="5" dirx="0" diry="0" dirz="-1"
        cutoff="40" exponent="0"/></lights><group><models><model command="sphere 1"><color>
        <diffuse R="0" G="0" B="0"/><ambient R="0" G="0" B="0"/><specular R="100" G="100" B="100"/>
        <shininess value="0"/></color></model></models></group></world>)");
    CHECK(std::abs(pixel(image, 32, 32).r - 100) <= 1);
}

TEST_CASE("collapsed edges of patches, poles, seams and apexes have normals") {
    for (const char* command :
         {"patch teapot.patch 7", "sphere 1 8 5", "sphere 1", "cone 1 1 9 1", "cone 1 1"}) {
        render::PictureOptions options;
        options.layer = render::Layer::normal;
        const image::Image image =
            draw(world("<model command=\"" + std::string(command) + "\"/>"), options);
        int wrong = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const glm::ivec3 p = pixel(image, x, y);
                if (p == glm::ivec3(0)) continue;  // the background
                const double length = glm::length(glm::dvec3(p) / 127.5 - 1.0);
                wrong += std::abs(length - 1.0) > 0.02 ? 1 : 0;
            }
        INFO(command);
        CHECK(wrong == 0);
    }
}

TEST_CASE("a box round the camera is not culled") {
    const image::Image image =
        draw(world("<model command=\"box 1000\" twoSided=\"true\"/>",
                   R"(<position x="0" y="0" z="0"/><lookAt x="1" y="0.3" z="0.2"/>
                 <projection fov="60" near="0.1" far="5000"/>)"));
    CHECK(covered(image) == 64 * 64);
}

TEST_CASE(
    "narrow and wide views, pictures of one pixel, broad ones and shapes cut by the near plane") {
    for (const double fov : {0.01, 1.0, 120.0, 179.0}) {
        render::PictureOptions options;
        options.fovDeg = fov;
        INFO(fov);
        CHECK(draw(still(0.0), options).pixels == draw(still(0.0), options).pixels);
    }
    render::PictureOptions one;
    one.width = one.height = 1;
    CHECK(lit(draw(still(0.0), one), 0, 0));
    render::PictureOptions broad;
    broad.width = 256;
    broad.height = 64;
    CHECK(covered(draw(still(0.0), broad)) > 1000);
    // Through the middle of the torus and the sphere.
    CHECK(covered(draw(world("<model command=\"sphere 1\" twoSided=\"true\"/>",
                             R"(<position x="0" y="0" z="1.05"/><lookAt x="0" y="0" z="0"/>
                                <projection fov="90" near="0.5" far="100"/>)"))) == 64 * 64);
}

TEST_CASE("faces in one plane give the same picture every time: the first drawn stays") {
    const std::string two =
        R"(<model command="plane 2"><color><diffuse R="250" G="0" B="0"/></color>
        </model><model command="plane 2"><color><diffuse R="0" G="0" B="250"/></color></model>)";
    const image::Image image = draw(world(two));
    CHECK(pixel(image, 32, 40).r > pixel(image, 32, 40).b);
    CHECK(draw(world(two)).pixels == image.pixels);
}

TEST_CASE("a world scaled by a power of two gives the same bytes") {
    const auto scaled = [](double s) {
        const auto n = [&](double value) { return std::to_string(s * value); };
        return draw("<world><camera><position x=\"" + n(2.25) + "\" y=\"" + n(1.5) + "\" z=\"" +
                    n(3) + "\"/><lookAt x=\"0\" y=\"0\" z=\"0\"/><projection fov=\"50\" near=\"" +
                    n(0.5) + "\" far=\"" + n(64) + "\"/></camera>" + kSun +
                    "<group><models><model command=\"sphere " + n(1) +
                    "\"/><model command=\"torus " + n(1.5) + " " + n(0.25) +
                    "\"/></models></group></world>");
    };
    const image::Image one = scaled(1.0);
    CHECK(covered(one) > 500);
    CHECK(scaled(4.0).pixels == one.pixels);
    CHECK(scaled(1024.0).pixels == one.pixels);
    CHECK(shareOff(one, scaled(3.7), 2) <= 1e-4);
}
