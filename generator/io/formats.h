#pragma once

#include <string>
#include <string_view>

#include "generator/io/rows.h"
#include "generator/mesh.h"

/// One reader and writer a format; mesh_file.cpp chooses among them. Readers throw Error mesh.*;
/// they check indices and counts, but leave normals and winding to repair.h.
namespace farol::generator::io {

std::string encodeText3d(const Mesh& mesh);
std::string encodeObj(const Mesh& mesh);
std::string encodePly(const Mesh& mesh);
std::string encodeBinary(const Mesh& mesh);

bool looksLikeBinary(std::string_view bytes);
bool looksLikePly(std::string_view bytes);
bool looksLikeObj(std::string_view bytes);
bool looksLikeStl(std::string_view bytes);
bool looksLikeOff(std::string_view bytes);

Mesh decodeBinary(std::string_view bytes, const std::string& fileName);
Mesh decodePly(std::string_view bytes, const std::string& fileName, bool facesNeeded);
Mesh decodeObj(std::string_view bytes, const std::string& fileName);
Mesh decodeStl(std::string_view bytes, const std::string& fileName);
Mesh decodeOff(std::string_view bytes, const std::string& fileName);

/// Blocks parted by blank lines: positions, [normals], [UVs], indices.
Mesh decodeBlocks(const NumberRows& rows);
/// A first row of two counts: vertices and indices (or triangles).
Mesh decodeCounted(const NumberRows& rows);
/// A first row of one count: indices then vertices, or points, or points and normals.
Mesh decodeSingleCount(const NumberRows& rows);
/// Two to four sections, each after its count: positions, [normals], [UVs], indices.
Mesh decodeSections(const NumberRows& rows);
bool looksLikeSections(const NumberRows& rows);
/// No indices: every three vertices are a triangle. Rows before `first` are a head.
Mesh decodeSoup(const NumberRows& rows, std::size_t first = 0);
/// Coordinates alone, all in one row or each in its own, perhaps after their number.
Mesh decodeStream(const NumberRows& rows);
bool looksLikeStream(const NumberRows& rows);
/// Up to four lists, each on one line or ended by `;`: positions, indices, normals, UVs.
Mesh decodeLists(std::string_view bytes, const std::string& fileName);
bool looksLikeLists(std::string_view bytes);

/// Throws limit.triangles when `triangles` is over kMaxTriangles.
void checkTriangles(std::size_t triangles, const std::string& fileName);

}  // namespace farol::generator::io
