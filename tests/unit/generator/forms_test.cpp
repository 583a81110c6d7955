// The table of mesh forms: each is recognised by its content, and drawn as what it means. All rows
// are one square of two triangles in y = 0, which faces up.
#include <catch2/catch.hpp>
#include <cstring>
#include <set>

#include "generator/io/mesh_file.h"
#include "generator/io/sniff.h"
#include "tests/unit/generator/checks.h"

using namespace checks;
using namespace std::string_literals;
using farol::Diagnostics;
using farol::generator::io::decodeMesh;
using farol::generator::io::formOf;

namespace {

struct FormRow {
    const char *file, *form;
    std::string bytes;
    bool uvs = false;
    const char* finding = "";  ///< the code of the only one
};

const std::string kSoup = "-1 0 -1\n-1 0 1\n1 0 1\n-1 0 -1\n1 0 1\n1 0 -1\n";
const std::string kCorners = "-1 0 -1\n-1 0 1\n1 0 1\n1 0 -1\n";
const std::string kTriangles = "0 1 2\n0 2 3\n";

/// The six vertices of the soup, each put into `row`: P is its place, U its coordinates.
std::string eachVertex(const std::string& row, const std::string& between = " ") {
    const char* places[][3] = {{"-1", "0", "-1"}, {"-1", "0", "1"}, {"1", "0", "1"},
                               {"-1", "0", "-1"}, {"1", "0", "1"},  {"1", "0", "-1"}};
    const char* uvs[][2] = {{"0", "0"}, {"0", "1"}, {"1", "1"}, {"0", "0"}, {"1", "1"}, {"1", "0"}};
    std::string out;
    for (int i = 0; i < 6; ++i)
        for (const char c : row) {
            if (c == 'P')
                out += places[i][0] + between + places[i][1] + between + places[i][2];
            else if (c == 'U')
                out += uvs[i][0] + between + uvs[i][1];
            else if (c == 'X' || c == 'Y' || c == 'Z')
                out += places[i][c - 'X'];
            else
                out += c;
        }
    return out;
}

template <class Number>
std::string rawOf(std::initializer_list<Number> values) {
    std::string out;
    for (const Number value : values) {
        char bytes[sizeof(Number)];
        std::memcpy(bytes, &value, sizeof(Number));
        out.append(bytes, sizeof(Number));
    }
    return out;
}

std::string wide(const std::string& text, bool bigEndian) {
    std::string out = bigEndian ? "\xFE\xFF" : "\xFF\xFE";
    for (const char c : text) out += bigEndian ? "\0"s + c : c + "\0"s;
    return out;
}

std::string replaced(std::string text, char from, char to) {
    for (char& c : text)
        if (c == from) c = to;
    return text;
}

std::vector<FormRow> formRows() {
    const auto floats = {-1.F, 0.F, -1.F, -1.F, 0.F, 1.F, 1.F, 0.F, 1.F,
                         -1.F, 0.F, -1.F, 1.F,  0.F, 1.F, 1.F, 0.F, -1.F};
    const auto doubles = {-1., 0., -1., -1., 0., 1., 1., 0., 1.,
                          -1., 0., -1., 1.,  0., 1., 1., 0., -1.};
    const auto corners = {-1.F, 0.F, -1.F, -1.F, 0.F, 1.F, 1.F, 0.F, 1.F, 1.F, 0.F, -1.F};
    const std::string objCorners = "v -1 0 -1\nv -1 0 1\nv 1 0 1\nv 1 0 -1\n";
    const std::string plyHead =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nelement face 2\n";
    const std::string list = "property list uchar int vertex_indices\n";
    return {
        {"a.ply", "PLY", plyHead + list + "end_header\n" + kCorners + "3 0 1 2\n3 0 2 3\n"},
        {"cr.ply", "PLY",
         replaced(plyHead + list + "end_header\n" + kCorners + "3 0 1 2\n3 0 2 3\n", '\n', '\r')},
        {"bare.ply", "PLY", plyHead + "end_header\n" + kCorners + "3 0 1 2\n3 0 2 3\n", false,
         "mesh.assumed"},
        {"bad face.ply", "PLY",
         plyHead + list + "element edge 1\nproperty int a\nend_header\n" + kCorners +
             "4 0 1 2 3\n3 0 2 9\n7\n",
         false, "mesh.left-out"},
        {"strip.ply", "PLY",
         "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
         "property float z\nelement tristrips 1\nproperty list int int vertex_indices\n"
         "end_header\n" +
             kCorners + "4 0 1 3 2\n"},
        {"capitals.stl", "STL",
         "  SOLID A\nFACET NORMAL 0 1 0\nOUTER LOOP\n" + eachVertex("Vertex P\n") +
             "ENDLOOP\nENDFACET\nENDSOLID\n"},
        {"a.off", "OFF", "OFF\n4 2 0\n" + kCorners + "3 0 1 2\n3 0 2 3\n"},
        {"lower.3d", "OFF", "off 4 1\n" + kCorners + "4 0 1 2 3\n"},
        {"bare.off", "OFF", "4 1 0\n" + kCorners + "4 0 1 2 3\n"},
        {"normals.off", "OFF",
         "NOFF\n4 1 0\n-1 0 -1 0 1 0\n-1 0 1 0 1 0\n1 0 1 0 1 0\n1 0 -1 0 1 0\n4 0 1 2 3\n"},
        {"lost.off", "OFF", "OFF\n4 3 0\n" + kCorners + "4 0 1 2 3\n2 0 1\n3 0 1 8\n", false,
         "mesh.left-out"},
        {"a.xml.3d", "elements",
         "<?xml version=\"1.0\" ?>\n<Model>\n <Configuration VertexCount=\"6\" />\n" +
             eachVertex(" <Vertex x=\"X\" y=\"Y\" z=\"Z\" />\n") + "</Model>\n"},
        {"text.3d", "elements",
         "<mesh><!-- <v>9 9 9</v> -->" + eachVertex("<vertex>P</vertex>") + "</mesh>"},
        {"nested.3d", "elements", eachVertex("<v><x>X</x><y>Y</y><z>Z</z></v>")},
        {"full.3d", "elements",
         eachVertex("<point x='X' y='Y' z='Z' nx='0' ny='1' nz='0' uv='U'/>"), true},
        {"corners.3d", "elements",
         "<m><vertices>" + kCorners +
             "</vertices><triangle v1=\"0\" v2=\"1\" v3=\"2\"/><triangle>0 2 3</triangle></m>"},
        {"nine.3d", "elements",
         "<m><triangle>-1 0 -1 -1 0 1 1 0 1</triangle><triangle>-1 0 -1 1 0 1 1 0 "
         "-1</triangle></m>"},
        {"zero.3d", "OBJ from 0",
         "# Vertices\nv -1 0 -1 0 1 0 0 0\nv -1 0 1 0 1 0 0 1\nv 1 0 1 0 1 0 1 1\n"
         "v 1 0 -1 0 1 0 1 0\n\n# Faces\nf 0 1 2\nf 0 2 3\n",
         true},
        {"commas.3d", "OBJ from 0", eachVertex("v X, Y, Z\n")},
        {"counted.3d", "OBJ from 0", "v 4\n" + kCorners + "i 6\n0 1 2 0 2 3\n"},
        {"a.obj", "OBJ", objCorners + "f 1 2 3 4\n"},
        {"cr.obj", "OBJ", replaced(objCorners + "f 1 2 3 4\n", '\n', '\r')},
        {"mark.obj", "OBJ", "\xEF\xBB\xBF" + objCorners + "f 1 2 3 4\n"},
        {"commas.obj", "OBJ", "v -1,0 0,0 -1,0\nv -1,0 0 1\nv 1 0 1\nv 1 0 -1\nf 1 2 3 4\n"},
        {"short.obj", "OBJ", objCorners + "f 1 2 3 4\nf 1\nf 1 2\nl 1 2\np 1\n", false,
         "mesh.left-out"},
        {"index.obj", "OBJ", objCorners + "f 1 2 3 4\nf 1 2 9\nf 1 2 -9\n", false, "mesh.left-out"},
        {"nan.obj", "OBJ", objCorners + "vn 0 1 0\nvn nan nan nan\nf 1//1 2//1 3//2 4//1\n", false,
         "mesh.normal"},
        {"lists.3d", "lists", "-1;0;-1;-1;0;1;1;0;1;1;0;-1\n1;2;3;1;3;4\n"},  // from 1
        {"row.3d", "stream", replaced(kSoup, '\n', ' ')},
        {"numbered.3d", "numbered rows",
         "0 -1 0 -1\n1 -1 0 1\n2 1 0 1\n3 -1 0 -1\n4 1 0 1\n5 1 0 -1\n"},
        {"three.3d", "three counts", "4 2 0\n" + kCorners + kTriangles},
        {"no word.3d", "three counts", "4 1 4\n" + kCorners + "4 0 1 2 3\n"},
        {"two.3d", "two counts", "4 2\n" + kCorners + kTriangles},
        {"from 1.3d", "two counts", "4 2\n" + kCorners + "1 2 3\n1 3 4\n"},
        {"sections.3d", "sections", "4\n" + kCorners + "2\n" + kTriangles},
        {"triangles first.3d", "sections", "2\n" + kTriangles + "4\n" + kCorners},
        {"no indices.3d", "sections",
         "6\n" + eachVertex("P\n", ", ") + "6\n" + eachVertex("0, 1, 0\n") + "6\n" +
             eachVertex("U\n", ", "),
         true},
        {"one normal.3d", "sections", "4\n" + kCorners + "6\n0\n1\n2\n0\n2\n3\n0 1 0\n"},
        {"triangles.3d", "one count", "2\n" + eachVertex("P\n0 1 0\nU\n"), true},
        {"wrong.3d", "one count", "22\n" + eachVertex("P\n", ", "), false, "mesh.count-wrong"},
        {"absurd.3d", "one count", "1000000000000\n" + kSoup, false, "mesh.count-wrong"},
        {"nan.3d", "one count",
         "6\n-1 0 -1\n-nan(ind) -nan(ind) -nan(ind)\n0 0\n" +
             eachVertex("P\n0 1 0\nU\n").substr(18),
         true, "mesh.normal"},
        {"windows nan.3d", "one count",
         "6\n-1 0 -1\n-1.#IND 1.#QNAN -1.#IND00\n0 0\n" + eachVertex("P\n0 1 0\nU\n").substr(18),
         true, "mesh.normal"},
        {"blocks.3d", "blocks", kCorners + "\n" + kTriangles},
        {"from 1 blocks.3d", "blocks", kCorners + "\n1 2 3\n1 3 4\n"},
        {"soup.3d", "soup", kSoup},
        {"brackets.3d", "soup", eachVertex("(X, Y, Z)\n")},
        {"triangle rows.3d", "soup",
         "[(-1, 0, -1)(-1, 0, 1)(1, 0, 1)]\n[(-1, 0, -1)(1, 0, 1)(1, 0, -1)]\n"},
        {"24.3d", "soup",
         "-1 0 -1 0 1 0 0 0 -1 0 1 0 1 0 0 1 1 0 1 0 1 0 1 1\n"
         "-1 0 -1 0 1 0 0 0 1 0 1 0 1 0 1 1 1 0 -1 0 1 0 1 0\n",
         true},
        {"bars.3d", "soup", eachVertex("P | 0 1 0 | U\n"), true},
        {"decimal.3d", "soup", eachVertex("X,0 Y,0 Z,0\n")},
        {"decimal lists.3d", "soup", eachVertex("X,0;Y,0;Z,0\n")},
        {"little.3d", "soup", wide(kSoup, false)},
        {"big.3d", "soup", wide(kSoup, true)},
        {"cr.3d", "soup", replaced(kSoup, '\n', '\r')},
        {"floats.3d", "floats", rawOf<float>(floats)},
        {"counted floats.3d", "floats", rawOf<int>({6}) + rawOf<float>(floats)},
        {"indexed floats.3d", "floats",
         rawOf<int>({4, 6}) + rawOf<float>(corners) + rawOf<int>({0, 1, 2, 0, 2, 3})},
        {"doubles.3d", "floats", rawOf<double>(doubles)},
        {"letters.3d", "labelled", eachVertex("v: P\nn: 0 1 0\nt: U\n"), true},
        {"titles.3d", "labelled",
         "PLANE\nLength: 2\nVERTICES:\n[(-1, 0, -1)(-1, 0, 1)(1, 0, 1)]\n"
         "[(-1, 0, -1)(1, 0, 1)(1, 0, -1)]\n",
         false, "mesh.left-out"},
        {"counts.3d", "labelled", "Vertices: 4\n" + kCorners + "Triangles: 2\n1 2 3\n1 3 4\n"},
        {"portuguese.3d", "labelled", "pontos\n" + kCorners + "triangulos\n" + kTriangles},
        {"json.3d", "labelled",
         "{\"vertices\": [[-1.0, 0, -1], [-1, 0, 1], [1, 0, 1], [1, 0, -1]], \"indices\": "
         "[0, 1, 2, 0, 2, 3]}"},
        {"column.3d", "labelled",
         "\"indices\": [\n0,\n1,\n2,\n0,\n2,\n3\n],\n\"vertices\": [\n" +
             replaced(kCorners, ' ', '\n') + "]\n"},
        {"objects.3d", "labelled",
         "[" + eachVertex("{\"x\": X, \"y\": Y, \"z\": Z, \"u\": 0, \"v\": 1}, ") + "]", true},
        {"named.3d", "labelled", eachVertex("x=X, y=Y, z=Z\n")},
        {"numbered triangles.3d", "labelled",
         "Triangle 1: (-1,0,-1) (-1,0,1) (1,0,1)\nTriangle 2: (-1,0,-1) (1,0,1) (1,0,-1)\n"},
        // No form of the table: titles, or words before rows, are left out.
        {"name first.3d", "", "plane\n4\n" + kCorners + "6\n0\n1\n2\n0\n2\n3\n0 1 0\n", false,
         "mesh.left-out"},
        {"columns.3d", "", "x,y,z\n" + eachVertex("P\n", ","), false, "mesh.left-out"},
        {"end.3d", "", "% a plane\n-- of two\n" + kSoup + "END\n", false, "mesh.left-out"},
        {"calls.3d", "", eachVertex("glVertex3f(Xf, Yf, Zf);\n")},
    };
}

}  // namespace

TEST_CASE("each form of the table is recognised and read") {
    for (const FormRow& row : formRows()) {
        CAPTURE(row.file);
        CHECK(formOf(row.bytes, row.file) == row.form);
        Diagnostics findings;
        const Mesh mesh = decodeMesh(row.bytes, row.file, findings);
        CHECK(findings.size() == (*row.finding != 0 ? 1 : 0));
        for (const farol::Diagnostic& one : findings) CHECK(one.code == row.finding);
        REQUIRE(mesh.triangles() == 2);
        CHECK(mesh.uvs().size() == (row.uvs ? mesh.positions().size() : 0));
        for (const glm::vec3& normal : mesh.normals()) CHECK(normal == glm::vec3(0, 1, 0));
        double area = 0;
        glm::dvec3 low(9), high(-9);
        for (std::size_t t = 0; t < 2; ++t) {
            const auto [a, b, c] = corners(mesh, t);
            area += glm::length(glm::cross(b - a, c - a)) / 2;
            for (const glm::dvec3& p : {a, b, c}) {
                low = glm::min(low, p);
                high = glm::max(high, p);
            }
        }
        CHECK(area == Approx(4));
        CHECK(low == glm::dvec3(-1, 0, -1));
        CHECK(high == glm::dvec3(1, 0, 1));
    }
}

TEST_CASE("the table's forms are all tested here or with their own format") {
    std::set<std::string> tested{"binary", "patches",  // mesh_files_test.cpp, patch_test.cpp
                                 "patches in rows"};   // layouts_test.cpp
    for (const FormRow& row : formRows()) tested.insert(row.form);
    tested.erase("");
    std::set<std::string> all;
    for (const auto& form : farol::generator::io::meshForms()) all.insert(form.name);
    CHECK(tested == all);
}

TEST_CASE("every prefix of every form is read or refused") {
    for (const FormRow& row : formRows()) {
        CAPTURE(row.file);
        for (std::size_t length = 0; length < row.bytes.size(); ++length) {
            Diagnostics findings;
            try {
                const Mesh mesh = decodeMesh(row.bytes.substr(0, length), row.file, findings);
                REQUIRE(mesh.normals().size() == mesh.positions().size());
            } catch (const farol::Error& error) {
                REQUIRE(error.code().rfind("mesh.", 0) == 0);
            }
        }
    }
}
