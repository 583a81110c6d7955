#include <numeric>

#include "generator/io/formats.h"

namespace farol::generator::io {
namespace {

glm::vec3 vec3At(const double* v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

glm::vec2 vec2At(const double* v) { return {static_cast<float>(v[0]), static_cast<float>(v[1])}; }

/// Position, normal and UV on three lines of their own.
bool isThreeLines(const NumberRows& rows) {
    for (std::size_t i = 0; i < std::min<std::size_t>(rows.rows.size(), 6); ++i)
        if (rows.rows[i].count != (i % 3 == 2 ? 2U : 3U)) return false;
    return rows.rows.size() >= 3;
}

void appendThreeLines(const NumberRows& rows, Mesh& mesh) {
    for (std::size_t i = 0; i < rows.rows.size(); ++i) {
        const Row& row = rows.rows[i];
        const std::uint32_t width = i % 3 == 2 ? 2 : 3;
        if (row.count != width)
            rows.refuse(
                "mesh.syntax", row,
                "expected " + std::to_string(width) + " numbers, not " + std::to_string(row.count));
        if (i % 3 == 0) mesh.positions.push_back(vec3At(rows.at(row)));
        if (i % 3 == 1) mesh.normals.push_back(vec3At(rows.at(row)));
        if (i % 3 == 2) mesh.uvs.push_back(vec2At(rows.at(row)));
    }
    if (rows.rows.size() % 3 != 0)
        rows.refuse("mesh.truncated", rows.rows.back(), "the last vertex is incomplete");
}

void appendRow(const NumberRows& rows, const Row& row, Mesh& mesh) {
    const double* v = rows.at(row);
    const std::uint32_t width = row.count;
    if (width == 9) {
        for (int k = 0; k < 9; k += 3) mesh.positions.push_back(vec3At(v + k));
        return;
    }
    mesh.positions.push_back(vec3At(v));
    if (width == 6 || width == 8) mesh.normals.push_back(vec3At(v + 3));
    if (width == 5 || width == 8) mesh.uvs.push_back(vec2At(v + width - 2));
}

/// Every three vertices become a triangle.
Mesh indexed(Mesh mesh, const NumberRows& rows) {
    if (mesh.positions.size() % 3 != 0)
        rows.refuse("mesh.truncated", rows.rows.back(),
                    "the number of vertices, " + std::to_string(mesh.positions.size()) +
                        ", is not a multiple of three");
    checkTriangles(mesh.positions.size() / 3, rows.file);
    mesh.indices.resize(mesh.positions.size());
    std::iota(mesh.indices.begin(), mesh.indices.end(), 0U);
    return mesh;
}

}  // namespace

bool looksLikeStream(const NumberRows& rows) {
    const std::size_t count = rows.rows.size();
    if (count == 1) return rows.values.size() > 9;
    return rows.values.size() == count;
}

Mesh decodeStream(const NumberRows& rows) {
    const std::size_t numbers = rows.values.size() - 1;
    const double said = rows.values[0];
    const bool headed = numbers % 9 == 0 && (said == static_cast<double>(numbers) ||
                                             3 * said == static_cast<double>(numbers) ||
                                             9 * said == static_cast<double>(numbers));
    const std::size_t first = headed ? 1 : 0;
    if ((rows.values.size() - first) % 9 != 0)
        rows.refuse("mesh.format", rows.rows[0],
                    "no known mesh format has " + std::to_string(rows.values.size()) +
                        " numbers in one row or column; of positions alone there are nine a "
                        "triangle");
    Mesh mesh;
    for (std::size_t i = first; i < rows.values.size(); i += 3)
        mesh.positions.push_back(vec3At(&rows.values[i]));
    return indexed(std::move(mesh), rows);
}

Mesh decodeSoup(const NumberRows& rows, std::size_t first) {
    Mesh mesh;
    const std::uint32_t width = rows.rows[first].count;
    if (first == 0 && isThreeLines(rows)) {
        appendThreeLines(rows, mesh);
    } else {
        if (width != 3 && width != 5 && width != 6 && width != 8 && width != 9)
            rows.refuse("mesh.format", rows.rows[first],
                        "no known mesh format has " + std::to_string(width) + " numbers a line");
        for (std::size_t i = first; i < rows.rows.size(); ++i) {
            const Row& row = rows.rows[i];
            if (row.count != width)
                rows.refuse("mesh.syntax", row,
                            "expected " + std::to_string(width) + " numbers, not " +
                                std::to_string(row.count));
            appendRow(rows, row, mesh);
        }
    }
    return indexed(std::move(mesh), rows);
}

}  // namespace farol::generator::io
