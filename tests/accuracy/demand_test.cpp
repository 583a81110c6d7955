#include <catch2/catch.hpp>

#include "tests/accuracy/measure.h"
#include "tests/accuracy/pattern.h"

// Shapes whose divisions are left open: pixels take normals and texture coordinates from the
// surface itself, so that what is inside an outline does not depend on the mesh.
using namespace farol;
using namespace farol::accuracy;

namespace {

struct Case {
    std::string name, shape, transform;
};

const std::string kSqueezed =
    R"(<rotate angle="35" x="1" y="2" z="0"/><scale x="-1.3" y="0.6" z="0.9"/>)";

std::string document(const Case& one, bool textured, double near = 1.0) {
    return R"(<world><window width="300" height="300"/>
        <camera><position x="2.2" y="1.9" z="3.1"/><lookAt x="0" y="0.2" z="0"/>
        <projection fov="50" near=")" +
           std::to_string(near) + R"(" far="100"/></camera>
        <lights><light type="directional" dirx="1" diry="2" dirz="1.5"/>
        <light type="point" posx="2" posy="1" posz="4" constant="1" linear="0.1"/></lights>
        <group><transform>)" +
           one.transform + "</transform><models><model " + one.shape + ">" +
           (textured ? R"(<texture file="it.png"/>)" : "") +
           R"(<color><diffuse R="150" G="80" B="60"/><ambient R="20" G="20" B="30"/>
              <specular R="120" G="120" B="120"/><shininess value="12"/></color>
              </model></models></group></world>)";
}

std::vector<Case> cases() {
    std::vector<Case> all;
    for (const std::string command :
         {"sphere 1", "ellipsoid 1.2 0.5 0.9", "cone 1 1.5", "cylinder 0.8 1", "frustum 0.5 1 1",
          "frustum 1 0.2 0.3", "torus 1 0.4", "ring 0.4 1.2", "dome 1.1"})
        for (const bool squeezed : {false, true})
            all.push_back({command + (squeezed ? ", squeezed" : ""), "command=\"" + command + "\"",
                           squeezed ? kSqueezed : ""});
    all.push_back({"dome 1.1 from below", "command=\"dome 1.1\"",
                   R"(<translate x="0" y="0.5" z="0"/><rotate angle="200" x="1" y="0" z="0"/>)"});
    for (const std::string command : {"cone 1 1.5", "cylinder 0.8 1"})
        all.push_back({command + " atlas", "uv=\"atlas\" command=\"" + command + "\"", ""});
    return all;
}

}  // namespace

TEST_CASE("open shapes are exact within their outlines at any error bound") {
    const Supplies given = supplies(256, 192);
    for (const Case& one : cases())
        for (const bool textured : {false, true})
            for (const double errorPx : {0.25, 0.9}) {
                render::PictureOptions options;
                options.samples = 1;
                options.errorPx = errorPx;
                options.viewer = textured ? scene::Viewer::local : scene::Viewer::infinite;
                const Figures figures =
                    measure(document(one, textured), options, given.files, given.assets);
                const std::string title =
                    one.name + (textured ? " textured" : "") + " " + std::to_string(errorPx);
                print(title, figures);
                INFO(title);
                REQUIRE(figures.interior.pixels > 3000);
                CHECK(figures.stray == 0);
                // Rounding to bytes is an rms of 0.29; llvmpipe's 8-bit filter weights are the rest
                // where there is a texture.
                CHECK(figures.interior.rms < (textured ? 0.5 : 0.33));
                // The top of the flat frustum shows the whole picture on 25 px: three mipmap levels
                // down, at one level of detail for each four pixels.
                const bool shrunk = one.name == "frustum 1 0.2 0.3";
                CHECK(figures.interior.percentile999 < (shrunk ? 3.0 : textured ? 2.0 : 1.0));
            }
}

TEST_CASE("the insides of open shapes are as exact") {
    const Supplies given = supplies(256, 192);
    for (const std::string command :
         {"sphere 1", "cone 1 1.5", "cylinder 0.8 1", "frustum 0.5 1 1", "torus 1 0.4", "dome 1.1"})
        for (const bool textured : {false, true}) {
            // The near plane cuts the front away.
            const Case one{command, "command=\"" + command + "\" twoSided=\"true\"",
                           R"(<translate x="0" y="0.2" z="0"/>)"};
            render::PictureOptions options;
            options.samples = 1;
            const Figures figures =
                measure(document(one, textured, 4.2), options, given.files, given.assets);
            print(command + (textured ? " inside, textured" : " inside"), figures);
            INFO(command);
            REQUIRE(figures.interior.pixels > 1000);
            CHECK(figures.stray == 0);
            CHECK(figures.interior.rms < (textured ? 0.5 : 0.33));
            CHECK(figures.interior.percentile999 < (textured ? 2.0 : 1.0));
        }
}

TEST_CASE("turned profiles take the turn's normals and coordinates from each pixel") {
    const Supplies given = supplies(256, 192);
    for (const bool squeezed : {false, true})
        for (const bool textured : {false, true}) {
            const Case one{"vase", R"(command="revolution profile.ply")",
                           squeezed ? kSqueezed : ""};
            render::PictureOptions options;
            options.samples = 1;
            options.errorPx = 0.25;
            const Figures figures =
                measure(document(one, textured), options, given.files, given.assets);
            const std::string title = std::string("vase") + (squeezed ? ", squeezed" : "") +
                                      (textured ? ", textured" : "");
            print(title, figures);
            INFO(title);
            REQUIRE(figures.interior.pixels > 3000);
            CHECK(figures.interior.rms < 0.5);
            // Where the surface is seen nearly edge-on, a ray meets it well beside the facet, and
            // without a texture there are 64 facets: 4.5 when squeezed.
            CHECK(figures.interior.percentile999 < (textured ? 2.0 : 5.0));
        }
}
