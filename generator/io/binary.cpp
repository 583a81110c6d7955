#include <bit>
#include <cmath>

#include "generator/io/formats.h"
#include "generator/messages.h"

/// Our binary form, little-endian: "FAROL3D\n", version (u32: 1), flags (u32: 1 normals, 2 UVs, 4
/// places in double, 8 colours), vertices (u32), indices (u32), then x y z each (float, or double),
/// normals, UVs, colours (four bytes each), then u32 indices, then the 64-bit FNV-1a hash of all
/// bytes before it.
namespace farol::generator::io {
namespace {

constexpr std::string_view kMagic = "FAROL3D\n";
constexpr std::uint32_t kVersion = 1, kNormals = 1, kUvs = 2, kDoubles = 4, kColors = 8;
constexpr std::size_t kHeader = 24, kChecksum = 8;

std::uint64_t checksum(std::string_view bytes) {
    std::uint64_t hash = 14695981039346656037U;
    for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
    return hash;
}

template <class Integer>
void put(std::string& out, Integer value) {
    for (std::size_t i = 0; i < sizeof(Integer); ++i)
        out += static_cast<char>(value >> (8 * i) & 0xFFU);
}

template <class Integer>
Integer get(std::string_view& bytes) {
    Integer value = 0;
    for (std::size_t i = 0; i < sizeof(Integer); ++i)
        value |= static_cast<Integer>(Integer{static_cast<unsigned char>(bytes[i])} << (8 * i));
    bytes.remove_prefix(sizeof(Integer));
    return value;
}

template <int N, class Vector>
void putAll(std::string& out, const std::vector<Vector>& list) {
    for (const Vector& value : list)
        for (int k = 0; k < N; ++k) put(out, std::bit_cast<std::uint32_t>(value[k]));
}

double getNumber(std::string_view& bytes, bool isDouble) {
    if (isDouble) return std::bit_cast<double>(get<std::uint64_t>(bytes));
    return std::bit_cast<float>(get<std::uint32_t>(bytes));
}

template <int N, class Vector>
void getAll(std::string_view& bytes, std::size_t count, std::vector<Vector>& list,
            const std::string& file, bool finite, bool isDouble = false) {
    list.resize(count);
    for (Vector& value : list) {
        for (int k = 0; k < N; ++k) {
            const double number = getNumber(bytes, isDouble);
            if (finite && !(std::abs(number) <= kMaxCoordinate))
                throw Error(message<"mesh.number/stored">(), {file, 0, 0});
            value[k] = static_cast<typename Vector::value_type>(number);
        }
    }
}

}  // namespace

std::string encodeBinary(const Mesh& mesh) {
    std::string out(kMagic);
    put(out, kVersion);
    const bool isFar = mesh.origin() != glm::dvec3(0.0);
    put(out, (mesh.normals().empty() ? 0 : kNormals) | (mesh.uvs().empty() ? 0 : kUvs) |
                 (isFar ? kDoubles : 0) | (mesh.colors().empty() ? 0 : kColors));
    put(out, static_cast<std::uint32_t>(mesh.positions().size()));
    put(out, static_cast<std::uint32_t>(mesh.indices().size()));
    if (isFar) {
        for (std::size_t i = 0; i < mesh.positions().size(); ++i)
            for (int k = 0; k < 3; ++k) put(out, std::bit_cast<std::uint64_t>(mesh.place(i)[k]));
    } else {
        putAll<3>(out, mesh.positions());
    }
    putAll<3>(out, mesh.normals());
    putAll<2>(out, mesh.uvs());
    for (const glm::u8vec4& color : mesh.colors())
        for (int k = 0; k < 4; ++k) put(out, color[k]);
    for (const std::uint32_t index : mesh.indices()) put(out, index);
    put(out, checksum(out));
    return out;
}

bool looksLikeBinary(std::string_view bytes) { return bytes.substr(0, kMagic.size()) == kMagic; }

RawMesh decodeBinary(std::string_view bytes, const std::string& fileName) {
    const auto fail = [&fileName](Message message) {
        throw Error(std::move(message), {fileName, 0, 0});
    };
    if (bytes.size() < kHeader + kChecksum) fail(message<"mesh.truncated/binary">());
    std::string_view rest = bytes.substr(kMagic.size());
    const auto version = get<std::uint32_t>(rest), flags = get<std::uint32_t>(rest);
    const std::uint64_t vertices = get<std::uint32_t>(rest), indices = get<std::uint32_t>(rest);
    if (version != kVersion)
        fail(message<"mesh.format/version">("version"_arg = version, "expected"_arg = kVersion));
    if (flags > (kNormals | kUvs | kDoubles | kColors)) fail(message<"mesh.format/binary">());
    const bool isDouble = (flags & kDoubles) != 0;
    const std::uint64_t floats = (isDouble ? 6U : 3U) + ((flags & kNormals) != 0 ? 3U : 0) +
                                 ((flags & kUvs) != 0 ? 2U : 0) + ((flags & kColors) != 0 ? 1U : 0);
    const std::uint64_t expected = kHeader + 4 * (floats * vertices + indices) + kChecksum;
    if (bytes.size() != expected)
        fail(message<"mesh.truncated/binary-length">("bytes"_arg = bytes.size(),
                                                     "expected"_arg = expected));
    std::string_view tail = bytes.substr(bytes.size() - kChecksum);
    if (checksum(bytes.substr(0, bytes.size() - kChecksum)) != get<std::uint64_t>(tail))
        fail(message<"mesh.checksum">());
    if (indices % 3 != 0) fail(message<"mesh.truncated/indices">("count"_arg = indices));
    if (indices == 0) fail(message<"mesh.empty/triangles">());
    checkTriangles(indices / 3, fileName);
    RawMesh mesh;
    getAll<3>(rest, vertices, mesh.positions, fileName, true, isDouble);
    // Normals that are no numbers are repaired later, as in every other format.
    if ((flags & kNormals) != 0) getAll<3>(rest, vertices, mesh.normals, fileName, false);
    if ((flags & kUvs) != 0) getAll<2>(rest, vertices, mesh.uvs, fileName, true);
    mesh.colors.resize((flags & kColors) != 0 ? vertices : 0);
    for (glm::u8vec4& color : mesh.colors) {
        for (int k = 0; k < 3; ++k) color[k] = get<std::uint8_t>(rest);
        color.a = 255;
        rest.remove_prefix(1);
    }
    mesh.indices.resize(indices);
    for (std::uint32_t& index : mesh.indices) {
        index = get<std::uint32_t>(rest);
        if (index >= vertices)
            fail(message<"mesh.index/range">("index"_arg = index, "count"_arg = vertices));
    }
    return mesh;
}

}  // namespace farol::generator::io
