#include <algorithm>
#include <charconv>

#include "generator/io/formats.h"
#include "generator/io/writer.h"
#include "generator/messages.h"

namespace farol::generator::io {
namespace {

template <int N, class Vector>
std::vector<Vector> vectorsOf(const NumberRows& rows, std::size_t begin, std::size_t end) {
    std::vector<Vector> out;
    out.reserve(end - begin);
    for (std::size_t i = begin; i < end; ++i) {
        const Row& row = rows.rows[i];
        if (row.count != N)
            rows.refuse(message<"mesh.syntax/width">("count"_arg = row.count, "width"_arg = N),
                        row);
        Vector value;
        for (int k = 0; k < N; ++k)
            value[k] = static_cast<typename Vector::value_type>(rows.at(row)[k]);
        out.push_back(value);
    }
    return out;
}

std::vector<glm::dvec3> placesOf(const NumberRows& rows, std::size_t begin, std::size_t end) {
    std::vector<glm::dvec3> out = vectorsOf<3, glm::dvec3>(rows, begin, end);
    for (std::size_t i = begin; i < end; ++i) placeAt(rows, rows.rows[i], rows.at(rows.rows[i]));
    return out;
}

/// Indices of rows [begin, end), any number a row.
std::vector<std::uint32_t> indicesOf(const NumberRows& rows, std::size_t begin, std::size_t end,
                                     std::size_t vertices) {
    std::vector<std::uint32_t> out;
    const double base =
        end > begin ? indexBase(rows.at(rows.rows[begin]),
                                rows.at(rows.rows[end - 1]) + rows.rows[end - 1].count, vertices)
                    : 0.0;
    for (std::size_t i = begin; i < end; ++i)
        for (std::uint32_t k = 0; k < rows.rows[i].count; ++k)
            out.push_back(indexIn(rows, rows.rows[i], rows.at(rows.rows[i])[k] - base, vertices));
    if (out.size() % 3 != 0)
        rows.refuse(message<"mesh.truncated/indices">("count"_arg = out.size()),
                    rows.rows[end - 1]);
    checkTriangles(out.size() / 3, rows.file);
    return out;
}

void checkAsLong(const NumberRows& rows, std::size_t at, std::size_t got, std::size_t want,
                 const Message& kind) {
    if (got != want)
        rows.refuse(message<"mesh.truncated/unequal">("count"_arg = got, "kind"_arg = kind,
                                                      "positions"_arg = want),
                    rows.rows[at]);
}

/// True when a row of three could be a triangle: whole numbers, in range and all different.
bool couldBeTriangle(const NumberRows& rows, const Row& row, std::size_t vertices) {
    const double* v = rows.at(row);
    if (row.count != 3 || v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) return false;
    for (int k = 0; k < 3; ++k)
        if (!isCount(v[k]) || v[k] >= static_cast<double>(vertices)) return false;
    return true;
}

bool couldBeTriangles(const NumberRows& rows, std::size_t begin, std::size_t end,
                      std::size_t vertices) {
    for (std::size_t i = begin; i < end; ++i)
        if (!couldBeTriangle(rows, rows.rows[i], vertices)) return false;
    return true;
}

/// True if all rows after the first have one width of a soup and make whole triangles.
bool isUniformSoup(const NumberRows& rows) {
    const std::uint32_t width = rows.rows[1].count;
    const std::size_t left = rows.rows.size() - 1;
    if (width != 3 && width != 6 && width != 8 && width != 9 && width != 24) return false;
    for (std::size_t i = 2; i < rows.rows.size(); ++i)
        if (rows.rows[i].count != width) return false;
    return width >= 9 || left % 3 == 0;
}

/// Decodes a soup after a count. Ignores the count, with a warning if it is none of `right`.
RawMesh countedLoosely(const NumberRows& rows, double headCount, const std::vector<double>& right) {
    RawMesh mesh = decodeSoup(rows, 1);
    if (std::find(right.begin(), right.end(), headCount) == right.end())
        mesh.findings.push_back(
            diagnosticOf(Severity::warning,
                         message<"mesh.count-wrong/soup">("count"_arg = headCount,
                                                          "vertices"_arg = mesh.positions.size()),
                         {rows.file, rows.rows[0].line, 1}));
    return mesh;
}

/// Returns the possible counts of a soup of three rows a vertex: vertices, triangles, numbers.
std::vector<double> countsOf(std::size_t rows) {
    const double vertices = static_cast<double>(rows) / 3.0;
    return {vertices, vertices / 3.0, vertices * 8.0};
}

/// Rows of one width after a count of them, of their triangles or of their numbers.
bool isCountedSoup(const NumberRows& rows, double headCount) {
    const std::uint32_t width = rows.rows[1].count;
    const auto left = static_cast<double>(rows.rows.size() - 1);
    if (width < 3) return false;
    for (std::size_t i = 2; i < rows.rows.size(); ++i)
        if (rows.rows[i].count != width) return false;
    const double perRow = width == 9 ? 3 : 1;                        // vertices
    const bool vertices = headCount == perRow * left && width != 3;  // positions alone: see below
    return vertices || 3 * headCount == perRow * left || headCount == width * left;
}

}  // namespace

std::string encodeText3d(const Mesh& mesh) {
    Writer out;
    for (std::size_t i = 0; i < mesh.positions().size(); ++i) {
        out.place(mesh, i);
        out.text("\n");
    }
    out.text("\n");
    for (const glm::vec3& n : mesh.normals()) out.row({n.x, n.y, n.z});
    if (!mesh.normals().empty()) out.text("\n");
    for (const glm::vec2& uv : mesh.uvs()) out.row({uv.x, uv.y});
    if (!mesh.uvs().empty()) out.text("\n");
    for (std::size_t i = 0; i < mesh.indices().size(); ++i) {
        out.number(mesh.indices()[i]);
        out.text("\n");
    }
    return out.take();
}

RawMesh decodeBlocks(const NumberRows& rows) {
    std::vector<std::size_t> starts;
    for (std::size_t i = 0; i < rows.rows.size(); ++i)
        if (rows.rows[i].block == starts.size()) starts.push_back(i);
    starts.push_back(rows.rows.size());
    const std::size_t last = starts.size() - 2;  // the block of indices
    RawMesh mesh;
    mesh.positions = placesOf(rows, 0, starts[1]);
    for (std::size_t b = 1; b < last; ++b) {
        const Row& row = rows.rows[starts[b]];
        const std::size_t size = starts[b + 1] - starts[b];
        if (row.count == 3 && mesh.normals.empty() && mesh.uvs.empty()) {
            checkAsLong(rows, starts[b], size, mesh.positions.size(), message<"part.normals">());
            mesh.normals = vectorsOf<3, glm::vec3>(rows, starts[b], starts[b + 1]);
        } else if (row.count == 2 && mesh.uvs.empty()) {
            checkAsLong(rows, starts[b], size, mesh.positions.size(), message<"part.uvs">());
            mesh.uvs = vectorsOf<2, glm::dvec2>(rows, starts[b], starts[b + 1]);
        } else {
            rows.refuse(message<"mesh.format/block">("count"_arg = row.count), row);
        }
    }
    mesh.indices = indicesOf(rows, starts[last], starts[last + 1], mesh.positions.size());
    return mesh;
}

RawMesh decodeCounted(const NumberRows& rows) {
    const Row& head = rows.rows[0];
    std::size_t at = 1;
    const double countV = rows.at(head)[0];
    double countI = 0;
    if (head.count >= 2) {  // a third may count edges, as in OFF files
        countI = rows.at(head)[1];
    } else {
        countI = rows.at(rows.rows[1])[0];
        at = 2;
    }
    const std::size_t left = rows.rows.size() - at;
    if (!isCount(countV) || !isCount(countI)) rows.refuse(message<"mesh.count/head">(), head);
    if (countV < 1 || countI < 1) rows.refuse(message<"mesh.empty/triangles">(), head);
    if (countV > static_cast<double>(left) || countI > 3.0 * static_cast<double>(left))
        rows.refuse(message<"mesh.truncated/short">(), head);
    const auto n = static_cast<std::size_t>(countV), headCount = static_cast<std::size_t>(countI);
    RawMesh mesh;
    mesh.positions = placesOf(rows, at, at + n);
    at += n;
    // How many rows the indices take: three a row (counted one by one, or as triangles), or one.
    const std::size_t rest = rows.rows.size() - at;
    for (const std::size_t indexRows : {(headCount + 2) / 3, headCount}) {
        if (rest < indexRows || (rest - indexRows) % n != 0) continue;
        const std::size_t extra = (rest - indexRows) / n;
        if (extra > 2) continue;
        // Indices come last, but some write the normals after them.
        const bool early =
            extra > 0 && couldBeTriangles(rows, at, at + indexRows, n) &&
            !(rows.rows.back().count != 2 &&
              couldBeTriangles(rows, rows.rows.size() - indexRows, rows.rows.size(), n));
        std::size_t vectors = early ? at + indexRows : at;
        for (std::size_t k = 0; k < extra; ++k, vectors += n) {
            if (rows.rows[vectors].count == 2 && mesh.uvs.empty())
                mesh.uvs = vectorsOf<2, glm::dvec2>(rows, vectors, vectors + n);
            else
                mesh.normals = vectorsOf<3, glm::vec3>(rows, vectors, vectors + n);
        }
        const std::size_t indices = early ? at : vectors;
        mesh.indices = indicesOf(rows, indices, indices + indexRows, n);
        return mesh;
    }
    rows.refuse(message<"mesh.truncated/mismatch">(), rows.rows.back());
}

RawMesh decodeSingleCount(const NumberRows& rows) {
    const Row& head = rows.rows[0];
    const double headCount = *rows.at(head);
    const std::size_t left = rows.rows.size() - 1;
    if (!isCount(headCount) || headCount < 1) rows.refuse(message<"mesh.count/single">(), head);
    if (isCountedSoup(rows, headCount)) return decodeSoup(rows, 1);
    if (looksLikeThreeLines(rows, 1) && left % 9 == 0)
        return countedLoosely(rows, headCount, countsOf(left));
    if (isUniformSoup(rows) && headCount != static_cast<double>(left) &&
        2.0 * headCount != static_cast<double>(left))
        return countedLoosely(rows, headCount, {});
    if (headCount > static_cast<double>(left))
        rows.refuse(message<"mesh.truncated/held">("count"_arg = headCount, "lines"_arg = left),
                    head);
    const auto n = static_cast<std::size_t>(headCount);
    RawMesh mesh;
    if (rows.rows[1].count == 1) {  // indices, then x y z nx ny nz u v
        const std::size_t begin = 1 + n;
        for (std::size_t i = begin; i < rows.rows.size(); ++i) {
            const Row& row = rows.rows[i];
            if (row.count != 8)
                rows.refuse(message<"mesh.syntax/vertex">("count"_arg = row.count), row);
            const double* v = rows.at(row);
            mesh.positions.push_back(placeAt(rows, row, v));
            mesh.normals.emplace_back(v[3], v[4], v[5]);
            mesh.uvs.emplace_back(v[6], v[7]);
        }
        mesh.indices = indicesOf(rows, 1, begin, mesh.positions.size());
        return mesh;
    }
    const bool uvs = left == 3 * n && rows.rows.back().count == 2;
    if (left != n && left != 2 * n && !uvs)
        rows.refuse(message<"mesh.truncated/held">("count"_arg = n, "lines"_arg = left),
                    rows.rows.back());
    if (n % 3 != 0) rows.refuse(message<"mesh.truncated/vertices">("count"_arg = n), head);
    checkTriangles(n / 3, rows.file);
    mesh.positions = placesOf(rows, 1, 1 + n);
    if (left > n) mesh.normals = vectorsOf<3, glm::vec3>(rows, 1 + n, 1 + 2 * n);
    if (uvs) mesh.uvs = vectorsOf<2, glm::dvec2>(rows, 1 + 2 * n, 1 + 3 * n);
    for (std::uint32_t i = 0; i < n; ++i) mesh.indices.push_back(i);
    return mesh;
}

}  // namespace farol::generator::io
