// The data of a mesh file beside its triangles: colours, materials, smoothing groups, and places
// far from the origin.
#include <catch2/catch.hpp>
#include <cmath>

#include "generator/io/mesh_file.h"
#include "generator/io/mtl.h"
#include "generator/registry.h"
#include "tests/unit/generator/checks.h"

using namespace checks;
using farol::Diagnostics;
using farol::generator::io::decodeMesh;
using farol::generator::io::encodeMesh;
using farol::generator::io::Format;
namespace scene = farol::scene;

namespace {

using Color = glm::u8vec4;

Mesh decoded(const std::string& bytes, const std::string& name) {
    Diagnostics findings;
    Mesh mesh = decodeMesh(bytes, name, findings);
    CHECK(findings.empty());
    return mesh;
}

std::string ply(const std::string& vertexColor, const std::string& faceColor,
                const std::string& body) {
    return "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
           "property double z\n" +
           vertexColor + "element face 2\nproperty list uchar int vertex_indices\n" + faceColor +
           "end_header\n" + body;
}

const std::string kTube =
    "v 1 0 0\nv 0 0 1\nv -1 0 0\nv 0 0 -1\nv 1 2 0\nv 0 2 1\nv -1 2 0\nv 0 2 -1\n";

std::string tube(const std::string& before, const std::string& between = "") {
    return kTube + before + "f 1 5 6 2\nf 2 6 7 3\n" + between + "f 3 7 8 4\nf 4 8 5 1\n";
}

}  // namespace

TEST_CASE("colours of vertices are read from OBJ, PLY and OFF") {
    const Mesh obj = decoded("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0\nf 1 2 3\n", "a.obj");
    CHECK(obj.colors() ==
          std::vector<Color>{{255, 0, 0, 255}, {0, 255, 0, 255}, {255, 255, 255, 255}});
    const Mesh bytes =
        decoded("v 0 0 0 255 51 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 0\nf 1 2 3\n", "a.obj");
    CHECK(bytes.colors()[0] == Color(255, 51, 0, 255));
    const std::string corners = "0 0 0 ", faces = "3 0 1 2\n3 0 2 3\n";
    const Mesh uchar =
        decoded(ply("property uchar red\nproperty uchar green\nproperty uchar blue\n", "",
                    "0 0 0 10 20 30\n1 0 0 0 0 0\n1 1 0 0 0 0\n0 1 0 255 255 255\n" + faces),
                "a.ply");
    CHECK(uchar.colors()[0] == Color(10, 20, 30, 255));
    const Mesh real =
        decoded(ply("property float red\nproperty float green\nproperty float blue\n", "",
                    "0 0 0 0.2 1 2\n1 0 0 nan 0 0\n1 1 0 0 0 0\n0 1 0 1 1 1\n" + faces),
                "a.ply");
    CHECK(real.colors()[0] == Color(51, 255, 255, 255));
    CHECK(real.colors()[1] == Color(0, 0, 0, 255));
    const Mesh off = decoded(
        "COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 0 9 0 255\n0 1 0 0 0 1 255\n3 0 1 2\n", "a.off");
    CHECK(off.colors()[1] == Color(0, 9, 0, 255));
}

TEST_CASE("colours of faces give each face its own vertices") {
    for (const Mesh& mesh :
         {decoded("OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 1 0 0\n3 0 2 3 0 0 1\n",
                  "a.off"),
          decoded(ply("", "property uchar red\nproperty uchar green\nproperty uchar blue\n",
                      "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 255 0 0\n3 0 2 3 0 0 255\n"),
                  "a.ply")}) {
        REQUIRE(mesh.positions().size() == 6);
        for (std::size_t i = 0; i < 6; ++i)
            CHECK(mesh.colors()[mesh.indices()[i]] ==
                  (i < 3 ? Color(255, 0, 0, 255) : Color(0, 0, 255, 255)));
    }
}

TEST_CASE("vertices without a face do not disturb those of coloured faces") {
    const Mesh mesh =
        decoded("OFF\n6 1 0\n9 9 9\n9 9 8\n9 8 8\n0 0 0\n1 0 0\n0 1 0\n3 3 4 5 0 0 1\n", "a.off");
    CHECK(mesh.positions().size() == 3);
    for (const glm::vec3& normal : mesh.normals()) CHECK(normal == glm::vec3(0, 0, 1));
}

TEST_CASE("colours are written and read back") {
    const Mesh mesh =
        decoded("v 0 0 0 0.1 0.7 0.3\nv 1 0 0 0 1 0\nv 0 1 0 1 1 0.5\nf 1 2 3\n", "a.obj");
    for (const Format format : {Format::obj, Format::ply, Format::binary})
        CHECK(decoded(encodeMesh(mesh, format), "x") == mesh);
}

TEST_CASE("smoothing groups decide which corners share a computed normal") {
    const Mesh smooth = decoded(tube("s 1\n"), "a.obj");
    CHECK(smooth.positions().size() == 8);
    for (std::size_t i = 0; i < 8; ++i) {
        const glm::vec3 outward(smooth.positions()[i].x, 0, smooth.positions()[i].z);
        CHECK(glm::dot(smooth.normals()[i], glm::normalize(outward)) > 0.9F);
    }
    for (const char* facets : {"", "s off\n", "s 0\n"}) {
        const Mesh flat = decoded(tube(facets), "a.obj");
        CHECK(flat.positions().size() == 16);
        for (const glm::vec3& n : flat.normals())
            CHECK(std::abs(std::abs(n.x) - std::sqrt(0.5F)) < 1e-6F);
    }
    // Two groups: their common edges are creases.
    const Mesh both = decoded(tube("s 1\n", "s 2\n"), "a.obj");
    CHECK(both.positions().size() == 12);
    CHECK(std::abs(both.normals()[0].x - std::sqrt(0.5F)) < 1e-6F);
}

TEST_CASE("a texture's seam is no edge of a smoothing group") {
    const Mesh mesh = decoded(
        "v -1 0 0\nv 0 0 1\nv 1 0 0\nv -1 1 0\nv 0 1 1\nv 1 1 0\nvt 0 0\nvt 1 1\ns 1\n"
        "f 1/1 2/1 5/1 4/1\nf 2/2 3/2 6/2 5/2\n",
        "a.obj");
    REQUIRE(mesh.positions().size() == 8);
    for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t k = 0; k < 8; ++k)
            if (mesh.positions()[i] == mesh.positions()[k])
                CHECK(mesh.normals()[i] == mesh.normals()[k]);
}

TEST_CASE("triangles are sorted by the materials that they name") {
    const Mesh mesh = decoded(
        "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl red  paint \nf 1 2 3\n"
        "usemtl blue\nf 1 2 4\nusemtl red  paint\nf 2 3 4\nf 1 4 3\n",
        "a.obj");
    REQUIRE(mesh.parts().size() == 2);
    CHECK(mesh.parts()[0] == farol::generator::MeshPart{"red  paint", 0, 9});
    CHECK(mesh.parts()[1] == farol::generator::MeshPart{"blue", 9, 3});
    CHECK(decoded("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "a.obj").parts().empty());
}

TEST_CASE("an .mtl file's materials") {
    Diagnostics findings;
    const auto all = farol::generator::io::parseMtl(
        "# made by hand\nnewmtl red  paint\r\nKd 1 0.5 0\nKs 0.5 0.5 0.5\nNs 40\nKe 0 0 0.1\n"
        "Ka 1 1 1\nd 0.5\nmap_Kd -s 2 3 1 -o 0.5 0 -clamp on -bm 0.3 my wood.png\nbump b.png\n"
        "newmtl dull\n\tKd .2\nKs 1 1 1\nillum 1\nTr 0.25\nnewmtl black\nKd 0 0 0\nd 0\n"
        "map_Kd C:\\work\\tex\\a.png\nKd nonsense\n",
        "a.mtl", findings);
    REQUIRE(all.size() == 3);
    CHECK(all[0].name == "red  paint");
    CHECK(all[0].material.diffuse.rgb == glm::vec3(1, 0.5, 0));
    CHECK(all[0].material.ambient.rgb == glm::vec3(0.25, 0.125, 0));
    CHECK(all[0].material.specular.rgb == glm::vec3(0.5));
    CHECK(all[0].material.emissive.rgb == glm::vec3(0, 0, 0.1F));
    CHECK(all[0].material.shininess == 40.0F);
    CHECK(all[0].material.opacity == 0.5F);
    REQUIRE(all[0].texture);
    CHECK(all[0].texture->file == "my wood.png");
    CHECK(all[0].texture->scale == glm::dvec2(2, 3));
    CHECK(all[0].texture->offset == glm::dvec2(0.5, 0));
    CHECK(all[0].texture->clamp);
    CHECK(all[1].material.diffuse.rgb == glm::vec3(0.2F));
    CHECK(all[1].material.specular.rgb == glm::vec3(0));
    CHECK(all[1].material.opacity == 0.75F);
    CHECK(all[2].material.opacity == 1.0F);  // some programs write 0 and mean opaque
    CHECK_FALSE(all[1].texture);
    CHECK(all[2].material.diffuse.rgb == glm::vec3(1));  // the picture says all
    CHECK(all[2].texture->file == "C:/work/tex/a.png");
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].code == "mesh.left-out");
    CHECK_THAT(findings[0].message, Catch::Contains("1 maps that are not drawn") &&
                                        Catch::Contains("1 colours that are no numbers"));
}

TEST_CASE("material files are named by mtllib lines") {
    using farol::generator::io::materialLibraries;
    CHECK(materialLibraries("# mtllib no\nmtllib my  colours.mtl \r\n o x\n\tmtllib b\\c.mtl\n"
                            "mtllib my  colours.mtl\nxmtllib d\nmtllibe\n") ==
          std::vector<std::string>{"my  colours.mtl", "b/c.mtl"});
    std::string many;
    for (int i = 0; i < 100; ++i) many += "mtllib " + std::to_string(i) + "\n";
    CHECK(materialLibraries(many).size() == 16);
}

TEST_CASE("a mesh far from the origin keeps its digits") {
    const auto at = [](double x, double y, double z, const char* head) {
        std::string out;
        for (const glm::dvec3& p :
             {glm::dvec3(0), glm::dvec3(0.125, 0, 0), glm::dvec3(0, 1, 0.25)}) {
            char line[120];
            std::snprintf(line, sizeof line, "%s%.10f %.10f %.10f\n", head, p.x + x, p.y + y,
                          p.z + z);
            out += line;
        }
        return out;
    };
    const Mesh near = decoded(at(0, 0, 0, "v ") + "f 1 2 3\n", "a.obj");
    CHECK(near.origin() == glm::dvec3(0));
    for (const double move : {1024.0, 512345.0, 4512345.5, 1e9, -3e9}) {
        CAPTURE(move);
        const std::string rows = at(move, 120, -move, "");
        for (const auto& [bytes, name] :
             {std::pair(at(move, 120, -move, "v ") + "f 1 2 3\n", "a.obj"), std::pair(rows, "a.3d"),
              std::pair("OFF\n3 1 0\n" + rows + "3 0 1 2\n", "a.off"),
              std::pair("ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\n"
                        "property double y\nproperty double z\nelement face 1\n"
                        "property list uchar int vertex_indices\nend_header\n" +
                            rows + "3 0 1 2\n",
                        "a.ply")}) {
            CAPTURE(name);
            const Mesh far = decoded(bytes, name);
            for (std::size_t i = 0; i < 3; ++i)
                CHECK(far.place(i) == near.place(i) + glm::dvec3(move, 120, -move));
            CHECK(far.normals()[0] == near.normals()[0]);
            for (const Format format : {Format::text3d, Format::obj, Format::ply, Format::binary})
                CHECK(decoded(encodeMesh(far, format), "x").place(2) == far.place(2));
        }
    }
    // A power of two that the grid divides: the floats are those of the mesh at the origin.
    CHECK(decoded(at(1e9, 0, -1e9, "v ") + "f 1 2 3\n", "a.obj").positions() == near.positions());
}

TEST_CASE("patches and profiles far from the origin keep their digits") {
    const scene::BundleAssets assets(
        {{"near.ply", "1 0\n0.5 0.25\n1 1\n"},
         {"far.ply", "1 1000000000\n0.5 1000000000.25\n1 1000000001\n"}});
    const auto made = [&assets](const std::string& file) {
        return farol::generator::generate(farol::generator::parseCall({"revolution", file, "9"}),
                                          assets);
    };
    const Mesh near = made("near.ply"), far = made("far.ply");
    CHECK(near.origin() == glm::dvec3(0));
    CHECK(far.origin() == glm::dvec3(0, 1e9, 0));
    CHECK(far.positions() == near.positions());
    CHECK(far.normals() == near.normals());
}

TEST_CASE("texture coordinates far from 0 lose whole turns") {
    const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n", faces = "f 1/1 2/2 3/3\n";
    const Mesh near = decoded(corners + "vt 0.25 0\nvt 0.75 0\nvt 0.25 1\n" + faces, "a.obj");
    const Mesh far = decoded(
        corners + "vt 1000000.25 -70000\nvt 1000000.75 -70000\nvt 1000000.25 -69999\n" + faces,
        "a.obj");
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::vec2 turns = far.uvs()[i] - near.uvs()[i];
        CHECK(turns == glm::round(turns));
    }
    CHECK(std::abs(far.uvs()[0].x) < 1.0F);
    CHECK(near.uvOrigin() == glm::dvec2(0));
    CHECK(far.uvOrigin() + glm::dvec2(far.uvs()[0]) == glm::dvec2(1000000.25, -70000));
}
