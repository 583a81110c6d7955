// The one way to make a mesh: what it refuses, and that files and shapes go through it.
#include "generator/mesh.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <type_traits>

#include "generator/builder.h"
#include "generator/io/mesh_file.h"
#include "tests/unit/generator/checks.h"

using namespace checks;
using farol::Diagnostics;
using farol::Error;
using farol::generator::MeshArrays;

namespace {

MeshArrays triangle() {
    MeshArrays arrays;
    arrays.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    arrays.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    arrays.uvs = {{0, 0}, {1, 0}, {0, 1}};
    arrays.indices = {0, 1, 2};
    return arrays;
}

std::string codeOf(const MeshArrays& arrays) {
    try {
        Mesh(arrays, "a.3d");
    } catch (const Error& error) {
        CHECK(error.primary().where.file == "a.3d");
        return error.code();
    }
    return "";
}

template <class Change>
std::string codeWith(Change change) {
    MeshArrays arrays = triangle();
    change(arrays);
    return codeOf(arrays);
}

std::string refusalOf(const std::string& bytes, const std::string& name) {
    Diagnostics findings;
    try {
        farol::generator::io::decodeMesh(bytes, name, findings);
    } catch (const Error& error) {
        return error.code() + " line " + std::to_string(error.primary().where.line);
    }
    return "read";
}

}  // namespace

// Nobody fills a mesh from outside.
static_assert(!std::is_aggregate_v<Mesh>);
static_assert(
    std::is_same_v<decltype(std::declval<Mesh&>().positions()), const std::vector<glm::vec3>&>);

TEST_CASE("a mesh is made of arrays that go together, and of nothing else") {
    CHECK(codeOf(triangle()).empty());
    CHECK(codeOf(MeshArrays()).empty());
    CHECK(codeWith([](MeshArrays& a) { a.normals.clear(); }).empty());
    CHECK(codeWith([](MeshArrays& a) { a.uvs.clear(); }).empty());

    CHECK(codeWith([](MeshArrays& a) { a.normals.pop_back(); }) == "mesh.count");
    CHECK(codeWith([](MeshArrays& a) { a.normals.emplace_back(0, 0, 1); }) == "mesh.count");
    CHECK(codeWith([](MeshArrays& a) { a.uvs.pop_back(); }) == "mesh.count");
    CHECK(codeWith([](MeshArrays& a) { a.indices.push_back(0); }) == "mesh.truncated");
    CHECK(codeWith([](MeshArrays& a) { a.indices[1] = 3; }) == "mesh.index");
    CHECK(codeWith([](MeshArrays& a) { a.indices[2] = ~0U; }) == "mesh.index");
    CHECK(codeWith([](MeshArrays& a) { a.positions.clear(); }) == "mesh.count");
    const float inf = std::numeric_limits<float>::infinity();
    for (const float bad : {inf, -inf, std::nanf(""), 2e18F}) {
        CHECK(codeWith([=](MeshArrays& a) { a.positions[1].z = bad; }) == "mesh.number");
        CHECK(codeWith([=](MeshArrays& a) { a.normals[2].x = bad; }) == "mesh.number");
        CHECK(codeWith([=](MeshArrays& a) { a.uvs[0].y = bad; }) == "mesh.number");
    }
}

TEST_CASE("vertices and triangles are counted before memory is allocated for them") {
    using namespace farol::generator;
    CHECK_NOTHROW(checkCounts(kMaxVertices, kMaxTriangles));
    CHECK_THROWS_AS(checkCounts(kMaxVertices + 1, 0), Error);
    CHECK_THROWS_AS(checkCounts(0, kMaxTriangles + 1), Error);
    CHECK_THROWS_AS(Builder(kMaxVertices + 1, 1), Error);
    CHECK_THROWS_AS(Builder(1, kMaxTriangles + 1), Error);
}

TEST_CASE("a PLY file with two blocks of vertices is refused at the second") {
    const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
    const std::string normal = "property float nx\nproperty float ny\nproperty float nz\n";
    const std::string face = "element face 1\nproperty list uchar int vertex_indices\n";
    for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        const auto ply = [&format](const std::string& head) {
            return "ply\nformat " + format + " 1.0\n" + head + "end_header\n" +
                   std::string(200, format == "ascii" ? ' ' : '\0');
        };
        INFO(format);
        CHECK(
            refusalOf(ply("element vertex 4\n" + xyz + "element vertex 3\n" + xyz + normal + face),
                      "a.ply") == "mesh.syntax line 7");
        CHECK(refusalOf(ply("element vertex 3\n" + xyz + face + face), "a.ply") ==
              "mesh.syntax line 9");
        CHECK(refusalOf(ply("element vertex 3\n" + xyz + "property double x\n" + face), "a.ply") ==
              "mesh.syntax line 7");
        CHECK(refusalOf(ply("element vertex 3\nproperty float x\nproperty float y\n" + face),
                        "a.ply") == "mesh.format line 3");
        CHECK(refusalOf(ply("element vertex 3\nproperty float x\nproperty float y\n"
                            "property list uchar float z\n" +
                            face),
                        "a.ply") == "mesh.format line 3");
    }
    const std::string vertices = "0 0 0\n1 0 0\n0 1 0\n";
    const std::string head = "ply\nformat ascii 1.0\nelement vertex 3\n" + xyz;
    CHECK(refusalOf(head + "element face 1\nproperty list uchar int corners\nend_header\n" +
                        vertices + "3 0 1 2\n",
                    "a.ply") == "mesh.format line 7");
    CHECK(refusalOf(head + face + "property list uchar int vertex_index\nend_header\n" + vertices +
                        "3 0 1 2 3 0 1 2\n",
                    "a.ply") == "mesh.format line 7");
    CHECK(refusalOf(head + "element face 1\nproperty list float int vertex_indices\nend_header\n",
                    "a.ply") == "mesh.syntax line 8");
}

TEST_CASE("a fault in a binary PLY file is named by its byte") {
    std::string bytes =
        "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\n"
        "property float y\nproperty float z\nelement face 1\n"
        "property list char int vertex_indices\nend_header\n" +
        std::string(12, '\0');
    const std::string place = "(byte " + std::to_string(bytes.size() + 1) + ")";
    bytes += "\xFF" + std::string(12, '\0');  // a length of -1
    Diagnostics findings;
    try {
        farol::generator::io::decodeMesh(bytes, "a.ply", findings);
        FAIL("a list of -1 corners was read");
    } catch (const Error& error) {
        CHECK(error.code() == "mesh.count");
        CHECK_THAT(error.what(), Catch::EndsWith(place));
    }
}
