#pragma once

#include <string>
#include <string_view>

#include "core/error.h"
#include "generator/mesh.h"

/// Promises that hold whatever the input was; each throws Finding where one does not.
namespace farol::fuzz {

/// Codes are "family.word-word"; messages are there, without control characters and bounded;
/// places in `file` lie within `text`. Reaches the codes.
void checkDiagnostics(const Diagnostics& diagnostics, std::string_view file = {},
                      std::string_view text = {});

/// As above, and there is an error among them.
void checkError(const Error& error, std::string_view file = {}, std::string_view text = {});

/// Indices in range, whole triangles, finite numbers, unit normals, arrays of one length.
void checkMesh(const generator::Mesh& mesh);

}  // namespace farol::fuzz
