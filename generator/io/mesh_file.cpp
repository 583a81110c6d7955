#include "generator/io/mesh_file.h"

#include <algorithm>

#include "generator/io/formats.h"
#include "generator/io/patch_file.h"
#include "generator/io/repair.h"
#include "generator/primitives/patch.h"
#include "generator/registry.h"

namespace farol::generator::io {
namespace {

/// The name's ending in lower case, with its dot.
std::string endingOf(const std::string& name) {
    const std::size_t dot = name.rfind('.');
    std::string ending = dot == std::string::npos ? "" : name.substr(dot);
    for (char& c : ending)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return ending;
}

/// Triangles of three rows each with a blank line between them, rather than blocks of lists.
bool isSpacedSoup(const NumberRows& rows) {
    std::vector<std::size_t> sizes(rows.blocks());
    for (const Row& row : rows.rows) {
        if (row.count != 3) return false;
        ++sizes[row.block];
    }
    const bool whole = std::all_of(sizes.begin(), sizes.end(), [](auto n) { return n % 3 == 0; });
    return whole && (sizes.size() > 4 || *std::max_element(sizes.begin(), sizes.end()) == 3);
}

Mesh decodeNumbers(const NumberRows& rows) {
    const std::uint32_t width = rows.rows[0].count;
    const std::size_t count = rows.rows.size();
    const auto widthOf = [&rows](std::size_t i) { return rows.rows[i].count; };
    if (looksLikeStream(rows)) return decodeStream(rows);
    if (width == 2 && count > 1) return decodeCounted(rows);
    if (width == 1 && count > 2 && widthOf(1) == 1 && widthOf(2) == 3) return decodeCounted(rows);
    if (width == 1 && looksLikeSections(rows)) return decodeSections(rows);
    if (width == 1 && count > 1) return decodeSingleCount(rows);
    const bool threeLines = count > 2 && width == 3 && widthOf(1) == 3 && widthOf(2) == 2;
    if (width == 3 && rows.blocks() > 1 && !threeLines && !isSpacedSoup(rows))
        return decodeBlocks(rows);
    return decodeSoup(rows);
}

Mesh decodePatches(std::string_view bytes, const std::string& fileName) {
    const PatchFile file = parsePatchFile(bytes, fileName);
    checkTriangles(primitives::patchTriangles(file, primitives::kDefaultPatchLevel), fileName);
    return primitives::patch(file, primitives::kDefaultPatchLevel);
}

}  // namespace

void checkTriangles(std::size_t triangles, const std::string& fileName) {
    if (triangles > kMaxTriangles)
        throw Error("limit.triangles",
                    "the mesh file \"" + fileName + "\" has more than " +
                        std::to_string(kMaxTriangles) + " triangles",
                    {fileName, 0, 0});
}

std::optional<Format> formatOf(const std::string& fileName) {
    const std::string ending = endingOf(fileName);
    if (ending == ".3d") return Format::text3d;
    if (ending == ".obj") return Format::obj;
    if (ending == ".ply") return Format::ply;
    if (ending == ".3db") return Format::binary;
    return std::nullopt;
}

std::string encodeMesh(const Mesh& mesh, Format format) {
    switch (format) {
        case Format::text3d:
            return encodeText3d(mesh);
        case Format::obj:
            return encodeObj(mesh);
        case Format::ply:
            return encodePly(mesh);
        case Format::binary:
            return encodeBinary(mesh);
    }
    return {};
}

Mesh decodeMesh(std::string_view bytes, const std::string& fileName, Diagnostics& findings) {
    Mesh mesh;
    if (looksLikeBinary(bytes))
        mesh = decodeBinary(bytes, fileName);
    else if (looksLikePly(bytes))
        mesh = decodePly(bytes, fileName, true);
    else if (looksLikeStl(bytes))
        mesh = decodeStl(bytes, fileName);
    else if (looksLikeOff(bytes))
        mesh = decodeOff(bytes, fileName);
    else if (endingOf(fileName) == ".patch")
        mesh = decodePatches(bytes, fileName);
    else if (endingOf(fileName) == ".obj" || looksLikeObj(bytes))
        mesh = decodeObj(bytes, fileName);
    else if (looksLikeLists(bytes))
        mesh = decodeLists(bytes, fileName);
    else
        mesh = decodeNumbers(parseRows(bytes, fileName));
    repair(mesh, fileName, findings);
    return mesh;
}

std::vector<glm::dvec3> decodeProfile(std::string_view bytes, const std::string& fileName) {
    std::vector<glm::dvec3> points;
    if (looksLikePly(bytes)) {
        for (const glm::vec3& p : decodePly(bytes, fileName, false).positions)
            points.emplace_back(p);
        return points;
    }
    const NumberRows rows = parseRows(bytes, fileName);
    for (const Row& row : rows.rows) {
        if (row.count != 2 && row.count != 3)
            rows.refuse("mesh.syntax", row, "a profile has two or three numbers a line");
        points.emplace_back(rows.at(row)[0], rows.at(row)[1], 0);
    }
    return points;
}

}  // namespace farol::generator::io
