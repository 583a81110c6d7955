// A mesh's own colours and materials are planned as draws of its parts, and drawn where the scene
// gives none.
#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>

#include "image/format.h"
#include "image/image.h"
#include "render/renderer.h"

using namespace farol;

namespace {

/// Two squares side by side in z = 0: x < 0 of the material "left", x > 0 of "right".
const std::string kObj =
    "mtllib a.mtl\nv -2 -1 0\nv 0 -1 0\nv 0 1 0\nv -2 1 0\nv 2 -1 0\nv 2 1 0\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "usemtl left\nf 1/1 2/2 3/3 4/4\nusemtl right\nf 2/1 5/2 6/3 3/4\n";

image::Image picture() {
    image::Image image{2, 1, {0, 0, 255, 255, 0, 255, 0, 255}};  // blue, green
    return image;
}

std::map<std::string, std::string> files() {
    return {{"a.obj", kObj},
            {"a.mtl", "newmtl left\nKd 1 0 0\nnewmtl right\nKd 1 1 1\nmap_Kd a.png\n"},
            {"a.png", image::encodePng(picture())},
            {"colours.ply",
             "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
             "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
             "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
             "-2 -1 0 255 0 0\n2 -1 0 255 0 0\n2 1 0 255 0 0\n-2 1 0 255 0 0\n4 0 1 2 3\n"}};
}

std::string document(const std::string& file, const std::string& inside) {
    return "<world><camera><position x=\"0\" y=\"0\" z=\"2\"/><lookAt x=\"0\" y=\"0\" z=\"0\"/>"
           "</camera><group><models><model file=\"" +
           file + "\">" + inside + "</model></models></group></world>";
}

image::Image drawn(const std::string& xml, const std::map<std::string, std::string>& beside) {
    render::Job job;
    job.xml = xml;
    job.assets = std::make_shared<scene::BundleAssets>(beside);
    job.options.width = 64;
    job.options.height = 32;
    static render::Renderer renderer;
    image::Image image;
    renderer.draw(job, image);
    return image;
}

/// A pixel of the middle row at `x` of the width, each channel 0 or 255, whichever is nearer.
glm::ivec3 pixelOf(const std::string& file, const std::string& inside, double x) {
    const image::Image image = drawn(document(file, inside), files());
    const auto at = static_cast<std::size_t>(4 * (16 * 64 + static_cast<int>(x * 64)));
    const auto full = [&](std::size_t k) { return image.pixels[at + k] > 128 ? 255 : 0; };
    return {full(0), full(1), full(2)};
}

}  // namespace

TEST_CASE("parts of a mesh have the materials of its file") {
    CHECK(pixelOf("a.obj", "", 0.25) == glm::ivec3(255, 0, 0));
    CHECK(pixelOf("a.obj", "", 0.61) == glm::ivec3(0, 0, 255));
    CHECK(pixelOf("a.obj", "", 0.82) == glm::ivec3(0, 255, 0));
}

TEST_CASE("the scene's colour hides those of the mesh") {
    const std::string green =
        "<color><diffuse R=\"0\" G=\"255\" B=\"0\"/><ambient R=\"0\" G=\"255\" B=\"0\"/></color>";
    for (const char* file : {"a.obj", "colours.ply"})
        CHECK(pixelOf(file, green, 0.25) == glm::ivec3(0, 255, 0));
}

TEST_CASE("colours of vertices are drawn") {
    CHECK(pixelOf("colours.ply", "", 0.25) == glm::ivec3(255, 0, 0));
}

TEST_CASE("a mesh moved by 1e9 in its file and back by its group is the same picture") {
    const auto obj = [](double x, double z) {
        std::string out;
        for (const glm::dvec3& p :
             {glm::dvec3(-1.5, -0.7, 0.1), glm::dvec3(1.3, -1, -0.2), glm::dvec3(0.4, 0.9, 0.35)}) {
            char line[100];
            std::snprintf(line, sizeof line, "v %.4f %.4f %.4f\n", p.x + x, p.y, p.z + z);
            out += line;
        }
        return out + "f 1 2 3\n";
    };
    const auto scene = [](const std::string& move) {
        return "<world><camera><position x=\"0.5\" y=\"0.3\" z=\"3\"/><lookAt x=\"0\" y=\"0\" "
               "z=\"0\"/></camera><lights><light type=\"point\" posX=\"2\" posY=\"3\" "
               "posZ=\"4\"/></lights><group><transform>" +
               move + "</transform><models><model file=\"a.obj\"/></models></group></world>";
    };
    const image::Image near =
        drawn(scene("<translate x=\"0\" y=\"0\" z=\"0\"/>"), {{"a.obj", obj(0, 0)}});
    CHECK(near.pixels[4 * (16 * 64 + 32)] > 50);
    for (const auto& [x, z] : {std::pair(512344.0, -4512344.0), std::pair(1e9, -1e9)}) {
        CAPTURE(x);
        char move[100];
        std::snprintf(move, sizeof move, "<translate x=\"%.0f\" y=\"0\" z=\"%.0f\"/>", -x, -z);
        const image::Image far = drawn(scene(move), {{"a.obj", obj(x, z)}});
        std::size_t off = 0;
        for (std::size_t i = 0; i < near.pixels.size(); ++i)
            off += std::abs(near.pixels[i] - far.pixels[i]) > 1 ? 1 : 0;
        CHECK(off == 0);
    }
}
