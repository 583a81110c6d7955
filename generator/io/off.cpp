#include "generator/io/formats.h"
#include "generator/io/polygon.h"

namespace farol::generator::io {
namespace {

constexpr std::string_view kKeyword = "OFF";

}  // namespace

bool looksLikeOff(std::string_view bytes) {
    return bytes.substr(0, kKeyword.size()) == kKeyword && bytes.size() > kKeyword.size() &&
           std::string_view(" \t\r\n#").find(bytes[kKeyword.size()]) != std::string_view::npos;
}

Mesh decodeOff(std::string_view bytes, const std::string& fileName) {
    const NumberRows rows = parseRows(bytes.substr(kKeyword.size()), fileName, 1,
                                      static_cast<int>(kKeyword.size()) + 1);
    const Row& head = rows.rows[0];
    if (head.count < 2 || !isCount(rows.at(head)[0]) || !isCount(rows.at(head)[1]))
        rows.refuse("mesh.count", head, "expected the numbers of vertices and of faces");
    const double vertices = rows.at(head)[0], faces = rows.at(head)[1];
    if (vertices + faces > static_cast<double>(rows.rows.size() - 1))
        rows.refuse("mesh.truncated", head, "the file is shorter than its counts say");
    const std::size_t first = 1 + static_cast<std::size_t>(vertices);
    Mesh mesh;
    for (std::size_t i = 1; i < first; ++i) {
        const Row& row = rows.rows[i];
        const double* v = rows.at(row);
        if (row.count < 3) rows.refuse("mesh.syntax", row, "expected 3 numbers");
        mesh.positions.emplace_back(v[0], v[1], v[2]);
    }
    std::vector<glm::vec3> places;
    std::vector<FaceTriangle> triangles;
    for (std::size_t i = first; i < first + static_cast<std::size_t>(faces); ++i) {
        const Row& row = rows.rows[i];
        const double* v = rows.at(row);  // the number of corners, these, perhaps a colour
        if (!isCount(v[0]) || v[0] < 3 || v[0] > row.count - 1.0)
            rows.refuse("mesh.syntax", row, "expected a number of corners from 3 on, and these");
        const auto corner = [&](std::size_t k) {
            return indexIn(rows, row, v[1 + k], mesh.positions.size());
        };
        const auto corners = static_cast<std::size_t>(v[0]);
        checkTriangles(mesh.triangles() + corners - 2, fileName);
        places.clear();
        for (std::size_t k = 0; k < corners; ++k) places.push_back(mesh.positions[corner(k)]);
        triangulate(places, triangles);
        for (const auto& [a, b, c] : triangles)
            mesh.indices.insert(mesh.indices.end(), {corner(a), corner(b), corner(c)});
    }
    if (mesh.indices.empty()) rows.refuse("mesh.empty", head, "the OFF file holds no faces");
    return mesh;
}

}  // namespace farol::generator::io
