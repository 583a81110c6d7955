#pragma once

#include <string>

#include "generator/call.h"
#include "generator/fineness.h"

/// What a shape's pair of files gives to the registry.
namespace farol::generator {

struct Entry {
    Shape shape;
    /// Makes the mesh; the arguments are in range and the triangles within kMaxTriangles.
    Mesh (*make)(const Call& call, const std::string& fileBytes, scene::UvLayout uv) = nullptr;
    /// The number of triangles (for a shape with a file, of the parsed file), or more.
    std::size_t (*count)(const Call& call, const std::string& fileBytes) = nullptr;
    /// What is wrong with arguments that are each in range but do not go together, or "".
    std::string (*check)(const Call& call) = nullptr;
    /// Values of the level arguments, in their order, that keep the fineness.
    std::vector<double> (*levels)(const Call& call, const std::string& fileBytes,
                                  const Fineness& fineness) = nullptr;
    /// The exact surface, where it is one of those that Surface knows.
    Surface (*surface)(const Call& call, scene::UvLayout uv) = nullptr;
};

/// The entry that `shape` belongs to. Precondition: it is one of shapes().
const Entry& entryOf(const Shape& shape);

// Ranges that the shapes share. Lengths stay where floats hold a mesh without folding it.
inline constexpr double kMinLength = 1e-6;
inline constexpr double kMaxLength = 1e9;
inline constexpr double kMaxCount = 100'000;
inline constexpr double kDefaultSlices = 32;
inline constexpr double kDefaultStacks = 16;

inline Argument lengthArgument(std::string name, std::string help) {
    return {std::move(name), false, kMinLength, kMaxLength, std::move(help)};
}

inline Argument levelArgument(std::string name, double min, double fallback, std::string help) {
    return {std::move(name), true, min, kMaxCount, std::move(help), fallback, true};
}

}  // namespace farol::generator
