#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>

#include "core/text.h"
#include "generator/io/formats.h"
#include "generator/messages.h"

namespace farol::generator::io {
namespace {

constexpr std::size_t kStlHeader = 84;  ///< bytes: a remark of 80, and the number of triangles
constexpr std::size_t kTriangle = 50;   ///< bytes: normal, three corners, two of attributes
constexpr std::size_t kNormal = 12;     ///< bytes

std::uint32_t wordAt(std::string_view bytes, std::size_t at) {  // little-endian
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 4; ++k)
        word |= std::uint32_t{static_cast<unsigned char>(bytes[at + k])} << (8 * k);
    return word;
}

/// True if a file has the length in its head: then it is binary, even if it begins with "solid".
bool hasItsLength(std::string_view bytes) {
    return bytes.size() >= kStlHeader &&
           bytes.size() == kStlHeader + kTriangle * std::size_t{wordAt(bytes, kStlHeader - 4)};
}

/// "solid", in any case and after blanks, then a "facet", and no zero byte as in binary files.
bool isText(std::string_view bytes) {
    constexpr std::size_t kLooked = 1024;  // bytes: the name after "solid" may be long
    const std::string start = lowerCase(bytes.substr(0, kLooked));
    const std::size_t word = start.find_first_not_of(" \t\r\n");
    return word != std::string::npos && start.compare(word, 5, "solid") == 0 &&
           start.find("facet") != std::string::npos && start.find('\0') == std::string::npos;
}

/// Where the numbers at the start of a line end: at the next word, which "nan" and "inf" are not.
std::size_t numbersEnd(std::string_view text) {
    constexpr std::string_view kBetween = " \t\r,";
    std::size_t at = 0;
    while ((at = text.find_first_not_of(kBetween, at)) != std::string_view::npos) {
        const char c = lowerCase(text[at]);
        if (c >= 'a' && c <= 'z' && c != 'n' && c != 'i') return at;
        at = std::min(text.find_first_of(kBetween, at), text.size());
    }
    return text.size();
}

/// Every three positions are a triangle. The facets' normals are not used: they are the faces'
/// own where they are right, and repair.h computes those.
RawMesh soup(RawMesh mesh, const std::string& fileName) {
    if (mesh.positions.empty()) throw Error(message<"mesh.empty/triangles">(), {fileName, 0, 0});
    checkTriangles(mesh.positions.size() / 3, fileName);
    mesh.indices.resize(mesh.positions.size());
    std::iota(mesh.indices.begin(), mesh.indices.end(), 0U);
    return mesh;
}

RawMesh decodeBinaryStl(std::string_view bytes, const std::string& fileName) {
    const std::size_t header = wordAt(bytes, kStlHeader - 4);
    const std::size_t held = (bytes.size() - kStlHeader) / kTriangle;
    // Some programs leave the count 0; a file that is cut off holds less than it.
    const std::size_t triangles = header == 0 ? held : std::min(header, held);
    checkTriangles(triangles, fileName);
    RawMesh mesh;
    if (header != triangles)
        mesh.findings.push_back(
            diagnosticOf(Severity::warning,
                         message<"mesh.count-wrong/stl">("count"_arg = header, "held"_arg = held),
                         {fileName, 0, 0}));
    const std::size_t rest = bytes.size() - kStlHeader - kTriangle * triangles;
    if (rest > 0) mesh.leftOut["bytes after the last triangle"] += rest;
    mesh.positions.resize(3 * triangles);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const std::size_t at = kStlHeader + kTriangle * (i / 3) + kNormal + 12 * (i % 3);
        for (int k = 0; k < 3; ++k) {
            const float value =
                std::bit_cast<float>(wordAt(bytes, at + 4 * static_cast<std::size_t>(k)));
            if (!(std::abs(double{value}) <= kMaxCoordinate))
                throw Error(message<"mesh.number/stored">(), {fileName, 0, 0});
            mesh.positions[i][k] = value;
        }
    }
    return soup(std::move(mesh), fileName);
}

}  // namespace

bool looksLikeStl(std::string_view bytes, const std::string& fileName) {
    return hasItsLength(bytes) || isText(bytes) ||
           (fileEnding(fileName) == "stl" && bytes.size() >= kStlHeader + kTriangle &&
            bytes.find('\0') != std::string_view::npos);
}

RawMesh decodeStl(std::string_view bytes, const std::string& fileName) {
    if (hasItsLength(bytes) || !isText(bytes)) return decodeBinaryStl(bytes, fileName);
    RawMesh mesh;
    int line = 0;
    constexpr std::string_view kVertex = "vertex";
    while (!bytes.empty()) {
        ++line;
        const std::size_t end = std::min(bytes.find('\n'), bytes.size());
        std::string_view text = bytes.substr(0, end);
        bytes.remove_prefix(std::min(end + 1, bytes.size()));
        // Of "facet normal", "outer loop", "vertex" and their ends only one has a place. All of
        // them may stand in one line.
        for (std::size_t column = 0; !text.empty();) {
            const std::size_t at = std::min(text.find_first_not_of(" \t\r,"), text.size());
            const std::size_t stop = std::min(text.find_first_of(" \t\r,", at), text.size());
            const bool isVertex = sameWord(text.substr(at, stop - at), kVertex);
            column += stop;
            text.remove_prefix(stop);
            if (!isVertex) continue;
            const NumberRows rows = parseRows(text.substr(0, numbersEnd(text)), fileName, line,
                                              static_cast<int>(column) + 1);
            if (rows.values.size() != 3)
                rows.refuse(message<"mesh.syntax/stl-vertex">("count"_arg = rows.values.size()),
                            rows.rows[0]);
            checkCounts(mesh.positions.size() + 1, 0, fileName);
            mesh.positions.push_back(placeAt(rows, rows.rows[0], rows.values.data()));
        }
    }
    if (mesh.positions.size() % 3 != 0)
        throw Error(message<"mesh.truncated/facet">(), {fileName, line, 1});
    return soup(std::move(mesh), fileName);
}

}  // namespace farol::generator::io
