#include <algorithm>

#include "generator/io/formats.h"
#include "generator/messages.h"

namespace farol::generator::io {
namespace {

bool isBlank(std::string_view text) {
    return text.find_first_not_of(" \t\r\n;,") == std::string_view::npos;
}

/// Pieces of `text` between `separator`s that hold more than blanks; at most five are looked for.
std::vector<std::string_view> pieces(std::string_view text, char separator) {
    std::vector<std::string_view> out;
    while (!text.empty() && out.size() < 5) {
        const std::size_t end = std::min(text.find(separator), text.size());
        if (!isBlank(text.substr(0, end))) out.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return out;
}

std::vector<std::string_view> split(std::string_view bytes) {
    const auto lines = pieces(bytes, '\n');
    return lines.size() == 1 ? pieces(bytes, ';') : lines;
}

/// All numbers of a list, with the line that each stands on.
NumberRows numbersOf(std::string_view list, std::string_view all, const std::string& file) {
    const std::string_view before =
        all.substr(0, static_cast<std::size_t>(list.data() - all.data()));
    const auto lines = std::count(before.begin(), before.end(), '\n');
    const std::size_t columns = before.size() - (before.rfind('\n') + 1);  // npos + 1 is 0
    return parseRows(list, file, static_cast<int>(lines) + 1, static_cast<int>(columns) + 1);
}

template <int N, class Vector>
std::vector<Vector> vectorsOf(const NumberRows& rows, const Message& kind) {
    if (rows.values.size() % N != 0)
        rows.refuse(message<"mesh.truncated/list">(
                        "kind"_arg = kind, "count"_arg = rows.values.size(), "width"_arg = N),
                    rows.rows[0]);
    std::vector<Vector> out(rows.values.size() / N);
    for (std::size_t i = 0; i < rows.values.size(); ++i)
        out[i / N][static_cast<int>(i % N)] =
            static_cast<typename Vector::value_type>(rows.values[i]);
    return out;
}

template <class Vector>
void checkAsLong(const NumberRows& rows, const std::vector<Vector>& list, std::size_t positions,
                 const Message& kind) {
    if (list.size() != positions)
        rows.refuse(message<"mesh.truncated/unequal">("count"_arg = list.size(), "kind"_arg = kind,
                                                      "positions"_arg = positions),
                    rows.rows[0]);
}

}  // namespace

bool looksLikeLists(std::string_view bytes) {
    if (bytes.find(';') == std::string_view::npos) return false;
    const std::size_t count = split(bytes).size();
    return count >= 2 && count <= 4;
}

RawMesh decodeLists(std::string_view bytes, const std::string& file) {
    const auto lists = split(bytes);
    RawMesh mesh;
    const NumberRows places = numbersOf(lists[0], bytes, file);
    mesh.positions = vectorsOf<3, glm::dvec3>(places, message<"part.positions">());
    for (std::size_t i = 0; i + 2 < places.values.size(); i += 3)
        placeAt(places, places.rows[0], &places.values[i]);
    const NumberRows indices = numbersOf(lists[1], bytes, file);
    const double base =
        indexBase(indices.values.data(), indices.values.data() + indices.values.size(),
                  mesh.positions.size());
    for (const double value : indices.values)
        mesh.indices.push_back(
            indexIn(indices, indices.rows[0], value - base, mesh.positions.size()));
    if (mesh.indices.size() % 3 != 0)
        indices.refuse(message<"mesh.truncated/indices">("count"_arg = mesh.indices.size()),
                       indices.rows[0]);
    checkTriangles(mesh.indices.size() / 3, file);
    if (lists.size() > 2) {
        const NumberRows rows = numbersOf(lists[2], bytes, file);
        mesh.normals = vectorsOf<3, glm::vec3>(rows, message<"part.normals">());
        checkAsLong(rows, mesh.normals, mesh.positions.size(), message<"part.normals">());
    }
    if (lists.size() > 3) {
        const NumberRows rows = numbersOf(lists[3], bytes, file);
        mesh.uvs = vectorsOf<2, glm::dvec2>(rows, message<"part.uvs">());
        checkAsLong(rows, mesh.uvs, mesh.positions.size(), message<"part.uvs">());
    }
    return mesh;
}

}  // namespace farol::generator::io
