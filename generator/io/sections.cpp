#include <numeric>

#include "generator/io/formats.h"
#include "generator/messages.h"

namespace farol::generator::io {
namespace {

/// A count alone on its row and the rows that it counts.
struct Section {
    std::size_t begin, end;  ///< rows, without the count's
    std::uint32_t width;     ///< numbers a row, the same in all
};

/// The file as counted sections, or nothing where it is something else. A row of three behind them
/// is one normal for all.
struct Sections {
    std::vector<Section> all;
    bool hasIndices = false;    ///< the last of them
    std::size_t normalRow = 0;  ///< 0: there is none
};

/// True where all rows of the section could be indices of `vertices` vertices.
bool couldBeIndices(const NumberRows& rows, const Section& section, std::size_t vertices) {
    for (std::size_t i = section.begin; i < section.end; ++i)
        for (std::uint32_t k = 0; k < section.width; ++k) {
            const double value = rows.at(rows.rows[i])[k];
            if (!isCount(value) || value >= static_cast<double>(vertices)) return false;
        }
    return true;
}

Sections sectionsOf(const NumberRows& rows) {
    Sections out;
    const std::size_t total = rows.rows.size();
    for (std::size_t at = 0; at < total;) {
        if (out.all.size() >= 2 && at + 1 == total && rows.rows[at].count == 3) {
            out.normalRow = at;
            break;
        }
        const double headCount = *rows.at(rows.rows[at]);
        const std::size_t left = total - at - 1;
        if (rows.rows[at].count != 1 || !isCount(headCount) || left == 0) return {};
        const std::uint32_t width = rows.rows[at + 1].count;
        // Indices may be counted one by one though three stand on a row.
        const bool three =
            width == 3 && !out.all.empty() && headCount == 3.0 * static_cast<double>(left);
        if (headCount < 1 || (!three && headCount > static_cast<double>(left))) return {};
        const std::size_t count = three ? left : static_cast<std::size_t>(headCount);
        out.all.push_back({at + 1, at + 1 + count, width});
        for (std::size_t i = out.all.back().begin; i < out.all.back().end; ++i)
            if (rows.rows[i].count != width) return {};
        at = out.all.back().end;
    }
    if (out.all.empty()) return out;
    // Triangles may stand before the positions that they index.
    if (out.all.size() == 2 && out.all[0].width == 3 && out.all[1].width == 3 &&
        couldBeIndices(rows, out.all[0], out.all[1].end - out.all[1].begin) &&
        !couldBeIndices(rows, out.all[1], out.all[0].end - out.all[0].begin))
        std::swap(out.all[0], out.all[1]);
    // Lists as long as the positions that cannot be indices: the vertices make triangles in a row.
    const std::size_t vertices = out.all[0].end - out.all[0].begin;
    const Section& last = out.all.back();
    const bool list =
        last.end - last.begin == vertices &&
        (last.width == 2 || (last.width == 3 && !couldBeIndices(rows, last, vertices)));
    out.hasIndices = !list;
    return out;
}

}  // namespace

bool looksLikeSections(const NumberRows& rows) {
    const Sections sections = sectionsOf(rows);
    return sections.all.size() >= 2 && sections.all.size() <= 4 && sections.all[0].width == 3;
}

RawMesh decodeSections(const NumberRows& rows) {
    const Sections sections = sectionsOf(rows);
    RawMesh mesh;
    for (std::size_t s = 0; s < sections.all.size(); ++s) {
        const Section& section = sections.all[s];
        const Row& first = rows.rows[section.begin];
        const bool indices = s + 1 == sections.all.size() && sections.hasIndices;
        if (!indices && section.width == 1) rows.refuse(message<"mesh.format/section">(), first);
        if (s > 0 && !indices && section.end - section.begin != mesh.positions.size())
            rows.refuse(message<"mesh.truncated/section">("count"_arg = section.end - section.begin,
                                                          "positions"_arg = mesh.positions.size()),
                        first);
        if (s > 0 && !indices && section.width != 2 && section.width != 3)
            rows.refuse(message<"mesh.syntax/section">("count"_arg = section.width), first);
        for (std::size_t i = section.begin; i < section.end; ++i) {
            const Row& row = rows.rows[i];
            const double* v = rows.at(row);
            if (s == 0)
                mesh.positions.push_back(placeAt(rows, row, v));
            else if (indices)
                for (std::uint32_t k = 0; k < row.count; ++k)
                    mesh.indices.push_back(indexIn(rows, row, v[k], mesh.positions.size()));
            else if (section.width == 3)
                mesh.normals.push_back(vec3At(v));
            else
                mesh.uvs.emplace_back(v[0], v[1]);
        }
    }
    if (!sections.hasIndices) {
        mesh.indices.resize(mesh.positions.size());
        std::iota(mesh.indices.begin(), mesh.indices.end(), 0U);
    }
    if (mesh.indices.size() % 3 != 0)
        rows.refuse(message<"mesh.truncated/indices">("count"_arg = mesh.indices.size()),
                    rows.rows.back());
    if (sections.normalRow > 0 && mesh.normals.empty())
        mesh.normals.assign(mesh.positions.size(), vec3At(rows.at(rows.rows[sections.normalRow])));
    if (mesh.normals.size() > mesh.positions.size() || mesh.uvs.size() > mesh.positions.size())
        rows.refuse(message<"mesh.format/section-twice">(), rows.rows[0]);
    checkTriangles(mesh.indices.size() / 3, rows.file);
    return mesh;
}

}  // namespace farol::generator::io
