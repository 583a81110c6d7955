#include "generator/io/formats.h"

namespace farol::generator::io {
namespace {

/// A count on a row of its own and the rows that it counts.
struct Section {
    std::size_t begin, end;  ///< rows, without the count's
    std::uint32_t width;     ///< numbers a row, the same in all
};

/// The file as counted sections, or nothing where it is something else.
std::vector<Section> sectionsOf(const NumberRows& rows) {
    std::vector<Section> out;
    for (std::size_t at = 0; at < rows.rows.size();) {
        const double said = *rows.at(rows.rows[at]);
        const std::size_t left = rows.rows.size() - at - 1;
        if (rows.rows[at].count != 1 || !isCount(said) || left == 0) return {};
        const std::uint32_t width = rows.rows[at + 1].count;
        // Indices may be counted one by one though three stand on a row.
        const bool three = width == 3 && !out.empty() && said == 3.0 * static_cast<double>(left);
        if (said < 1 || (!three && said > static_cast<double>(left))) return {};
        const std::size_t count = three ? left : static_cast<std::size_t>(said);
        out.push_back({at + 1, at + 1 + count, width});
        for (std::size_t i = out.back().begin; i < out.back().end; ++i)
            if (rows.rows[i].count != width) return {};
        at = out.back().end;
    }
    return out;
}

glm::vec3 vec3At(const double* v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

}  // namespace

bool looksLikeSections(const NumberRows& rows) {
    const auto sections = sectionsOf(rows);
    return sections.size() >= 2 && sections.size() <= 4 && sections[0].width == 3;
}

Mesh decodeSections(const NumberRows& rows) {
    const auto sections = sectionsOf(rows);
    Mesh mesh;
    for (std::size_t s = 0; s < sections.size(); ++s) {
        const Section& section = sections[s];
        const Row& first = rows.rows[section.begin];
        const bool last = s + 1 == sections.size();
        if (!last && section.width == 1)
            rows.refuse("mesh.format", first, "the indices are expected in the last section");
        if (s > 0 && !last && section.end - section.begin != mesh.positions.size())
            rows.refuse("mesh.truncated", first,
                        "this section is not as long as that of the positions");
        if (s > 0 && !last && section.width != 2 && section.width != 3)
            rows.refuse("mesh.syntax", first, "expected two or three numbers");
        for (std::size_t i = section.begin; i < section.end; ++i) {
            const Row& row = rows.rows[i];
            const double* v = rows.at(row);
            if (s == 0)
                mesh.positions.push_back(vec3At(v));
            else if (last)
                for (std::uint32_t k = 0; k < row.count; ++k)
                    mesh.indices.push_back(indexIn(rows, row, v[k], mesh.positions.size()));
            else if (section.width == 3)
                mesh.normals.push_back(vec3At(v));
            else
                mesh.uvs.emplace_back(v[0], v[1]);
        }
    }
    if (mesh.indices.size() % 3 != 0)
        rows.refuse("mesh.truncated", rows.rows.back(),
                    "the number of indices is not a multiple of three");
    if (mesh.normals.size() > mesh.positions.size() || mesh.uvs.size() > mesh.positions.size())
        rows.refuse("mesh.format", rows.rows[0], "a section is given twice");
    checkTriangles(mesh.indices.size() / 3, rows.file);
    return mesh;
}

}  // namespace farol::generator::io
