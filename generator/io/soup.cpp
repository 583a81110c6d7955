#include <algorithm>
#include <numeric>

#include "generator/io/formats.h"
#include "generator/messages.h"

namespace farol::generator::io {
namespace {

glm::dvec2 vec2At(const double* v) { return {v[0], v[1]}; }

void appendThreeLines(const NumberRows& rows, std::size_t first, RawMesh& mesh) {
    for (std::size_t i = 0; i + first < rows.rows.size(); ++i) {
        const Row& row = rows.rows[i + first];
        const std::uint32_t width = i % 3 == 2 ? 2 : 3;
        if (row.count != width)
            rows.refuse(message<"mesh.syntax/width">("count"_arg = row.count, "width"_arg = width),
                        row);
        if (i % 3 == 0) mesh.positions.push_back(placeAt(rows, row, rows.at(row)));
        if (i % 3 == 1) mesh.normals.push_back(vec3At(rows.at(row)));
        if (i % 3 == 2) mesh.uvs.push_back(vec2At(rows.at(row)));
    }
    if ((rows.rows.size() - first) % 3 != 0)
        rows.refuse(message<"mesh.truncated/three-lines">(), rows.rows.back());
}

void appendRow(const NumberRows& rows, const Row& row, RawMesh& mesh) {
    const double* v = rows.at(row);
    const std::uint32_t width = row.count;
    if (width == 9) {
        for (int k = 0; k < 9; k += 3) mesh.positions.push_back(placeAt(rows, row, v + k));
        return;
    }
    if (width == 24) {  // a triangle: three times place, normal, coordinate
        for (int k = 0; k < 24; k += 8) {
            mesh.positions.push_back(placeAt(rows, row, v + k));
            mesh.normals.push_back(vec3At(v + k + 3));
            mesh.uvs.push_back(vec2At(v + k + 6));
        }
        return;
    }
    mesh.positions.push_back(placeAt(rows, row, v));
    if (width == 6 || width == 8) mesh.normals.push_back(vec3At(v + 3));
    if (width == 5 || width == 8) mesh.uvs.push_back(vec2At(v + width - 2));
}

/// The row that holds the number `index`.
const Row& rowAt(const NumberRows& rows, std::size_t index) {
    const auto after =
        std::upper_bound(rows.rows.begin(), rows.rows.end(), index,
                         [](std::size_t wanted, const Row& row) { return wanted < row.first; });
    return *(after - 1);
}

/// Every three vertices become a triangle.
RawMesh indexed(RawMesh mesh, const NumberRows& rows) {
    if (mesh.positions.size() % 3 != 0)
        rows.refuse(message<"mesh.truncated/vertices">("count"_arg = mesh.positions.size()),
                    rows.rows.back());
    checkTriangles(mesh.positions.size() / 3, rows.file);
    mesh.indices.resize(mesh.positions.size());
    std::iota(mesh.indices.begin(), mesh.indices.end(), 0U);
    return mesh;
}

}  // namespace

bool looksLikeThreeLines(const NumberRows& rows, std::size_t first) {
    const std::size_t count = rows.rows.size() - first;
    for (std::size_t i = 0; i < std::min<std::size_t>(count, 6); ++i)
        if (rows.rows[first + i].count != (i % 3 == 2 ? 2U : 3U)) return false;
    return count >= 3;
}

bool looksLikeStream(const NumberRows& rows) {
    const std::size_t count = rows.rows.size();
    if (count == 1) return rows.values.size() > 9;
    return rows.values.size() == count;
}

RawMesh decodeStream(const NumberRows& rows) {
    const std::size_t numbers = rows.values.size() - 1;
    const double headCount = rows.values[0];
    const bool headed = numbers % 9 == 0 && (headCount == static_cast<double>(numbers) ||
                                             3 * headCount == static_cast<double>(numbers) ||
                                             9 * headCount == static_cast<double>(numbers));
    const std::size_t first = headed ? 1 : 0;
    if ((rows.values.size() - first) % 9 != 0)
        rows.refuse(message<"mesh.format/stream">("count"_arg = rows.values.size()), rows.rows[0]);
    RawMesh mesh;
    for (std::size_t i = first; i < rows.values.size(); i += 3)
        mesh.positions.push_back(placeAt(rows, rowAt(rows, i), &rows.values[i]));
    return indexed(std::move(mesh), rows);
}

RawMesh decodeSoup(const NumberRows& rows, std::size_t first) {
    RawMesh mesh;
    const std::uint32_t width = rows.rows[first].count;
    if (looksLikeThreeLines(rows, first)) {
        appendThreeLines(rows, first, mesh);
    } else {
        if (width != 3 && width != 5 && width != 6 && width != 8 && width != 9 && width != 24)
            rows.refuse(message<"mesh.format/width">("count"_arg = width), rows.rows[first]);
        for (std::size_t i = first; i < rows.rows.size(); ++i) {
            const Row& row = rows.rows[i];
            if (row.count != width)
                rows.refuse(
                    message<"mesh.syntax/width">("count"_arg = row.count, "width"_arg = width),
                    row);
            appendRow(rows, row, mesh);
        }
    }
    return indexed(std::move(mesh), rows);
}

}  // namespace farol::generator::io
