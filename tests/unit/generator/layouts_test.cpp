// Mesh files that no form of the table reads as they stand: lists in other orders, counted in other
// units, and other spellings of the known formats. All are the same two triangles.
#include <array>
#include <catch2/catch.hpp>
#include <cstring>
#include <string>

#include "generator/io/mesh_file.h"
#include "tests/unit/generator/checks.h"

using namespace farol::generator;
using namespace farol::generator::io;
using checks::corners;
using farol::Diagnostics;
using std::string_literals::operator""s;

namespace {

const std::string kFour = "-1 0 -1\n-1 0 1\n1 0 1\n1 0 -1\n";
const std::string kSix = "-1 0 -1\n-1 0 1\n1 0 1\n-1 0 -1\n1 0 1\n1 0 -1\n";
const std::string kUp = "0 1 0\n0 1 0\n0 1 0\n0 1 0\n0 1 0\n0 1 0\n";
const std::string kUvs = "0 0\n0 1\n1 1\n0 0\n1 1\n1 0\n";

std::string times(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}

/// Each line of `text` after `before`.
std::string each(const std::string& before, const std::string& text,
                 const std::string& after = "\n") {
    const std::string lines = before + times(text, "\n", after + before);
    return lines.substr(0, lines.size() - before.size());
}

template <class Number>
std::string bytesOf(const std::vector<Number>& numbers) {
    std::string bytes(numbers.size() * sizeof(Number), '\0');
    std::memcpy(bytes.data(), numbers.data(), bytes.size());
    return bytes;
}

std::string whole(std::vector<std::uint32_t> numbers) { return bytesOf(numbers); }

const std::vector<float> kFloats4{-1, 0, -1, -1, 0, 1, 1, 0, 1, 1, 0, -1};
const std::vector<float> kFloats6{-1, 0, -1, -1, 0, 1, 1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0, -1};
const std::vector<float> kFloatsUp{0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0};
const std::vector<float> kFloatsUv{0, 0, 0, 1, 1, 1, 0, 0, 1, 1, 1, 0};

std::string bigEndian(const std::string& bytes) {
    std::string out = bytes;
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = bytes[i / 4 * 4 + 3 - i % 4];
    return out;
}

struct Layout {
    const char* file;
    std::string bytes;
    bool uvs = false;
    const char* finding = "";
};

std::vector<Layout> textLayouts() {
    const std::string wide = "-1 0 -1 0 1 0 -1 0 1 0 1 0 1 0 1 0 1 0\n";
    return {
        {"counts first.3d", "4\n6\n" + kFour + "0\n1\n2\n0\n2\n3\n"},
        {"indices first.3d", "6\n0 1 2 0 2 3\n4\n" + kFour},
        {"indices first, commas.3d", "6\n0,1,2,0,2,3\n4\n" + times(kFour, " ", ",")},
        {"one count.3d", "4\n" + kFour + "0\n1\n2\n0\n2\n3\n"},
        {"indices in a line.3d", "4\n" + kFour + "6\n0 1 2 0 2 3\n"},
        {"numbers counted.3d", "12\n" + times(kFour, "\n", " ") + "\n6\n0 1 2 0 2 3\n"},
        {"column of lists.3d",
         "18\n" + times(kSix, " ", "\n") + "18\n" + times(kUp, " ", "\n") + "12\n" +
             times(kUvs, " ", "\n"),
         true},
        {"three counts.3d", "4 4 6\n" + kFour + kUp.substr(0, 24) + "0 1 2\n0 2 3\n"},
        {"one normal.3d", "4 1 4 2\n" + kFour + "0 1 0\n0 0\n0 1\n1 1\n1 0\n0 1 2\n0 2 3\n", true},
        {"count of each list.3d", "6\n6\n6\n" + kSix + kUp + kUvs, true},
        {"quads.3d", "4\n" + kFour + "1\n0 1 2 3\n"},
        {"from 1.3d", "4\n" + kFour + "6\n1 2 3 1 3 4\n"},
        {"rules.3d", kSix + "---\n" + kUp + "---\n" + kUvs, true},
        {"comments.3d", "#vertices\n" + kSix + "#normals\n" + kUp + "#textures\n" + kUvs, true},
        {"places and coordinates.3d",
         "-1 0 -1 0 0 -1 0 1 0 1 1 0 1 1 1\n-1 0 -1 0 0 1 0 1 1 1 1 0 -1 1 0\n", true},
        {"places and normals.3d", wide + "-1 0 -1 0 1 0 1 0 1 0 1 0 1 0 -1 0 1 0\n"},
        {"weights.3d", each("", kSix, " 1\n")},
        {"angles.3d", each("<", times(kSix, " ", ", "), ">\n")},
        {"numbered words.3d",
         "v1: (-1, 0, -1)\nv2: (-1, 0, 1)\nv3: (1, 0, 1)\nv4: (-1, 0, -1)\nv5: (1, 0, 1)\n"
         "v6: (1, 0, -1)\n"},
        {"titles.3d",
         "Triangle 1:\n" + kSix.substr(0, kSix.size() / 2) + "Triangle 2:\n" +
             kSix.substr(kSix.size() / 2),
         false, "mesh.left-out"},
        {"soup of words.3d", each("v ", kSix)},
        {"soup of three words.3d", each("v ", kSix) + each("vn ", kUp) + each("vt ", kUvs), true},
        {"without quotes.3d",
         "<plane><triangle><vertex X=-1 Y=0 Z=-1 /><vertex X=-1 Y=0 Z=1 /><vertex X=1 Y=0 Z=1 />"
         "</triangle><triangle><vertex X=-1 Y=0 Z=-1/><vertex X=1 Y=0 Z=1/><vertex X=1 Y=0 Z=-1/>"
         "</triangle></plane>"},
    };
}

std::vector<Layout> binaryLayouts() {
    const std::string places = bytesOf(kFloats6), normals = bytesOf(kFloatsUp),
                      uvs = bytesOf(kFloatsUv);
    std::vector<float> mixed;
    for (std::size_t i = 0; i < 6; ++i) {
        mixed.insert(mixed.end(), &kFloats6[3 * i], &kFloats6[3 * i] + 3);
        mixed.insert(mixed.end(), {0, 1, 0, kFloatsUv[2 * i], kFloatsUv[2 * i + 1]});
    }
    return {
        {"lists.3d", whole({18}) + places + whole({18}) + normals + whole({12}) + uvs, true},
        {"one count.3d", whole({6}) + places + normals + uvs, true},
        {"indices.3d", whole({4}) + bytesOf(kFloats4) + whole({6, 0, 1, 2, 0, 2, 3})},
        {"indices first.3d", whole({6, 0, 1, 2, 0, 2, 3, 4}) + bytesOf(kFloats4)},
        {"vertices.3d", whole({6}) + bytesOf(mixed), true},
        {"long count.3d", whole({6, 0}) + places},
    };
}

std::vector<Layout> formats() {
    const std::string vertices = each("v ", kFour);
    const std::string head =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
        "float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n";
    const std::string faces = "3 0 1 2\n3 0 2 3\n";
    std::string facets = "solid s facet normal 0 1 0 outer loop ";
    facets += times(each("vertex ", kSix), "\n", " ") + "endloop endfacet endsolid";
    return {
        {"before.obj", "f 1 2 3\nf 1 3 4\n" + vertices},
        {"capitals.obj", each("V ", kFour) + "F 1 2 3 4\n"},
        {"semicolons.obj", each("v ", kFour, ";\n") + "f 1 2 3 4;\n"},
        {"comment.obj", "<!-- a plane -->\n" + vertices + "f 1 2 3 4\n", false, "mesh.left-out"},
        {"from 0.obj", vertices + "f 0 1 2\nf 0 2 3\n", false, "mesh.assumed"},
        {"slashes.3d", vertices + "vn 0 1 0\nf 0//0 1//0 2//0 3//0\n", false, "mesh.assumed"},
        {"short normal.obj", vertices + "vn 0 1\nf 1//1 2//1 3//1 4//1\n", false, "mesh.normal"},
        {"capitals.ply", "PLY" + head.substr(3) + kFour + faces},
        {"blanks.ply", times(head, "\n", " \n") + kFour + faces},
        {"no format.ply", times(head, "format ascii 1.0\n", "") + kFour + faces},
        {"one line.stl", facets},
        {"counts.off", "OFF\n4\n2\n0\n" + kFour + faces},
        {"binary.off", "OFF BINARY\n" + bigEndian(whole({4, 2, 0}) + bytesOf(kFloats4) +
                                                  whole({3, 0, 1, 2, 0, 3, 0, 2, 3, 0}))},
    };
}

void check(const std::vector<Layout>& rows) {
    for (const Layout& row : rows) {
        CAPTURE(row.file);
        Diagnostics findings;
        const Mesh mesh = decodeMesh(row.bytes, row.file, findings);
        CHECK(findings.size() == (*row.finding != 0 ? 1 : 0));
        for (const farol::Diagnostic& one : findings) CHECK(one.code == row.finding);
        REQUIRE(mesh.triangles() == 2);
        CHECK(mesh.uvs().size() == (row.uvs ? mesh.positions().size() : 0));
        double area = 0;
        for (std::size_t t = 0; t < 2; ++t) {
            const auto [a, b, c] = corners(mesh, t);
            area += glm::cross(b - a, c - a).y / 2;  // both face upwards
        }
        CHECK(area == Approx(4));
        for (const glm::vec3& normal : mesh.normals()) CHECK(normal == glm::vec3(0, 1, 0));
        // Whatever is cut off is read or refused.
        for (std::size_t length = 0; length < row.bytes.size(); ++length) try {
                decodeMesh(row.bytes.substr(0, length), row.file, findings);
            } catch (const farol::Error& error) {
                CHECK(error.code().starts_with("mesh."));
            }
    }
}

}  // namespace

TEST_CASE("lists of text are read in any order and unit") { check(textLayouts()); }
TEST_CASE("lists of binary numbers are read in any order and unit") { check(binaryLayouts()); }
TEST_CASE("known formats are read in other spellings") { check(formats()); }

TEST_CASE("a patch file is read whatever its lines") {
    std::string points, indices = "0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15";
    for (int i = 0; i < 16; ++i)
        points += std::to_string(i / 4) + " 0 " + std::to_string(i % 4) + "\n";
    Diagnostics findings;
    const Mesh known = decodeMesh("1\n" + indices + "\n16\n" + points, "a.patch", findings);
    REQUIRE(known.triangles() > 2);
    for (const auto& [file, bytes] : std::vector<std::pair<std::string, std::string>>{
             {"rows.3d", "1\n" + indices + "\n16\n" + points},
             {"column.patch", "1\n" + times(indices, " ", "\n") + "\n16\n" + points},
             {"four rows.patch",
              "1\n" +
                  times(times(times(indices, "3 4", "3\n4"), "7 8", "7\n8"), "11 12", "11\n12") +
                  "\n16\n" + points},
             {"from 1.patch", "1\n1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16\n16\n" + points},
             {"no count.patch", "1\n" + indices + "\n" + points},
             {"points.patch", points}}) {
        CAPTURE(file);
        CHECK(decodeMesh(bytes, file, findings).positions() == known.positions());
    }
}

TEST_CASE("patches without any surface are refused") {
    Diagnostics findings;
    const std::string point = "1 1 1\n";
    std::string points;
    for (int i = 0; i < 16; ++i) points += point;
    CHECK_THROWS_WITH(decodeMesh(points, "a.patch", findings), Catch::Contains("no triangles"));
}

TEST_CASE("a mesh file that says nothing names what it looks like") {
    const auto messageOf = [](const std::string& bytes) {
        Diagnostics findings;
        try {
            decodeMesh(bytes, "a.3d", findings);
        } catch (const farol::Error& error) {
            CHECK(error.code() == "mesh.format");
            return std::string(error.what());
        }
        return ""s;
    };
    CHECK_THAT(messageOf("the mesh of the comet\nwill follow\n"),
               Catch::Contains("begins with \"the mesh of the comet"));
    CHECK_THAT(messageOf("<html><body>404</body></html>"), Catch::Contains("a web page"));
    CHECK_THAT(messageOf("version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 12\n"),
               Catch::Contains("Git LFS"));
    CHECK_THAT(messageOf("PK\3\4"), Catch::Contains("a zip archive"));
}

TEST_CASE("a PLY file that is cut off has the faces before that") {
    Diagnostics findings;
    const Mesh mesh = decodeMesh(
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
        "float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n" +
            kFour + "3 0 1 2\n",
        "a.ply", findings);
    CHECK(mesh.triangles() == 1);
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].code == "mesh.count-wrong");
}
