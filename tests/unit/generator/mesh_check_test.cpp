// The mesh check: every shape with planted faults, and what is accepted.
#include "generator/compare/mesh_check.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <sstream>

#include "core/text.h"
#include "generator/call.h"
#include "generator/compare/vertex_lines.h"
#include "generator/io/mesh_file.h"
#include "generator/registry.h"
#include "tests/support/paths.h"

using namespace farol;
using namespace farol::generator;

namespace {

scene::BundleAssets files() {
    return scene::BundleAssets(
        scene::BundleAssets::Files{{"vase.txt", "0.2 0 0\n0.8 0.2 0\n0.5 0.7 0\n0.6 1 0\n"}});
}

/// A call of the shape with sizes that are usual and few divisions.
std::string callOf(const ShapeEntry& shape) {
    std::string text = shape.name;
    if (shape.takesFile) text += shape.name == "patch" ? " teapot.patch" : " vase.txt";
    double length = 1.0;
    for (const Argument& one : shape.arguments) {
        if (one.role == ArgumentRole::length) {
            // Lengths that differ, so that exchanged ones show; inner ones stay smaller.
            text += " " + std::to_string(one.usual * length).substr(0, 4);
            length *= shape.name == "torus" || shape.name == "frustum" ? 0.4 : 1.5;
            continue;
        }
        const double count = shape.name == "patch" ? 3.0 : 10.0;
        const bool isDivision = shape.name == "plane" || shape.name == "box";
        text += " " + std::to_string(static_cast<int>(
                          std::max(one.min, isDivision ? std::min(3.0, count) : count)));
    }
    return text;
}

Mesh meshOf(const std::string& call) {
    const std::vector<std::string_view> words = split(call);
    return generate(parseCall({words.begin(), words.end()}), files());
}

std::string textOf(MeshArrays arrays) {
    // An encoder of our own: what is planted is not what Mesh accepts.
    std::ostringstream out;
    out.precision(9);
    for (const glm::vec3& p : arrays.positions) out << p.x << " " << p.y << " " << p.z << "\n";
    out << "\n";
    for (const glm::vec3& n : arrays.normals) out << n.x << " " << n.y << " " << n.z << "\n";
    out << "\n";
    for (const glm::vec2& uv : arrays.uvs) out << uv.x << " " << uv.y << "\n";
    out << "\n";
    for (std::size_t i = 0; i + 2 < arrays.indices.size(); i += 3)
        out << arrays.indices[i] << " " << arrays.indices[i + 1] << " " << arrays.indices[i + 2]
            << "\n";
    return out.str();
}

/// A fault, and the line of the vertex that shows it (0: the file as a whole).
struct Planted {
    MeshArrays arrays;
    int line = 0;
};

struct PlantedFault {
    const char* name;
    const char* code;
    std::function<std::optional<Planted>(const Mesh&)> plant;
};

/// The first triangle with area from the middle on.
std::size_t middleTriangle(const MeshArrays& mesh) {
    const std::size_t count = mesh.triangles();
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t t = (count / 2 + k) % count;
        const glm::dvec3 a(mesh.positions[mesh.indices[3 * t]]),
            b(mesh.positions[mesh.indices[3 * t + 1]]), c(mesh.positions[mesh.indices[3 * t + 2]]);
        if (glm::length(glm::cross(b - a, c - a)) > 1e-6) return t;
    }
    throw std::logic_error("a mesh without area");
}

double sizeOf(const MeshArrays& mesh) {
    glm::vec3 low(1e30F), high(-1e30F);
    for (const glm::vec3& p : mesh.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return glm::length(high - low);
}

std::optional<Planted> moved(const Mesh& mesh) {
    MeshArrays arrays = mesh.arrays();
    const std::uint32_t index = arrays.indices[3 * middleTriangle(arrays)];
    const glm::vec3 at = arrays.positions[index];
    int line = 0;
    for (std::size_t i = 0; i < arrays.positions.size(); ++i)
        if (glm::length(arrays.positions[i] - at) < 1e-6F) {
            if (line == 0) line = static_cast<int>(i) + 1;
            arrays.positions[i] +=
                static_cast<float>(0.03 * sizeOf(arrays)) * glm::vec3(0.6F, 0.7F, 0.4F);
        }
    return Planted{arrays, line};
}

std::optional<Planted> scaled(const Mesh& mesh) {
    MeshArrays arrays = mesh.arrays();
    for (glm::vec3& p : arrays.positions) p *= 2.0F;
    return Planted{arrays};
}

std::optional<Planted> missing(const Mesh& mesh) {
    MeshArrays arrays = mesh.arrays();
    const std::size_t t = middleTriangle(arrays);
    const auto at = arrays.indices.begin() + static_cast<std::ptrdiff_t>(3 * t);
    arrays.indices.erase(at, at + 3);
    return Planted{arrays};
}

int lineOfCorner(const MeshArrays& arrays, std::size_t triangle) {
    return static_cast<int>(arrays.indices[3 * triangle]) + 1;
}

std::optional<Planted> doubled(const Mesh& mesh) {
    MeshArrays arrays = mesh.arrays();
    const std::size_t t = middleTriangle(arrays);
    for (std::size_t k = 0; k < 3; ++k) arrays.indices.push_back(arrays.indices[3 * t + k]);
    return Planted{arrays, lineOfCorner(arrays, t)};
}

/// Whether the mesh has the triangle's other side, too: turned round it is that one.
bool hasBack(const MeshArrays& arrays, std::size_t triangle) {
    const auto at = [&](std::size_t t, std::size_t k) {
        return arrays.positions[arrays.indices[3 * t + k]];
    };
    for (std::size_t t = 0; t < arrays.triangles(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            if (at(t, k) == at(triangle, 0) && at(t, (k + 1) % 3) == at(triangle, 2) &&
                at(t, (k + 2) % 3) == at(triangle, 1))
                return true;
    return false;
}

std::optional<Planted> reversed(const Mesh& mesh) {
    MeshArrays arrays = mesh.arrays();
    const std::size_t t = middleTriangle(arrays);
    if (hasBack(arrays, t)) return std::nullopt;
    std::swap(arrays.indices[3 * t + 1], arrays.indices[3 * t + 2]);
    return Planted{arrays, lineOfCorner(arrays, t)};
}

std::optional<Planted> allReversed(const Mesh& mesh) {
    MeshArrays arrays = mesh.arrays();
    if (hasBack(arrays, middleTriangle(arrays))) return std::nullopt;
    for (std::size_t i = 0; i + 2 < arrays.indices.size(); i += 3)
        std::swap(arrays.indices[i + 1], arrays.indices[i + 2]);
    return Planted{arrays};
}

std::optional<Planted> degenerate(const Mesh& mesh) {
    MeshArrays arrays = mesh.arrays();
    const std::size_t t = middleTriangle(arrays);
    const std::uint32_t a = arrays.indices[3 * t], b = arrays.indices[3 * t + 1];
    arrays.indices.insert(arrays.indices.end(), {a, a, b});
    return Planted{arrays, static_cast<int>(a) + 1};
}

std::optional<Planted> inwardNormals(const Mesh& mesh) {
    MeshArrays arrays = mesh.arrays();
    for (glm::vec3& normal : arrays.normals) normal = -normal;
    return Planted{arrays};
}

std::optional<Planted> oneNormal(const Mesh& mesh) {
    MeshArrays arrays = mesh.arrays();
    const std::uint32_t index = arrays.indices[3 * middleTriangle(arrays) + 1];
    const glm::vec3 normal = arrays.normals[index];
    const glm::vec3 across = std::abs(normal.x) < 0.8F ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    arrays.normals[index] = glm::normalize(glm::cross(normal, across));
    return Planted{arrays, static_cast<int>(index) + 1};
}

std::optional<Planted> longNormals(const Mesh& mesh) {
    MeshArrays arrays = mesh.arrays();
    for (glm::vec3& normal : arrays.normals) normal *= 3.0F;
    return Planted{arrays};
}

std::optional<Planted> flippedV(const Mesh& mesh) {
    MeshArrays arrays = mesh.arrays();
    for (glm::vec2& uv : arrays.uvs) uv.y = 1.0F - uv.y;
    return Planted{arrays};
}

std::optional<Planted> split(const Mesh& mesh) {
    MeshArrays arrays = mesh.arrays();
    // An edge inside the mesh, by places.
    std::map<std::array<float, 3>, int> ids;
    std::vector<int> id;
    for (const glm::vec3& p : arrays.positions) {
        const std::array<float, 3> key{p.x + 0.0F, p.y + 0.0F, p.z + 0.0F};
        id.push_back(ids.emplace(key, static_cast<int>(ids.size())).first->second);
    }
    std::map<std::pair<int, int>, int> uses;
    const auto edgeOf = [&](std::size_t t, std::size_t k) {
        const int a = id[arrays.indices[3 * t + k]], b = id[arrays.indices[3 * t + (k + 1) % 3]];
        return std::pair{std::min(a, b), std::max(a, b)};
    };
    for (std::size_t t = 0; t < arrays.triangles(); ++t)
        for (std::size_t k = 0; k < 3; ++k) ++uses[edgeOf(t, k)];
    const std::size_t t = middleTriangle(arrays);
    for (std::size_t k = 0; k < 3; ++k) {
        if (uses[edgeOf(t, k)] != 2) continue;
        const std::uint32_t a = arrays.indices[3 * t + k], b = arrays.indices[3 * t + (k + 1) % 3],
                            c = arrays.indices[3 * t + (k + 2) % 3];
        if (id[a] == id[b]) continue;
        const auto m = static_cast<std::uint32_t>(arrays.positions.size());
        arrays.positions.push_back(0.5F * (arrays.positions[a] + arrays.positions[b]));
        arrays.normals.push_back(arrays.normals[a]);
        arrays.uvs.push_back(0.5F * (arrays.uvs[a] + arrays.uvs[b]));
        arrays.indices[3 * t] = a;
        arrays.indices[3 * t + 1] = m;
        arrays.indices[3 * t + 2] = c;
        arrays.indices.insert(arrays.indices.end(), {m, b, c});
        return Planted{arrays, static_cast<int>(m) + 1};
    }
    return std::nullopt;
}

/// Leaves out a flat side of two triangles or more, but not all of the mesh.
std::optional<Planted> withoutCap(const Mesh& mesh) {
    MeshArrays arrays = mesh.arrays();
    const auto faceOf = [&](std::size_t t) {
        const glm::dvec3 a(arrays.positions[arrays.indices[3 * t]]);
        const glm::dvec3 n =
            glm::cross(glm::dvec3(arrays.positions[arrays.indices[3 * t + 1]]) - a,
                       glm::dvec3(arrays.positions[arrays.indices[3 * t + 2]]) - a);
        const double length = glm::length(n);
        return length > 1e-9 ? glm::dvec4(n / length, glm::dot(n / length, a)) : glm::dvec4(0.0);
    };
    for (std::size_t first = 0; first < arrays.triangles(); ++first) {
        const glm::dvec4 plane = faceOf(first);
        std::set<std::size_t> side;
        for (std::size_t t = 0; t < arrays.triangles(); ++t)
            if (glm::length(faceOf(t) - plane) < 1e-5) side.insert(t);
        if (plane == glm::dvec4(0.0) || side.size() < 3 || side.size() == arrays.triangles())
            continue;
        std::vector<std::uint32_t> left;
        for (std::size_t t = 0; t < arrays.triangles(); ++t)
            for (std::size_t k = 0; k < 3 && side.count(t) == 0; ++k)
                left.push_back(arrays.indices[3 * t + k]);
        arrays.indices = left;
        return Planted{arrays};
    }
    return std::nullopt;
}

const std::vector<PlantedFault>& faults() {
    static const std::vector<PlantedFault> kFaults{
        {"vertex moved", "check.position", moved},
        {"twice as large", "check.size", scaled},
        {"triangle left out", "check.missing", missing},
        {"triangle twice", "check.doubled", doubled},
        {"triangle clockwise", "check.winding", reversed},
        {"all clockwise", "check.winding", allReversed},
        {"triangle without area", "check.degenerate", degenerate},
        {"normals inward", "check.normals", inwardNormals},
        {"one normal", "check.normals", oneNormal},
        {"normals too long", "check.normals", longNormals},
        {"V flipped", "check.uv", flippedV},
        {"T-junction", "check.t-junction", split},
        {"flat side left out", "check.cap", withoutCap},
    };
    return kFaults;
}

std::string codesOf(const MeshCheck& check) {
    std::set<std::string> codes;
    for (const Diagnostic& one : check.findings)
        if (one.severity != Severity::info && one.code != "check.more") codes.insert(one.code);
    return joined(codes, ", ");
}

std::string listOf(const MeshCheck& check) {
    std::string out;
    for (const Diagnostic& one : check.findings)
        out += std::to_string(one.where.line) + ": " + one.message + " [" + one.code + "]\n";
    return out;
}

}  // namespace

TEST_CASE("each shape as it is generated is right, in each written form") {
    for (const ShapeEntry& shape : shapes()) {
        const std::string call = callOf(shape);
        INFO(call);
        const Mesh mesh = meshOf(call);
        for (const auto format : {io::Format::text3d, io::Format::obj, io::Format::ply}) {
            const char* const names[] = {"mine.3d", "mine.obj", "mine.ply"};
            const MeshCheck check = checkMesh(io::encodeMesh(mesh, format),
                                              names[static_cast<std::size_t>(format)], mesh);
            INFO(listOf(check));
            CHECK(check.isRight());
            CHECK(codesOf(check) == "");
        }
    }
}

TEST_CASE("every shape with each planted fault: the fault is found, with its line") {
    std::string table = "| shape |";
    for (const PlantedFault& fault : faults()) table += " " + std::string(fault.name) + " |";
    table += "\n| --- |";
    for (std::size_t i = 0; i < faults().size(); ++i) table += " --- |";
    table += "\n";
    for (const ShapeEntry& shape : shapes()) {
        const std::string call = callOf(shape);
        const Mesh mesh = meshOf(call);
        table += "| `" + call + "` |";
        for (const PlantedFault& fault : faults()) {
            const std::optional<Planted> planted = fault.plant(mesh);
            if (!planted) {
                table += " - |";
                continue;
            }
            const MeshCheck check = checkMesh(textOf(planted->arrays), "mine.3d", mesh);
            INFO(call << ", " << fault.name << ":\n" << listOf(check));
            const auto found =
                std::find_if(check.findings.begin(), check.findings.end(),
                             [&](const Diagnostic& one) { return one.code == fault.code; });
            CHECK(found != check.findings.end());
            bool hasLine = planted->line == 0;
            for (const Diagnostic& one : check.findings)
                hasLine = hasLine || (one.code == fault.code && one.where.line == planted->line);
            CHECK(hasLine);
            // Nothing else is reported.
            CHECK(codesOf(check) == fault.code);
            table += codesOf(check) == fault.code ? " found |" : " " + codesOf(check) + " |";
        }
        table += "\n";
    }
    std::ifstream in(std::string(test::kSourceDir) + "/docs/benchmarks/mesh-check.md");
    std::stringstream page;
    page << in.rdbuf();
    INFO(table);
    CHECK(page.str().find(table) != std::string::npos);
}

TEST_CASE("what draws the same is accepted") {
    for (const ShapeEntry& shape : shapes()) {
        const std::string call = callOf(shape);
        INFO(call);
        const Mesh mesh = meshOf(call);
        MeshArrays arrays = mesh.arrays();
        // Vertices the other way round, triangles from the last to the first, other first corners.
        const auto count = static_cast<std::uint32_t>(arrays.positions.size());
        std::reverse(arrays.positions.begin(), arrays.positions.end());
        std::reverse(arrays.normals.begin(), arrays.normals.end());
        std::reverse(arrays.uvs.begin(), arrays.uvs.end());
        std::vector<std::uint32_t> indices;
        for (std::size_t t = arrays.triangles(); t-- > 0;)
            for (const std::size_t k : {1, 2, 0})
                indices.push_back(count - 1 - arrays.indices[3 * t + k]);
        arrays.indices = indices;
        const MeshCheck check = checkMesh(textOf(arrays), "mine.3d", mesh);
        INFO(listOf(check));
        CHECK(codesOf(check) == "");
    }
}

TEST_CASE("the other diagonal of a quad, another start of the divisions and of the seam") {
    const Mesh plane = meshOf("plane 2 3");
    MeshArrays arrays = plane.arrays();
    // Each quad is two triangles in a row that share an edge.
    for (std::size_t t = 0; t + 1 < arrays.triangles(); t += 2) {
        std::uint32_t* a = &arrays.indices[3 * t];
        std::vector<std::uint32_t> shared, own;
        for (int k = 0; k < 3; ++k)
            (std::count(a + 3, a + 6, a[k]) > 0 ? shared : own).push_back(a[k]);
        REQUIRE(own.size() == 1);
        const std::uint32_t first = own[0];
        std::rotate(a, std::find(a, a + 3, first), a + 3);
        const std::uint32_t b = a[1], d = a[2];
        std::uint32_t c = 0;
        for (int k = 3; k < 6; ++k)
            if (a[k] != b && a[k] != d) c = a[k];
        const std::uint32_t quad[6] = {first, b, c, first, c, d};
        std::copy(quad, quad + 6, a);
    }
    CHECK(codesOf(checkMesh(textOf(arrays), "mine.3d", plane)) == "");

    const Mesh sphere = meshOf("sphere 1 10 8");
    arrays = sphere.arrays();
    const float c = std::cos(0.2F), s = std::sin(0.2F);
    for (std::vector<glm::vec3>* all : {&arrays.positions, &arrays.normals})
        for (glm::vec3& v : *all) v = {c * v.x + s * v.z, v.y, -s * v.x + c * v.z};
    const MeshCheck turned = checkMesh(textOf(arrays), "mine.3d", sphere);
    INFO(listOf(turned));
    CHECK(codesOf(turned) == "");
    CHECK(turned.findings.front().code == "check.turned");

    arrays = sphere.arrays();
    for (glm::vec2& uv : arrays.uvs) uv.x += 0.3F;
    const MeshCheck seam = checkMesh(textOf(arrays), "mine.3d", sphere);
    INFO(listOf(seam));
    CHECK(codesOf(seam) == "");
    CHECK(seam.findings.front().code == "check.seam");
    // A box has no seam to start elsewhere.
    const Mesh box = meshOf("box 2 1");
    arrays = box.arrays();
    for (glm::vec2& uv : arrays.uvs) uv.x += 0.3F;
    CHECK(codesOf(checkMesh(textOf(arrays), "mine.3d", box)) == "check.uv");
}

TEST_CASE("other divisions, axes and places are one finding each") {
    const auto codes = [](const std::string& mine, const std::string& expected) {
        return codesOf(checkMesh(io::encodeMesh(meshOf(mine), io::Format::text3d), "mine.3d",
                                 meshOf(expected)));
    };
    CHECK(codes("sphere 1 12 10", "sphere 1 10 8") == "check.divisions");
    CHECK(codes("box 2 1", "sphere 1 10 8") == "check.divisions");
    CHECK(codes("cone 2 2 10 3", "cone 1 2 10 3").find("check.size") == 0);
    const Mesh cone = meshOf("cone 1 2 10 3");
    MeshArrays arrays = cone.arrays();
    for (glm::vec3& p : arrays.positions) p.y -= 1.0F;
    CHECK(codesOf(checkMesh(textOf(arrays), "mine.3d", cone)) == "check.place");
    arrays = cone.arrays();
    for (std::vector<glm::vec3>* all : {&arrays.positions, &arrays.normals})
        for (glm::vec3& v : *all) v = {v.x, -v.z, v.y};
    CHECK_THAT(codesOf(checkMesh(textOf(arrays), "mine.3d", cone)),
               Catch::StartsWith("check.axes"));
}

TEST_CASE("lines of vertices are found in files of several forms") {
    const std::vector<glm::dvec3> places{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}};
    CHECK(vertexLines("4\n0 0 0\n1 0 0\n0 1 0\n0 0 0\n", places) == std::vector<int>{2, 3, 4, 5});
    CHECK(vertexLines("v1: 0.0 0 0 n 0 1 0\nv2: 1 0 0 n 0 1 0\nv3: 0 1 0\nv4: -0 0 0\n", places) ==
          std::vector<int>{1, 2, 3, 4});
    CHECK(vertexLines("<v x=\"0\" y=\"0\" z=\"0\"/>\n<v x=\"1\" y=\"0\" z=\"0\"/>\n<v x=\"0\" "
                      "y=\"1e0\" z=\"0\"/>\n",
                      places) == std::vector<int>{1, 2, 3, 1});
    CHECK(vertexLines(std::string("\0\1\2\3", 4), places) == std::vector<int>{0, 0, 0, 0});
}
