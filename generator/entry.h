#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/message.h"
#include "generator/fineness.h"
#include "generator/mesh.h"
#include "generator/surface.h"
#include "scene/scene.h"

/// A row of the table of shapes: the program's only description of a shape.
namespace farol::generator {

using scene::ShapeCall;

enum class ArgumentRole {
    length,  ///< in the scene's units
    count,   ///< a whole number, honoured as written
    level,   ///< a whole number, fineness alone: left out or "auto", it may be chosen on demand
};

/// One argument of a shape, for the parser, messages, help, the API and the reference.
struct Argument {
    std::string name = {};  ///< "SLICES"
    ArgumentRole role = ArgumentRole::length;
    double min = 0, max = 0;  ///< inclusive range
    std::string help = {};
    double fallback = 0;  ///< the value where the argument is left out
    double usual = 1;     ///< the value for a file name that gives no size ("torus.3d")
    /// Index of the argument that this number becomes if it is the last: in "box 2 3" the 3 is
    /// DIV.
    std::optional<std::size_t> whenLast = {};

    bool isInteger() const { return role != ArgumentRole::length; }
    bool isLevel() const { return role == ArgumentRole::level; }
};

/// One shape. `required` arguments come first; the rest have defaults.
struct ShapeEntry {
    std::string name = {};
    std::vector<std::string> aliases = {};
    std::string summary = {};  ///< its geometry in one sentence
    std::vector<Argument> arguments = {};
    std::size_t required = 0;
    std::string usage = {};        ///< syntax of its arguments, where brackets cannot express it
    bool takesFile = false;        ///< the first word after the name is a profile or patch file
    std::string fileEnding = {};   ///< ".patch": files that are this shape by their names
    std::string builtinFile = {};  ///< the file where none is written, with its name as an alias
    bool isSheet = false;          ///< flat, with faces to one side only

    /// Makes the mesh; the arguments are in range and the triangles within kMaxTriangles.
    Mesh (*generate)(const ShapeCall& call, const std::string& fileBytes,
                     scene::UvLayout uv) = nullptr;
    /// The number of triangles (for a shape with a file, of the parsed file), or more.
    std::size_t (*count)(const ShapeCall& call, const std::string& fileBytes) = nullptr;
    /// True if the first two lengths are in the reverse order, which some generators write; the
    /// scene parser exchanges them with a warning. Null: there is one order.
    bool (*isExchanged)(const ShapeCall& call) = nullptr;
    /// Returns the problem of arguments that are each in range but do not go together, a message
    /// part.*; an empty message where there is none. May be null.
    Message (*check)(const ShapeCall& call) = nullptr;
    /// The bound on the mesh's error, solved for its divisions: values of the level arguments, in
    /// their order, that keep the fineness. Null where the mesh is exact.
    std::vector<double> (*bound)(const ShapeCall& call, const std::string& fileBytes,
                                 const Fineness& fineness) = nullptr;
    /// Makes a mesh that keeps the fineness, for a shape whose divisions differ by edge. Returns
    /// in `divisions` the numbers that identify the mesh. Null where the level arguments give all
    /// divisions.
    Mesh (*adapt)(const ShapeCall& call, const std::string& fileBytes, const Fineness& fineness,
                  std::vector<std::size_t>& divisions) = nullptr;
    /// The exact surface that the mesh stands for. Null where the mesh is exact, or no kind of
    /// surface has its form.
    Surface (*surface)(const ShapeCall& call, scene::UvLayout uv) = nullptr;
};

// Ranges that the shapes share. Lengths stay where floats hold a mesh without folding it.
inline constexpr double kMinLength = 1e-6;
inline constexpr double kMaxLength = 1e9;
inline constexpr double kMaxCount = 100'000;
inline constexpr double kDefaultSlices = 32;
inline constexpr double kDefaultStacks = 16;

inline Argument lengthArgument(std::string name, std::string help, double usual = 1) {
    return {
        std::move(name), ArgumentRole::length, kMinLength, kMaxLength, std::move(help), 0, usual};
}

inline Argument countArgument(std::string name, double min, double fallback, std::string help) {
    return {std::move(name), ArgumentRole::count, min, kMaxCount, std::move(help), fallback};
}

inline Argument levelArgument(std::string name, double min, double fallback, std::string help) {
    return {std::move(name), ArgumentRole::level, min, kMaxCount, std::move(help), fallback};
}

}  // namespace farol::generator
