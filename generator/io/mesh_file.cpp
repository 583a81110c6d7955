#include "generator/io/mesh_file.h"

#include "core/text.h"
#include "generator/io/formats.h"
#include "generator/io/plain_text.h"
#include "generator/io/repair.h"
#include "generator/io/sniff.h"
#include "generator/messages.h"

namespace farol::generator::io {
namespace {

/// One info for all that was left out, with counts.
void reportLeftOut(const RawMesh& raw, const std::string& file, Diagnostics& findings) {
    if (raw.leftOut.empty()) return;
    std::string list;
    for (const auto& [what, count] : raw.leftOut)
        list += (list.empty() ? "" : ", ") + std::to_string(count) + " " + what;
    findings.push_back(diagnosticOf(
        Severity::info, message<"mesh.left-out">("file"_arg = file, "list"_arg = uncut(list)),
        {file, 0, 0}));
}

}  // namespace

void checkTriangles(std::size_t triangles, const std::string& fileName) {
    checkCounts(0, triangles, fileName);
}

std::optional<Format> formatOf(const std::string& fileName) {
    const std::string ending = fileEnding(fileName);
    if (ending == "3d") return Format::text3d;
    if (ending == "obj") return Format::obj;
    if (ending == "ply") return Format::ply;
    if (ending == "3db") return Format::binary;
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
    RawMesh raw = decodeRaw(bytes, fileName);
    // Patches whose points are all one, for instance.
    if (raw.indices.empty()) throw Error(message<"mesh.empty/triangles">(), {fileName, 0, 0});
    MeshArrays arrays = settle(raw);
    checkStructure(arrays, fileName);  // repair follows the indices
    for (Diagnostic& one : raw.findings) findings.push_back(std::move(one));
    reportLeftOut(raw, fileName, findings);
    repair(arrays, raw.smooth, fileName, findings);
    return Mesh(std::move(arrays), fileName);
}

std::vector<glm::dvec3> decodeProfile(std::string_view bytes, const std::string& fileName) {
    std::vector<glm::dvec3> points;
    std::string storage;
    bytes = plainText(bytes, storage);
    if (looksLikePly(bytes)) {
        RawMesh profile = decodePly(bytes, fileName, false);
        checkCounts(profile.positions.size(), 0, fileName);
        return std::move(profile.positions);
    }
    const NumberRows rows = parseRows(bytes, fileName);
    for (const Row& row : rows.rows) {
        if (row.count != 2 && row.count != 3)
            rows.refuse(message<"mesh.syntax/profile">("count"_arg = row.count), row);
        const double at[3] = {rows.at(row)[0], rows.at(row)[1], 0.0};
        points.push_back(placeAt(rows, row, at));
    }
    return points;
}

}  // namespace farol::generator::io
