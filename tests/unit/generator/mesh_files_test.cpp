#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>

#include "generator/io/mesh_file.h"
#include "generator/registry.h"
#include "tests/support/paths.h"
#include "tests/unit/generator/checks.h"

using namespace checks;
using namespace std::string_literals;
using farol::Diagnostics;
using farol::generator::io::decodeMesh;
using farol::generator::io::encodeMesh;
using farol::generator::io::Format;

namespace {

struct Good {
    const char* name;
    std::string bytes;
    std::size_t vertices, triangles;
    bool uvs;
};

struct Bad {
    const char *name, *code;
    int line;  ///< 0: a file without lines
    std::string bytes;
};

const std::string kPositions = "0 0 0\n1 0 0\n0 1 0\n";
const std::string kNormals = "0 0 1\n0 0 1\n0 0 1\n";
const std::string kUvs = "0 0\n1 0\n0 1\n";

std::string bytesOf(float value, bool big) {
    std::string raw(4, '\0');
    std::memcpy(raw.data(), &value, 4);
    return big ? std::string(raw.rbegin(), raw.rend()) : raw;
}

std::string binaryPly(bool big, const std::string& indices) {
    std::string out = "ply\nformat "s + (big ? "binary_big_endian" : "binary_little_endian") +
                      " 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                      "property float z\nproperty uchar red\nelement face 1\n"
                      "property list uchar ushort vertex_index\nend_header\n";
    for (const glm::vec3 p : {glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)})
        out += bytesOf(p.x, big) + bytesOf(p.y, big) + bytesOf(p.z, big) + "\x7F";
    return out + indices;
}

std::string plyText(const std::string& head, const std::string& body) {
    return "ply\nformat ascii 1.0\n" + head + "end_header\n" + body;
}

const std::string kPlyVertices =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kPlyFaces = "element face 1\nproperty list uchar int vertex_indices\n";

const std::string kStl =
    "solid a name\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1e0 0 0\n"
    "   vertex 0 1 0\n  endloop\n endfacet\nendsolid a name\n";

/// Its remark begins as an ascii file does.
std::string binaryStl() {
    std::string out = "solid facet" + std::string(69, ' ') + "\x01\0\0\0"s;
    for (const float value :
         {0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F})
        out += bytesOf(value, false);
    return out + "\0\0"s;
}

std::vector<Good> goodFiles() {
    const std::string soup8 = "0 0 0 0 0 1 0 0\n1 0 0 0 0 1 1 0\n0 1 0 0 0 1 0 1\n";
    return {
        {"1.3d", kPositions + "\n" + kNormals + "\n" + kUvs + "\n0\n1\n2\n", 3, 1, true},
        {"1 triples.3d", kPositions + "\n" + kNormals + "\n" + kUvs + "\n0 1 2\n", 3, 1, true},
        {"1 crlf.3d", "0 0 0\r\n1 0 0\r\n0 1 0\r\n\r\n\r\n0\r\n1\r\n2\r\n", 3, 1, false},
        {"1 no uv.3d", kPositions + "\n" + kNormals + "\n0\n1\n2\n", 3, 1, false},
        {"1 no normals.3d", kPositions + "\n" + kUvs + "\n0\n1\n2\n", 3, 1, true},
        {"1 commas.3d", "0,0,0\n1,0,0\n0,1,0\n\n0,1,2\n", 3, 1, false},
        {"1 mark.3d", "\xEF\xBB\xBF" + kPositions + "\n0 1 2", 3, 1, false},
        {"2.3d", "3 3\n" + kPositions + kNormals + kUvs + "0 1 2\n", 3, 1, true},
        {"2 blanks.3d", "3 3\n\n" + kPositions + "\n" + kNormals + "\n" + kUvs + "\n0 1 2\n", 3, 1,
         true},
        {"2 triangles.3d", "3 1\n" + kPositions + kNormals + "0 1 2\n", 3, 1, false},
        {"2 single.3d", "3 3\n" + kPositions + "0\n1\n2\n", 3, 1, false},
        {"3.3d", "3\n0\n1\n2\n" + soup8, 3, 1, true},
        {"3 shared.3d", "6\n0\n1\n2\n0\n2\n1\n" + soup8, 3, 2, true},
        {"4.3d", "0 0 0\n0 0 1\n0 0\n1 0 0\n0 0 1\n1 0\n0 1 0\n0 0 1\n0 1\n", 3, 1, true},
        {"4 blanks.3d", "0 0 0\n0 0 1\n0 0\n\n1 0 0\n0 0 1\n1 0\n\n0 1 0\n0 0 1\n0 1\n", 3, 1,
         true},
        {"5.3d", soup8, 3, 1, true},
        {"5 commas.3d", "0,0,0,0,0,1,0,0\n1,0,0,0,0,1,1,0\n0,1,0,0,0,1,0,1\n", 3, 1, true},
        {"six a line.3d", "0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n", 3, 1, false},
        {"6.3d", kPositions + "0 0 1\n1 0 1\n0 1 1\n", 6, 2, false},
        {"6 spaced.3d", kPositions + "\n0 0 1\n1 0 1\n0 1 1\n", 6, 2, false},
        {"7.3d", "6\n0,0,0\n1,0,0\n0,1,0\n0,0,1\n1,0,1\n0,1,1\n", 6, 2, false},
        {"7 triangles.3d", "2\n" + kPositions + "0 0 1\n1 0 1\n0 1 1\n", 6, 2, false},
        {"7 numbers.3d", "9\n" + kPositions, 3, 1, false},
        {"7 eight.3d", "3\n" + soup8, 3, 1, true},
        {"7 six.3d", "1\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n", 3, 1, false},
        {"7 nine.3d", "1\n0 0 0 1 0 0 0 1 0\n", 3, 1, false},
        {"row.3d", "0 0 0 1 0 0 0 1 0 0 0 1 1 0 1 0 1 1\n", 6, 2, false},
        {"counted row.3d", "3 0 0 0 1 0 0 0 1 0\n", 3, 1, false},
        {"column.3d", "0\n0\n0\n1\n0\n0\n0\n1\n0\n", 3, 1, false},
        {"counted column.3d", "3\n0\n0\n0\n1\n0\n0\n0\n1\n0\n", 3, 1, false},
        {"8.3d", "0;0;0;1;0;0;0;1;0\n0;1;2\n0;0;1;0;0;1;0;0;1\n0;0;1;0;0;1\n", 3, 1, true},
        {"8 ends.3d", "0 0 0 1 0 0 0 1 0;\n0 1 2;\n0 0 1 0 0 1 0 0 1;\n0 0 1 0 0 1;\n", 3, 1, true},
        {"8 one line.3d", "0 0 0 1 0 0 0 1 0;0 1 2;0 0 1 0 0 1 0 0 1;0 0 1 0 0 1", 3, 1, true},
        {"8 groups.3d", "0,0,0;1,0,0;0,1,0\n0,1,2\n0,0,1;0,0,1;0,0,1\n0,0;1,0;0,1\n", 3, 1, true},
        {"9.3d", "3\n" + kPositions + kNormals, 3, 1, false},
        {"9 uvs.3d", "3\n" + kPositions + kNormals + kUvs, 3, 1, true},
        {"sections.3d", "3\n" + kPositions + "3\n" + kNormals + "3\n" + kUvs + "3\n0\n1\n2\n", 3, 1,
         true},
        {"sections triangles.3d", "3\n" + kPositions + "1\n0 1 2\n", 3, 1, false},
        {"sections corners.3d", "3\n" + kPositions + "3\n0 1 2\n", 3, 1, false},
        {"comment.3d", "# a triangle\n" + kPositions + "\n0 1 2 // its corners\n", 3, 1, false},
        {"a.tri", "3 1\n" + kPositions + "0 1 2\n", 3, 1, false},
        {"two lines.tri", "3\n1\n" + kPositions + "0 1 2\n", 3, 1, false},
        {"normals.tri", "3 1\n" + kPositions + "0 1 2\n" + kNormals, 3, 1, false},
        {"soup.tri", "0 0 0 1 0 0 0 1 0\n0 0 1 1 0 1 0 1 1\n", 6, 2, false},
        {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", 3, 1, false},
        {"fan.obj", "o x\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ns off\nf 1 2 3 4\n", 4, 2, false},
        {"negative.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n", 3, 1, false},
        {"split.obj",
         "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvt .5 .5\nvn 0 0 1\n"
         "f 1/1/1 2/2/1 3/3/1\nf 1/4/1 2/2/1 3/3/1\n",
         4, 2, true},
        {"no uv.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n", 3, 1, false},
        {"named otherwise.3d", "# x\n\nmtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 \\\n3\n", 3,
         1, false},
        {"a.ply", plyText(kPlyVertices + kPlyFaces, kPositions + "3 0 1 2\n"), 3, 1, false},
        {"normals uv.ply",
         plyText("comment x\nelement vertex 3\nproperty float x\nproperty float y\n"
                 "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
                 "property float s\nproperty float t\n" +
                     kPlyFaces,
                 soup8 + "3 0 1 2\n"),
         3, 1, true},
        {"quad.ply",
         plyText("element vertex 4\nproperty double x\nproperty double y\nproperty double z\n" +
                     kPlyFaces,
                 "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"),
         4, 2, false},
        {"little.ply", binaryPly(false, "\x03\x00\x00\x01\x00\x02\x00"s), 3, 1, false},
        {"big.ply", binaryPly(true, "\x03\x00\x00\x00\x01\x00\x02"s), 3, 1, false},
        {"a.stl", kStl, 3, 1, false},
        {"named otherwise.obj", kStl, 3, 1, false},
        {"binary.stl", binaryStl(), 3, 1, false},
        {"a.off", "OFF\n# a square\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n", 4, 2, false},
        {"colours.off", "OFF 3 1 3\n" + kPositions + "3 0 1 2 255 0 0\n", 3, 1, false},
        {"a.patch",
         "1\n0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15\n16\n0,0,0\n1,0,0\n2,0,0\n3,0,0\n0,1,0\n1,1,0\n"
         "2,1,0\n3,1,0\n0,2,0\n1,2,0\n2,2,0\n3,2,0\n0,3,0\n1,3,0\n2,3,0\n3,3,0\n",
         121, 200, true},
    };
}

std::vector<Bad> badFiles() {
    const std::string binary = encodeMesh(make("plane 1"), Format::binary);
    std::string flipped = binary, version = binary, longer = binary;
    flipped[40] = static_cast<char>(flipped[40] ^ 1);
    version[8] = 9;
    longer[16] = '\x7F';
    return {
        {"empty.3d", "mesh.empty", 1, ""},
        {"blank.3d", "mesh.empty", 1, "\n\n \n"},
        {"row.3d", "mesh.format", 1, "0 0 0 1 0 0 0 1 0 1 1\n"},
        {"column.3d", "mesh.format", 1, "0\n0\n0\n1\n0\n0\n0\n"},
        {"none.stl", "mesh.empty", 0, "solid x\nfacet\nendsolid\n"},
        {"facet.stl", "mesh.truncated", 3, "solid x\nfacet\nvertex 0 0 0\n"},
        {"word.stl", "mesh.syntax", 3, "solid x\nfacet\n vertex 0 x 0\n"},
        {"four.stl", "mesh.syntax", 3, "solid x\nfacet\n vertex 0 0 0 0\n"},
        {"short.off", "mesh.truncated", 2, "OFF\n3 1 0\n0 0 0\n"},
        {"index.off", "mesh.index", 6, "OFF\n3 1 0\n" + kPositions + "3 0 1 3\n"},
        {"corners.off", "mesh.syntax", 6, "OFF\n3 1 0\n" + kPositions + "4 0 1 2\n"},
        {"none.off", "mesh.empty", 2, "OFF\n3 0 0\n" + kPositions},
        {"word.3d", "mesh.syntax", 2, "0 0 0\n1 x 0\n0 1 0\n"},
        {"nul.3d", "mesh.syntax", 1, "0 0 \0 0\n"s},
        {"nan.3d", "mesh.number", 2, "0 0 0\n1 nan 0\n0 1 0\n"},
        {"inf.3d", "mesh.number", 3, "0 0 0\n1 0 0\n0 -inf 0\n"},
        {"huge.3d", "mesh.number", 3, "0 0 0\n1 0 0\n0 1e300 0\n"},
        {"index.3d", "mesh.index", 7, kPositions + "\n0\n1\n3\n"},
        {"negative.3d", "mesh.index", 7, kPositions + "\n0\n1\n-1\n"},
        {"fraction.3d", "mesh.index", 6, kPositions + "\n0\n1.5\n2\n"},
        {"cut.3d", "mesh.truncated", 6, kPositions + "\n0\n1\n"},
        {"few normals.3d", "mesh.truncated", 5, kPositions + "\n0 0 1\n0 0 1\n\n0\n1\n2\n"},
        {"few uvs.3d", "mesh.truncated", 5, kPositions + "\n0 0\n\n0\n1\n2\n"},
        {"ragged.3d", "mesh.syntax", 2, "0 0 0\n1 0\n0 1 0\n\n0 1 2\n"},
        {"two soups.3d", "mesh.truncated", 4, kPositions + "1 1 1\n"},
        {"width.3d", "mesh.format", 1, "0 0 0 0\n1 0 0 0\n0 1 0 0\n"},
        {"absurd.3d", "mesh.truncated", 1, "4000000000 3\n" + kPositions + "0 1 2\n"},
        {"absurd indices.3d", "mesh.truncated", 1, "3 4000000000\n" + kPositions + "0 1 2\n"},
        {"short 2.3d", "mesh.truncated", 8, "3 6\n" + kPositions + kNormals + "0 1 2\n"},
        {"index 3.3d", "mesh.index", 4,
         "3\n0\n1\n3\n0 0 0 0 0 1 0 0\n1 0 0 0 0 1 0 0\n0 1 0 0 0 1 0 0\n"},
        {"odd soup 7.3d", "mesh.truncated", 1, "4\n0,0,0\n1,0,0\n0,1,0\n1,1,1\n"},
        {"list.3d", "mesh.truncated", 1, "0;0;0;1;0;0;0;1\n0;1;2\n"},
        {"list word.3d", "mesh.syntax", 2, "0;0;0;1;0;0;0;1;0\n0;x;2\n"},
        {"list index.3d", "mesh.index", 2, "0;0;0;1;0;0;0;1;0\n0;1;7\n"},
        {"sections.3d", "mesh.index", 6, "3\n" + kPositions + "1\n0 1 3\n"},
        {"long section.3d", "mesh.truncated", 6,
         "3\n" + kPositions + "2\n0 0 1\n0 0 1\n1\n0 1 2\n"},
        {"index.tri", "mesh.index", 5, "3 1\n" + kPositions + "0 1 3\n"},
        {"zero.tri", "mesh.empty", 1, "0 0\n" + kPositions},
        {"no faces.obj", "mesh.empty", 3, "v 0 0 0\nv 1 0 0\nv 0 1 0\n"},
        {"goes on.obj", "mesh.empty", 2, "o x\nv 0 0 0 \\\n"},
        {"index.obj", "mesh.index", 4, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"},
        {"zero.obj", "mesh.index", 4, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 3\n"},
        {"negative.obj", "mesh.index", 4, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -4 1 2\n"},
        {"two corners.obj", "mesh.syntax", 3, "v 0 0 0\nv 1 0 0\nf 1 2\n"},
        {"short vertex.obj", "mesh.truncated", 1, "v 0 0\n"},
        {"word.obj", "mesh.syntax", 1, "v 0 zero 0\n"},
        {"four parts.obj", "mesh.syntax", 4, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1///1 2 3\n"},
        {"no end.ply", "mesh.truncated", 3, "ply\nformat ascii 1.0\n"},
        {"no format.ply", "mesh.empty", 3, "ply\nend_header\n"},
        {"type.ply", "mesh.syntax", 4, plyText("element vertex 1\nproperty quad x\n", "")},
        {"count.ply", "mesh.count", 9,
         plyText("element vertex 4000000000\nproperty float x\nproperty float y\n"
                 "property float z\n" +
                     kPlyFaces,
                 kPositions + "3 0 1 2\n")},
        {"index.ply", "mesh.index", 13,
         plyText(kPlyVertices + kPlyFaces, kPositions + "3 0 1 3\n")},
        {"cut.ply", "mesh.truncated", 13, plyText(kPlyVertices + kPlyFaces, kPositions + "3 0 1")},
        {"pair.ply", "mesh.syntax", 13,
         plyText(kPlyVertices + kPlyFaces, kPositions + "2 0 1 1\n")},
        {"list length.ply", "mesh.count", 13,
         plyText(kPlyVertices + kPlyFaces, kPositions + "-3 0 1 2\n")},
        {"profile.ply", "mesh.empty", 10, plyText(kPlyVertices, kPositions)},
        {"flat.ply", "mesh.format", 3,
         plyText("element vertex 1\nproperty float x\nproperty float y\n", "0 0\n")},
        {"cut binary.ply", "mesh.truncated", 0, binaryPly(false, "\x03\x00\x00\x01"s)},
        {"index binary.ply", "mesh.index", 0, binaryPly(true, "\x03\x00\x00\x00\x01\x00\x09"s)},
        {"cut.3db", "mesh.truncated", 0, binary.substr(0, binary.size() - 5)},
        {"head.3db", "mesh.truncated", 0, binary.substr(0, 12)},
        {"flipped.3db", "mesh.checksum", 0, flipped},
        {"version.3db", "mesh.format", 0, version},
        {"longer.3db", "mesh.truncated", 0, longer},
        {"count.patch", "mesh.truncated", 1, "1000000\n0,1,2\n"},
        {"row.patch", "mesh.truncated", 1, "1\n0,1,2\n1\n0,0,0\n"},
        {"points.patch", "mesh.syntax", 5, "1\n0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0\n1\n0,0,0\n0,0,0\n"},
        {"words.3d", "mesh.format", 0, "to be done\n"},
        {"image.3d", "mesh.format", 0, "\x89PNG\r\n\x1a\n"},
        {"index.patch", "mesh.index", 2, "1\n0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,1\n1\n0,0,0\n"},
        {"short.patch", "mesh.truncated", 3, "1\n0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0\n2\n0,0,0\n"},
        {"none.patch", "mesh.count", 1, "0\n"},
    };
}

}  // namespace

TEST_CASE("every form of mesh file is known by its content") {
    for (const Good& row : goodFiles()) {
        CAPTURE(row.name);
        Diagnostics findings;
        const Mesh mesh = decodeMesh(row.bytes, row.name, findings);
        CHECK(findings.empty());
        CHECK(mesh.positions().size() == row.vertices);
        CHECK(mesh.triangles() == row.triangles);
        CHECK(mesh.normals().size() == row.vertices);
        CHECK(mesh.uvs().size() == (row.uvs ? row.vertices : 0));
        for (const glm::vec3& n : mesh.normals()) CHECK(std::abs(glm::length(n) - 1) < 1e-6F);
        const auto [a, b, c] = corners(mesh, 0);
        CHECK(glm::length(glm::cross(b - a, c - a)) > 0);
    }
}

TEST_CASE("damaged mesh files are refused with code and line") {
    for (const Bad& row : badFiles()) {
        CAPTURE(row.name);
        Diagnostics findings;
        try {
            decodeMesh(row.bytes, row.name, findings);
            FAIL_CHECK("it was accepted");
        } catch (const farol::Error& error) {
            CAPTURE(error.what());
            CHECK(error.code() == row.code);
            CHECK(error.primary().where.line == row.line);
            CHECK(error.primary().where.file == row.name);
        }
    }
}

TEST_CASE("every prefix of a mesh file is read or refused, never more") {
    for (const Good& row : goodFiles()) {
        CAPTURE(row.name);
        for (std::size_t length = 0; length < row.bytes.size(); ++length) {
            Diagnostics findings;
            try {
                const Mesh mesh = decodeMesh(row.bytes.substr(0, length), row.name, findings);
                for (const std::uint32_t index : mesh.indices())
                    REQUIRE(index < mesh.positions().size());
            } catch (const farol::Error& error) {
                REQUIRE(error.code().rfind("mesh.", 0) == 0);
            }
        }
    }
}

TEST_CASE("what is written is read back equal") {
    for (const char* text : {"plane 2 3", "box 0.1 0.7 1e-5 2", "sphere 1.1 13 7",
                             "cone 1e6 0.3 5 2", "cylinder 1 2 9 2", "torus 2 0.3 7 5",
                             "patch teapot.patch 4", "ring 0.3 1 9", "frustum 2 1 3 8 2"}) {
        const Mesh mesh = make(text);
        for (const Format format : {Format::text3d, Format::obj, Format::ply, Format::binary}) {
            CAPTURE(text, static_cast<int>(format));
            Diagnostics findings;
            CHECK(decodeMesh(encodeMesh(mesh, format), "x", findings) == mesh);
            CHECK(findings.empty());
        }
        farol::generator::MeshArrays arrays = mesh.arrays();  // without texture coordinates
        arrays.uvs.clear();
        const Mesh bare(std::move(arrays));
        for (const Format format : {Format::text3d, Format::obj, Format::ply, Format::binary}) {
            Diagnostics findings;
            CHECK(decodeMesh(encodeMesh(bare, format), "x", findings) == bare);
        }
    }
}

// Short lists are where one text form resembles another.
TEST_CASE("a mesh of few vertices is read back, whatever arrays it has") {
    for (std::uint32_t vertices = 1; vertices <= 9; ++vertices)
        for (std::uint32_t triangles = 1; triangles <= 9; ++triangles)
            for (const unsigned arrays : {0U, 1U, 2U, 3U}) {
                farol::generator::MeshArrays made;
                for (std::uint32_t i = 0; i < vertices; ++i) {
                    made.positions.emplace_back(i % 3, i % 2, i / 3);
                    if ((arrays & 1U) != 0) made.normals.emplace_back(0, 1, 0);
                    if ((arrays & 2U) != 0) made.uvs.emplace_back(i % 2, 0);
                }
                for (std::uint32_t i = 0; i < 3 * triangles; ++i)
                    made.indices.push_back(i * i % vertices);
                const Mesh mesh(made);
                for (const Format format :
                     {Format::text3d, Format::obj, Format::ply, Format::binary}) {
                    CAPTURE(vertices, triangles, arrays, static_cast<int>(format));
                    Diagnostics findings;
                    farol::generator::MeshArrays again =
                        decodeMesh(encodeMesh(mesh, format), "x", findings).arrays();
                    if (made.normals.empty()) again.normals.clear();  // computed when read
                    CHECK(again == made);
                }
            }
}

TEST_CASE("PLY files of other programs: every type, both byte orders, more than is needed") {
    const auto seed = [](const std::string& name) {
        std::ifstream in(std::string(farol::test::kSourceDir) + "/tests/fuzz/seeds/mesh/" + name,
                         std::ios::binary);
        Diagnostics findings;
        const std::string bytes{std::istreambuf_iterator<char>(in), {}};
        return decodeMesh(bytes, name, findings);
    };
    const Mesh low = seed("extra_little.ply"), high = seed("extra_big.ply");
    CHECK(low == high);
    CHECK(low.positions().size() == 5);
    CHECK(low.triangles() == 4);  // a pentagon and a triangle
    CHECK(low.normals()[2] == glm::vec3(0, 0, 1));
    CHECK(low.uvs()[1] == glm::vec2(1, 0));
    const Mesh integers = seed("integers.ply");
    CHECK(integers.positions()[0] == glm::vec3(-1, 0, 0));
    CHECK(integers.positions()[3] == glm::vec3(-1, 2, 1));
    CHECK(integers.triangles() == 2);
    CHECK(seed("extra_ascii.ply").triangles() == 2);
    CHECK(seed("crlf.ply").triangles() == 1);
    CHECK(seed("strips.ply").triangles() == 1);
}

TEST_CASE("a profile is a PLY file's vertices or rows of numbers") {
    using farol::generator::io::decodeProfile;
    const std::vector<glm::dvec3> points = {{1, 0, 0}, {0.5, 2, 0}};
    CHECK(decodeProfile("1 0\n0.5 2\n", "p.txt") == points);
    CHECK(decodeProfile("1,0,9\n.5,2,9\n", "p.txt") == points);  // z is no part of it
    CHECK_THROWS_AS(decodeProfile("1 0\n1 2 3 4\n", "p.txt"), farol::Error);
    CHECK_THROWS_AS(decodeProfile("1 0\n1\n", "p.txt"), farol::Error);
}

TEST_CASE("a number too small for a double is zero, one too large is refused") {
    Diagnostics findings;
    const std::string rest = "\n1 0 0\n0 1 0\n";
    const Mesh mesh = decodeMesh("1e-400 -2E-999 0.5" + rest, "a.3d", findings);
    CHECK(mesh.positions()[0] == glm::vec3(0, 0, 0.5));
    for (const char* text : {"1e400 0 0", "0 -1E999 0", "0 0 2e18"})
        CHECK_THROWS_AS(decodeMesh(text + rest, "a.3d", findings), farol::Error);
}

TEST_CASE("mesh files are known by their names' endings") {
    using farol::generator::isMeshName;
    for (const char* name : {"a.3d", "b/c.OBJ", "x.y.ply", "a.tri", "a.3DB", "a.stl"})
        CHECK(isMeshName(name));
    for (const char* name : {"a.xml", "3d", "", "obj", "a.obj.png"}) CHECK_FALSE(isMeshName(name));
}

TEST_CASE("formats go by the name's ending") {
    using farol::generator::io::formatOf;
    CHECK(formatOf("a.3d") == Format::text3d);
    CHECK(formatOf("a/b.c.OBJ") == Format::obj);
    CHECK(formatOf("a.Ply") == Format::ply);
    CHECK(formatOf("a.3db") == Format::binary);
    CHECK_FALSE(formatOf("a.stl"));
    CHECK_FALSE(formatOf("3d"));
}

TEST_CASE("a closed mesh that faces inwards is turned, with a warning") {
    for (const bool withNormals : {true, false}) {
        const Mesh right = make("sphere 1 8 8");
        farol::generator::MeshArrays wrong = right.arrays();
        for (std::size_t i = 0; i < wrong.indices.size(); i += 3)
            std::swap(wrong.indices[i + 1], wrong.indices[i + 2]);
        if (!withNormals) wrong.normals.clear();
        Diagnostics findings;
        const Mesh mended = decodeMesh(encodeMesh(Mesh(wrong), Format::text3d), "s.3d", findings);
        CHECK(volume(mended) == Approx(volume(right)));
        REQUIRE(findings.size() == 1);
        CHECK(findings[0].code == "mesh.inward");
        CHECK(findings[0].severity == farol::Severity::warning);
        for (std::size_t i = 0; i < mended.positions().size(); ++i)
            CHECK(glm::dot(mended.normals()[i], mended.positions()[i]) > 0.9F);
        // Normals that agree with the inward faces are turned with them.
        for (glm::vec3& n : wrong.normals) n = -n;
        Diagnostics again;
        const Mesh both = decodeMesh(encodeMesh(Mesh(wrong), Format::obj), "s.obj", again);
        for (std::size_t i = 0; i < both.positions().size(); ++i)
            CHECK(glm::dot(both.normals()[i], both.positions()[i]) > 0.9F);
    }
    Diagnostics findings;  // open: left as it is
    const Mesh open = decodeMesh("0 0 0\n0 1 0\n1 0 0\n", "open.3d", findings);
    CHECK(open.normals()[0] == glm::vec3(0, 0, -1));
    CHECK(findings.empty());
}

TEST_CASE("normals that are no directions are the faces' own, with a warning") {
    Diagnostics findings;
    const Mesh mesh = decodeMesh(kPositions + "\n0 0 0\n0 0 5\n0 0 1\n\n0 1 2\n", "n.3d", findings);
    for (const glm::vec3& n : mesh.normals()) CHECK(n == glm::vec3(0, 0, 1));
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].code == "mesh.normal");
}

TEST_CASE("a mesh of lines and points gets a warning that nothing can be seen") {
    for (const auto& [bytes, flat] :
         {std::pair("0 0 0\n1 0 0\n2 0 0\n", true),
          std::pair("0 0 0\n1 0 0\n2 0 0\n0 0 0\n1 0 0\n0 1 0\n", false)}) {
        Diagnostics findings;
        decodeMesh(bytes, "f.3d", findings);
        CHECK(findings.size() == (flat ? 1 : 0));
        if (flat) CHECK(findings[0].code == "mesh.flat");
    }
}

TEST_CASE("computed normals are the mean of unit face normals; faces without area do not count") {
    // A roof of two faces of different size, and a degenerate triangle at its ridge.
    Diagnostics findings;
    const Mesh mesh =
        decodeMesh("0 1 0\n0 1 1\n-1 0 0\n5 -4 0\n\n0 2 1\n0 1 3\n0 0 1\n", "roof.3d", findings);
    CHECK(glm::distance(mesh.normals()[0], glm::vec3(0, 1, 0)) < 1e-6F);
    CHECK(glm::distance(mesh.normals()[2], glm::normalize(glm::vec3(-1, 1, 0))) < 1e-6F);
    CHECK(glm::distance(mesh.normals()[3], glm::normalize(glm::vec3(1, 1, 0))) < 1e-6F);
}
