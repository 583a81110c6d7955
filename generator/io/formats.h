#pragma once

#include <string>
#include <string_view>

#include "generator/io/raw_mesh.h"
#include "generator/io/rows.h"
#include "generator/mesh.h"

/// One reader and writer a format; sniff.cpp chooses among them. Readers throw Error mesh.*
/// with the line where they can; their meshes are checked again as a whole (mesh.h), and
/// normals and winding are left to repair.h.
namespace farol::generator::io {

std::string encodeText3d(const Mesh& mesh);
std::string encodeObj(const Mesh& mesh);
std::string encodePly(const Mesh& mesh);
std::string encodeBinary(const Mesh& mesh);

bool looksLikeBinary(std::string_view bytes);
bool looksLikePly(std::string_view bytes);
bool looksLikeObj(std::string_view bytes);
bool looksLikeStl(std::string_view bytes, const std::string& fileName);
bool looksLikeOff(std::string_view bytes, const std::string& fileName);

RawMesh decodeBinary(std::string_view bytes, const std::string& fileName);
RawMesh decodePly(std::string_view bytes, const std::string& fileName, bool facesNeeded);
RawMesh decodeObj(std::string_view bytes, const std::string& fileName);
RawMesh decodeStl(std::string_view bytes, const std::string& fileName);
RawMesh decodeOff(std::string_view bytes, const std::string& fileName);

/// Blocks parted by blank lines: positions, [normals], [UVs], indices.
RawMesh decodeBlocks(const NumberRows& rows);
/// A first row of two counts: vertices and indices (or triangles).
RawMesh decodeCounted(const NumberRows& rows);
/// A first row of one count: indices then vertices, or points, or points and normals.
RawMesh decodeSingleCount(const NumberRows& rows);
/// Two to four sections, each after its count: positions, [normals], [UVs], indices.
RawMesh decodeSections(const NumberRows& rows);
bool looksLikeSections(const NumberRows& rows);
/// No indices: every three vertices are a triangle. Rows before `first` are a head.
RawMesh decodeSoup(const NumberRows& rows, std::size_t first = 0);
/// A soup whose vertices take three rows each from `first` on: position, normal, UV. The first two
/// vertices decide: blocks of one position, one normal and one UV begin like a single one.
bool looksLikeThreeLines(const NumberRows& rows, std::size_t first = 0);
/// Coordinates alone, all in one row or each in its own, perhaps after their number.
RawMesh decodeStream(const NumberRows& rows);
bool looksLikeStream(const NumberRows& rows);
/// Up to four lists, each on one line or ended by `;`: positions, indices, normals, UVs.
RawMesh decodeLists(std::string_view bytes, const std::string& fileName);
bool looksLikeLists(std::string_view bytes);

/// Elements with numbers: <vertex x="0" y="0" z="0"/>, <triangle>...</triangle>.
RawMesh decodeElements(std::string_view bytes, const std::string& fileName);
bool looksLikeElements(std::string_view bytes);
/// Numbers behind labels: "v: 0 0 0", "VERTICES:" before rows, JSON.
RawMesh decodeLabelled(std::string_view bytes, const std::string& fileName);
bool looksLabelled(std::string_view bytes);
/// Nothing but little-endian floats, perhaps after their count: places, or places and normals and
/// texture coordinates where those have unit length.
RawMesh decodeFloats(std::string_view bytes, const std::string& fileName);
bool looksLikeFloats(std::string_view bytes);

/// Returns the three numbers from `v` on.
inline glm::vec3 vec3At(const double* v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

/// Throws limit.triangles when `triangles` is over kMaxTriangles.
void checkTriangles(std::size_t triangles, const std::string& fileName);

}  // namespace farol::generator::io
