#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "generator/io/raw_mesh.h"
#include "generator/io/rows.h"

namespace farol::generator::io {

/// A mesh file, prepared for the readers of all forms.
struct MeshText {
    std::string_view bytes;  ///< after plainText
    const std::string& file;
    std::string ending;              ///< of its name, lower case
    std::optional<NumberRows> rows;  ///< where it holds nothing but numbers and comments
    std::optional<Error> notRows;    ///< why it does not
};

/// A form of mesh file: its recogniser and its reader. The first row of the table that recognises a
/// file reads it.
struct MeshForm {
    const char* name;
    bool (*recognise)(const MeshText& text);
    RawMesh (*read)(const MeshText& text);
};

/// Returns all forms in the order of recognition: unambiguous ones come first.
std::span<const MeshForm> meshForms();

/// The mesh of a file by the first form that recognises it. Throws Error mesh.*.
RawMesh decodeRaw(std::string_view bytes, const std::string& fileName);

/// Returns the name of that form; empty if none recognises the file.
std::string formOf(std::string_view bytes, const std::string& fileName);

}  // namespace farol::generator::io
