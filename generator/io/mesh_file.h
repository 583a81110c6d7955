#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "generator/mesh.h"

/// Mesh files in and out.
namespace farol::generator::io {

/// The formats of `encodeMesh`: our blank-line-separated text, Wavefront OBJ, ascii PLY, and our
/// binary form (binary.h).
enum class Format { text3d, obj, ply, binary };

/// The format that a file name asks for (.3d .obj .ply .3db, any case), or nothing.
std::optional<Format> formatOf(const std::string& fileName);

/// The file's bytes. Floats are written shortest such that they read back equal: decodeMesh of
/// the result is the same mesh. Precondition: the mesh has a triangle.
std::string encodeMesh(const Mesh& mesh, Format format);

/// Reads a mesh of any known format (also STL and OFF, which are not written). Detects the format
/// by the content, by the name only where the content is ambiguous (.tri). Computes missing
/// normals; adds a warning to `findings` for each kind of repair. Throws Error mesh.* with file and
/// line, limit.triangles over kMaxTriangles.
Mesh decodeMesh(std::string_view bytes, const std::string& fileName, Diagnostics& findings);

/// The points of a profile: a PLY file's vertices, or rows of two or three numbers. Throws mesh.*.
std::vector<glm::dvec3> decodeProfile(std::string_view bytes, const std::string& fileName);

/// Whether a file is a PLY profile to be revolved: all points in z = 0 and no faces, or one or two
/// that leave points out. False for anything that cannot be read.
bool isPlyProfile(std::string_view bytes, const std::string& fileName);

}  // namespace farol::generator::io
