#include <bit>
#include <cmath>
#include <numeric>

#include "generator/io/formats.h"

namespace farol::generator::io {
namespace {

constexpr std::size_t kFloatBytes = 4;                  ///< bytes
constexpr std::size_t kPlacesBytes = 9 * kFloatBytes;   ///< bytes of a triangle: places
constexpr std::size_t kFullBytes = 24 * kFloatBytes;    ///< with normals and texture coordinates
constexpr std::size_t kNormalBytes = 18 * kFloatBytes;  ///< with normals

std::uint32_t floatWordAt(std::string_view bytes, std::size_t word) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < kFloatBytes; ++k)
        value |= std::uint32_t{static_cast<unsigned char>(bytes[kFloatBytes * word + k])}
                 << (8 * k);
    return value;
}

float rawFloatAt(std::string_view bytes, std::size_t word) {
    return std::bit_cast<float>(floatWordAt(bytes, word));
}

/// The numbers without the count that may stand before them.
std::string_view withoutCount(std::string_view bytes) {
    if (bytes.size() % kPlacesBytes != kFloatBytes) return bytes;
    const double headCount = floatWordAt(bytes, 0);
    const auto floats = static_cast<double>(bytes.size() / kFloatBytes - 1);
    for (const double one : {1.0, 3.0, 9.0, 6.0, 8.0, 18.0, 24.0})  // a number, vertex or triangle
        if (headCount * one == floats) return bytes.substr(kFloatBytes);
    return bytes;
}

/// True where three floats from `at` on in every `step` have unit length.
bool areNormals(std::string_view bytes, std::size_t at, std::size_t step) {
    const std::size_t floats = bytes.size() / kFloatBytes;
    for (std::size_t i = at; i + 2 < floats; i += step) {
        double squared = 0;
        for (std::size_t k = 0; k < 3; ++k)
            squared += double{rawFloatAt(bytes, i + k)} * double{rawFloatAt(bytes, i + k)};
        if (!(std::abs(squared - 1.0) < 0.01)) return false;
    }
    return true;
}

bool isPlausible(double size) { return size < 1e12 && (size == 0.0 || size > 1e-24); }

double rawDoubleAt(std::string_view bytes, std::size_t index) {
    const std::uint64_t low = floatWordAt(bytes, 2 * index),
                        high = floatWordAt(bytes, 2 * index + 1);
    return std::bit_cast<double>(high << 32U | low);
}

bool areFloats(std::string_view bytes) {
    for (std::size_t i = 0; i < bytes.size() / kFloatBytes; ++i)
        if (!isPlausible(std::abs(double{rawFloatAt(bytes, i)}))) return false;
    return true;
}

/// Doubles have low words that are all 0 (round numbers) or look like no floats.
bool areDoubles(std::string_view bytes) {
    if (bytes.empty() || bytes.size() % (2 * kPlacesBytes) != 0) return false;
    bool round = true;
    for (std::size_t i = 0; i < bytes.size() / 8; ++i) {
        if (!isPlausible(std::abs(rawDoubleAt(bytes, i)))) return false;
        round = round && floatWordAt(bytes, 2 * i) == 0;
    }
    return round || !areFloats(bytes);
}

/// Two counts, vertices of 3, 6 or 8 floats, and indices; 0 floats a vertex: something else.
struct CountedFloats {
    std::size_t width = 0, vertices = 0, indices = 0;
};

CountedFloats countedFloats(std::string_view bytes) {
    if (bytes.size() < 8 + kPlacesBytes + 12) return {};
    const std::uint64_t vertices = floatWordAt(bytes, 0), indices = floatWordAt(bytes, 1);
    if (vertices < 3 || indices < 3 || indices % 3 != 0) return {};
    for (const std::uint64_t width : {3U, 6U, 8U}) {
        if (bytes.size() != 8 + kFloatBytes * (width * vertices + indices)) continue;
        const std::string_view floats = bytes.substr(8, kFloatBytes * width * vertices);
        if (!areFloats(floats)) continue;
        return {static_cast<std::size_t>(width), static_cast<std::size_t>(vertices),
                static_cast<std::size_t>(indices)};
    }
    return {};
}

bool isPlainText(std::string_view bytes) {
    for (const char c : bytes.substr(0, 256))
        if ((c < ' ' || c > '~') && c != '\t' && c != '\r' && c != '\n') return false;
    return true;
}

/// Vertices of `width` floats from the word `first` on.
void appendFloats(std::string_view bytes, std::size_t first, std::size_t width,
                  std::size_t vertices, RawMesh& mesh) {
    for (std::size_t i = 0; i < vertices; ++i) {
        const auto at = [&](std::size_t k) { return rawFloatAt(bytes, first + width * i + k); };
        mesh.positions.emplace_back(at(0), at(1), at(2));
        if (width >= 6) mesh.normals.emplace_back(at(3), at(4), at(5));
        if (width == 8) mesh.uvs.emplace_back(at(6), at(7));
    }
}

}  // namespace

bool looksLikeFloats(std::string_view bytes) {
    if (bytes.empty() || isPlainText(bytes)) return false;
    const std::string_view floats = withoutCount(bytes);
    return countedFloats(bytes).width > 0 || areDoubles(floats) ||
           (floats.size() >= kPlacesBytes && floats.size() % kPlacesBytes == 0 &&
            areFloats(floats));
}

RawMesh decodeFloats(std::string_view bytes, const std::string& fileName) {
    RawMesh mesh;
    const CountedFloats counted = countedFloats(bytes);
    if (counted.width > 0) {
        checkCounts(counted.vertices, counted.indices / 3, fileName);
        appendFloats(bytes, 2, counted.width, counted.vertices, mesh);
        const std::size_t first = 2 + counted.width * counted.vertices;
        for (std::size_t i = 0; i < counted.indices; ++i)
            mesh.indices.push_back(floatWordAt(bytes, first + i));
        return mesh;
    }
    const std::string_view floats = withoutCount(bytes);
    const bool doubles = areDoubles(floats);
    const bool whole = !doubles && floats.size() % kFullBytes == 0 && areNormals(floats, 3, 8);
    const bool normals =
        whole || (!doubles && floats.size() % kNormalBytes == 0 && areNormals(floats, 3, 6));
    const std::size_t width = whole ? 8 : normals ? 6 : 3;
    const std::size_t vertices = floats.size() / kFloatBytes / (doubles ? 6 : width);
    checkCounts(vertices, vertices / 3, fileName);
    if (doubles)
        for (std::size_t i = 0; i < vertices; ++i)
            mesh.positions.emplace_back(rawDoubleAt(floats, 3 * i), rawDoubleAt(floats, 3 * i + 1),
                                        rawDoubleAt(floats, 3 * i + 2));
    else
        appendFloats(floats, 0, width, vertices, mesh);
    mesh.indices.resize(vertices);
    std::iota(mesh.indices.begin(), mesh.indices.end(), 0U);
    return mesh;
}

}  // namespace farol::generator::io
