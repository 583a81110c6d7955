#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace farol::generator::io {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class PlyEncoding { ascii, littleEndian, bigEndian };

std::size_t plySize(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;
    bool list = false;
    PlyType lengthType = PlyType::uint8;  ///< of a list
};

struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;
    int line = 0;  ///< of the header, from 1
    /// The fewest bytes that one of it takes in the file.
    std::size_t leastBytes(PlyEncoding encoding) const;
};

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::ascii;
    std::vector<PlyElement> elements;
    std::size_t bytes = 0;  ///< its length, up to the data
    int lines = 0;
};

/// Reads "ply ... end_header". No two elements, and no two properties of an element, have the same
/// name. Throws Error mesh.syntax, mesh.truncated; mesh.count where an element's count cannot fit
/// into the bytes that follow; limit.triangles for too many vertices.
PlyHeader parsePlyHeader(std::string_view bytes, const std::string& fileName);

}  // namespace farol::generator::io
