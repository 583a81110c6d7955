#include <catch2/catch.hpp>

#include "image/format.h"
#include "tests/numerics/sweep.h"

// Meshes that lie far away in their files, or are of any size there.
using namespace farol;
using namespace farol::numerics;

namespace {

constexpr int kSide = 64;
using Files = std::map<std::string, std::string>;

constexpr glm::dvec3 kCorners[] = {{-1, -1, 0.125}, {1, -0.875, 0}, {0.25, 1, 0}, {0, 0, 1}};
constexpr int kFaces[4][3] = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 2}};

std::string words(const glm::dvec3& p) {
    return text(p.x) + ' ' + text(p.y) + ' ' + text(p.z) + '\n';
}

/// A tetrahedron with coordinates in eighths, which far doubles hold, times `scale`.
std::string objAt(const glm::dvec3& move, const glm::dvec2& turns = {}, double scale = 1.0) {
    std::string out;
    for (const glm::dvec3& p : kCorners) out += "v " + words(scale * (p + move));
    for (const glm::dvec2& uv : {glm::dvec2(0, 0), {1, 0.125}, {0.5, 1}, {0.25, 0.5}})
        out += "vt " + text(uv.x + turns.x) + ' ' + text(uv.y + turns.y) + '\n';
    return out + "f 1/1 2/2 4/4\nf 2/2 3/3 4/4\nf 3/3 1/1 4/4\nf 2/2 1/1 3/3\n";
}

/// The same by the file's ending; without texture coordinates but in OBJ.
std::string fileAt(const std::string& ending, const glm::dvec3& move) {
    std::string vertices, faces, facets, rows;
    for (const glm::dvec3& p : kCorners) vertices += words(p + move);
    for (const auto& face : kFaces) {
        faces += '3';
        facets += "facet normal 0 0 0\nouter loop\n";
        for (const int corner : face) {
            faces += ' ' + std::to_string(corner);
            facets += "vertex " + words(kCorners[corner] + move);
            rows += words(kCorners[corner] + move);
        }
        faces += '\n';
        facets += "endloop\nendfacet\n";
    }
    if (ending == "ply")
        return "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
               "property double z\nelement face 4\nproperty list uchar int vertex_indices\n"
               "end_header\n" +
               vertices + faces;
    if (ending == "off") return "OFF\n4 4 0\n" + vertices + faces;
    if (ending == "stl") return "solid a\n" + facets + "endsolid a\n";
    if (ending == "3d") return "12\n" + rows;
    return objAt(move);
}

/// 8 x 8 px, no two alike.
std::string picture() {
    image::Image image{8, 8, {}};
    for (int i = 0; i < 64; ++i)
        for (const int value : {40 + 3 * i, 255 - 4 * i, (i * 37) % 256, 255})
            image.pixels.push_back(static_cast<std::uint8_t>(value));
    return image::encodePng(image);
}

std::string sceneOf(const std::string& model, const glm::dvec3& at, const std::string& moves = "") {
    Camera camera;
    camera.eye = at + glm::dvec3(0.5, 0.75, 4.0);
    camera.target = at;
    camera.fovDeg = 40.0;
    return "<world>" + camera.xml() +
           R"(<lights><light type="directional" dirx="1" diry="2" dirz="3"/></lights><group>)" +
           moves + "<models>" + model + "</models></group></world>";
}

std::string textured(const std::string& file, const std::string& more = "") {
    return "<model file=\"" + file + "\"><texture file=\"t.png\"/>" + more + "</model>";
}

image::Image drawn(const std::string& xml, Files files) {
    files["t.png"] = picture();
    return draw(xml, kSide, {}, files);
}

int covered(const image::Image& image) {
    int count = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) count += pixel(image, x, y) != glm::ivec3(0) ? 1 : 0;
    return count;
}

/// Sixteen control points in eighths, moved.
std::string patchAt(const glm::dvec3& move) {
    std::string out = "1\n0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15\n16\n";
    for (int i = 0; i < 16; ++i) {
        const glm::dvec3 p = glm::dvec3(i % 4 - 1.5, 1.5 - i / 4, ((i * 5) % 7) / 8.0) + move;
        out += text(p.x) + ", " + text(p.y) + ", " + text(p.z) + '\n';
    }
    return out;
}

std::string profileAt(double up) {
    std::string out =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\n"
        "property double y\nproperty double z\nend_header\n";
    for (const glm::dvec2& p : {glm::dvec2(0, -1), {1, -0.5}, {0.75, 0.5}, {0, 1}})
        out += text(p.x) + ' ' + text(p.y + up) + " 0\n";
    return out;
}

}  // namespace

TEST_CASE("a mesh that is far away in its file is drawn as at the origin, byte for byte") {
    for (const double far : {0x1p20, 1e9}) {
        const glm::dvec3 move(far, -far, 2.0 * far);
        for (const std::string ending : {"obj", "ply", "off", "stl", "3d"}) {
            const std::string name = "a." + ending;
            INFO(name << " moved by " << far);
            const std::string model =
                ending == "obj" ? textured(name) : "<model file=\"" + name + "\"/>";
            const image::Image expected = drawn(sceneOf(model, {}), {{name, fileAt(ending, {})}});
            CHECK(covered(expected) > 500);
            const Files moved{{name, fileAt(ending, move)}};
            CHECK(drawn(sceneOf(model, move), moved).pixels == expected.pixels);
            // Brought back by the scene.
            const std::string back = "<transform><translate " + xyz(-move) + "/></transform>";
            CHECK(drawn(sceneOf(model, {}, back), moved).pixels == expected.pixels);
        }
    }
}

TEST_CASE("patches and profiles far away in their files are drawn as at the origin") {
    const std::string patch = R"(<model command="patch p.patch" twoSided="true"/>)";
    const std::string turned = R"(<model file="p.ply" revolve="20"/>)";
    const std::string open = R"(<model command="revolution p.ply"/>)";
    for (const double far : {0x1p20, 1e9}) {
        const glm::dvec3 move(far, -far, 2.0 * far), up(0.0, far, 0.0);
        const image::Image still = drawn(sceneOf(patch, glm::dvec3(0)), {{"p.patch", patchAt({})}});
        CHECK(covered(still) > 500);
        CHECK(drawn(sceneOf(patch, move), {{"p.patch", patchAt(move)}}).pixels == still.pixels);
        for (const std::string& model : {turned, open}) {
            const image::Image vase =
                drawn(sceneOf(model, glm::dvec3(0)), {{"p.ply", profileAt(0)}});
            CHECK(covered(vase) > 500);
            CHECK(drawn(sceneOf(model, up), {{"p.ply", profileAt(far)}}).pixels == vase.pixels);
        }
    }
}

TEST_CASE("texture coordinates far from 0 draw what those at 0 do, byte for byte") {
    const Files near{{"a.obj", objAt({})}};
    const image::Image expected = drawn(sceneOf(textured("a.obj"), glm::dvec3(0)), near);
    Sweep sweep("texture coordinates", 12);
    for (int i = 0; i < sweep.cases(); ++i) {
        const glm::dvec2 turns(std::floor(sweep.power(100.0, 1e12)),
                               -std::floor(sweep.power(100.0, 1e12)));
        INFO(turns.x << ' ' << turns.y);
        const Files far{{"a.obj", objAt({}, turns)}};
        CHECK(drawn(sceneOf(textured("a.obj"), glm::dvec3(0)), far).pixels == expected.pixels);
    }
}

TEST_CASE("far texture coordinates that a material scales or clamps keep their place") {
    // Half of an odd number of turns is no whole number of them; clamped, turns are the edge.
    for (const std::string option : {"-s 0.5 0.25", "-clamp on", "-o -7 9 -clamp on"}) {
        const auto files = [&](const glm::dvec2& turns, const std::string& offset) {
            return Files{{"a.obj", "mtllib a.mtl\nusemtl m\n" + objAt({}, turns)},
                         {"a.mtl", "newmtl m\nKd 1 1 1\nmap_Kd " + option + offset + " t.png\n"}};
        };
        INFO(option);
        const std::string model = R"(<model file="a.obj"/>)";
        if (option.starts_with("-s")) {
            const image::Image expected =
                drawn(sceneOf(model, {}), files({0.0, 0.0}, " -o 0.5 0.25"));
            const image::Image far = drawn(sceneOf(model, {}), files({100001.0, 200001.0}, ""));
            CHECK(covered(expected) > 500);
            CHECK(far.pixels == expected.pixels);
        } else {
            // Beyond the edge there is one colour in each corner's direction.
            const image::Image far = drawn(sceneOf(model, {}), files({100001.0, 200001.0}, ""));
            const image::Image edge = drawn(sceneOf(model, {}), files({40.0, 40.0}, ""));
            CHECK(covered(far) > 500);
            CHECK(far.pixels == edge.pixels);
        }
    }
}

TEST_CASE("texgen offsets far from 0 draw what those at 0 do") {
    const auto with = [](double s, double t, const std::string& mode) {
        return textured("a.obj", "<texgen mode=\"" + mode + "\" s=\"1 0 0.25 " + text(s) +
                                     "\" t=\"0 1 0.5 " + text(t) + "\"/>");
    };
    const Files files{{"a.obj", objAt({})}};
    for (const std::string mode : {"object", "eye"}) {
        const image::Image expected = drawn(sceneOf(with(0.25, 0.5, mode), {}), files);
        CHECK(covered(expected) > 500);
        CHECK(drawn(sceneOf(with(1000000.25, -3000000.5, mode), {}), files).pixels ==
              expected.pixels);
    }
    // The planes of a far mesh are far, too.
    const image::Image expected = drawn(sceneOf(with(0.25, 0.5, "object"), {}), files);
    const glm::dvec3 move(0x1p20, -0x1p21, 0x1p22);
    CHECK(drawn(sceneOf(with(0.25, 0.5, "object"), move), {{"a.obj", objAt(move)}}).pixels ==
          expected.pixels);
}

TEST_CASE("meshes of any size in their files draw what those of size 1 do") {
    const image::Image expected = drawn(sceneOf(textured("a.obj"), {}), {{"a.obj", objAt({})}});
    for (const int exponent : {-100, -80, -60, -30, 30, 45, 59}) {
        INFO("times 2^" << exponent);
        // <scale> takes 1e18 at most: two of them.
        const double half = std::exp2(-exponent / 2), rest = std::exp2(-exponent - -exponent / 2);
        const std::string moves = "<transform><scale " + xyz(glm::dvec3(half)) + "/><scale " +
                                  xyz(glm::dvec3(rest)) + "/></transform>";
        const Files files{{"a.obj", objAt({}, {}, std::exp2(exponent))}};
        CHECK(drawn(sceneOf(textured("a.obj"), {}, moves), files).pixels == expected.pixels);
    }
}
