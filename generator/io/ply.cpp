#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

#include "generator/io/formats.h"
#include "generator/io/ply_header.h"
#include "generator/io/polygon.h"
#include "generator/io/writer.h"

namespace farol::generator::io {
namespace {

/// The values of a PLY's body one after the other, ascii or binary.
class Values {
  public:
    Values(std::string_view bytes, const PlyHeader& header, const std::string& file)
        : rest_(bytes.substr(header.bytes)),
          file_(file),
          encoding_(header.encoding),
          line_(header.lines + 1) {}

    double next(PlyType type) {
        const double value = encoding_ == PlyEncoding::ascii ? nextWord() : nextBinary(type);
        if (!std::isfinite(value)) fail("mesh.number", "a number is not finite");
        return value;
    }

    [[noreturn]] void fail(const char* code, const std::string& message) const {
        throw Error(code, message, {file_, encoding_ == PlyEncoding::ascii ? line_ : 0, 0});
    }

  private:
    double nextWord() {
        std::size_t at = 0;
        for (; at < rest_.size() && static_cast<unsigned char>(rest_[at]) <= ' '; ++at)
            line_ += rest_[at] == '\n' ? 1 : 0;
        rest_.remove_prefix(at);
        if (rest_.empty()) fail("mesh.truncated", "the PLY file ends too early");
        std::size_t length = 0;
        while (length < rest_.size() && static_cast<unsigned char>(rest_[length]) > ' ') ++length;
        double value = 0;
        const char* begin = rest_.data() + (rest_[0] == '+' ? 1 : 0);
        const auto [stop, failed] = std::from_chars(begin, rest_.data() + length, value);
        if (stop != rest_.data() + length || failed == std::errc::invalid_argument)
            fail("mesh.syntax", "expected a number");
        if (failed != std::errc()) fail("mesh.number", "a number is out of range");
        rest_.remove_prefix(length);
        return value;
    }

    template <class Integer>
    Integer raw() {
        Integer value = 0;
        for (std::size_t i = 0; i < sizeof(Integer); ++i) {
            const std::size_t at =
                encoding_ == PlyEncoding::littleEndian ? sizeof(Integer) - 1 - i : i;
            value = static_cast<Integer>(static_cast<std::uint64_t>(value) << 8U |
                                         static_cast<unsigned char>(rest_[at]));
        }
        rest_.remove_prefix(sizeof(Integer));
        return value;
    }

    double nextBinary(PlyType type) {
        if (rest_.size() < plySize(type)) fail("mesh.truncated", "the PLY file ends too early");
        switch (type) {
            case PlyType::int8:
                return static_cast<std::int8_t>(raw<std::uint8_t>());
            case PlyType::uint8:
                return raw<std::uint8_t>();
            case PlyType::int16:
                return static_cast<std::int16_t>(raw<std::uint16_t>());
            case PlyType::uint16:
                return raw<std::uint16_t>();
            case PlyType::int32:
                return static_cast<std::int32_t>(raw<std::uint32_t>());
            case PlyType::uint32:
                return raw<std::uint32_t>();
            case PlyType::float32:
                return std::bit_cast<float>(raw<std::uint32_t>());
            case PlyType::float64:
                return std::bit_cast<double>(raw<std::uint64_t>());
        }
        fail("mesh.syntax", "unknown PLY type");
    }

    std::string_view rest_;
    const std::string& file_;
    PlyEncoding encoding_;
    int line_;
};

/// Which of x y z nx ny nz u v a property is, or -1.
int slotOf(const PlyProperty& property) {
    static const std::array<std::vector<const char*>, 8> kNames{
        {{"x"},
         {"y"},
         {"z"},
         {"nx"},
         {"ny"},
         {"nz"},
         {"u", "s", "texture_u", "texture_s"},
         {"v", "t", "texture_v", "texture_t"}}};
    if (property.list) return -1;
    for (std::size_t i = 0; i < kNames.size(); ++i)
        for (const char* name : kNames[i])
            if (property.name == name) return static_cast<int>(i);
    return -1;
}

/// A list's length, which must fit into a face or be skipped.
std::size_t listLength(Values& values, const PlyProperty& property) {
    constexpr double kLongest = 1e9;
    const double length = values.next(property.lengthType);
    if (!isCount(length) || length > kLongest)
        values.fail("mesh.count", "a list's length is no whole number in range");
    return static_cast<std::size_t>(length);
}

void readVertices(Values& values, const PlyElement& element, Mesh& mesh) {
    std::vector<int> slots;
    unsigned have = 0;
    for (const PlyProperty& property : element.properties) {
        slots.push_back(slotOf(property));
        if (slots.back() >= 0) have |= 1U << static_cast<unsigned>(slots.back());
    }
    if ((have & 7U) != 7U) values.fail("mesh.format", "the PLY vertices have no x, y and z");
    const bool normals = (have & 0x38U) == 0x38U, uvs = (have & 0xC0U) == 0xC0U;
    for (std::size_t i = 0; i < element.count; ++i) {
        std::array<float, 8> v{};
        for (std::size_t k = 0; k < slots.size(); ++k) {
            const PlyProperty& property = element.properties[k];
            std::size_t length = property.list ? listLength(values, property) : 1;
            for (; length > 0; --length) {
                const double value = values.next(property.type);
                if (slots[k] < 0) continue;
                if (std::abs(value) > kMaxCoordinate)
                    values.fail("mesh.number", "a number is beyond 1e18");
                v[static_cast<std::size_t>(slots[k])] = static_cast<float>(value);
            }
        }
        mesh.positions.emplace_back(v[0], v[1], v[2]);
        if (normals) mesh.normals.emplace_back(v[3], v[4], v[5]);
        if (uvs) mesh.uvs.emplace_back(v[6], v[7]);
    }
}

void readFaces(Values& values, const PlyElement& element, Mesh& mesh, const std::string& file) {
    std::vector<std::uint32_t> face;
    std::vector<glm::vec3> places;
    std::vector<FaceTriangle> triangles;
    for (std::size_t i = 0; i < element.count; ++i) {
        for (const PlyProperty& property : element.properties) {
            std::size_t length = property.list ? listLength(values, property) : 1;
            const bool corners = property.list && (property.name == "vertex_indices" ||
                                                   property.name == "vertex_index");
            if (corners && length < 3) values.fail("mesh.syntax", "a face needs three corners");
            face.clear();
            places.clear();
            for (std::size_t k = 0; k < length; ++k) {
                const double value = values.next(property.type);
                if (!corners) continue;
                if (!isCount(value) || value >= static_cast<double>(mesh.positions.size()))
                    values.fail("mesh.index", "a face's index is out of range: there are " +
                                                  std::to_string(mesh.positions.size()) +
                                                  " vertices");
                const auto at = static_cast<std::uint32_t>(value);
                face.push_back(at);
                places.push_back(mesh.positions[at]);
                if (k >= 2) checkTriangles(mesh.triangles() + k - 1, file);
            }
            if (!corners) continue;
            triangulate(places, triangles);
            for (const auto& [a, b, c] : triangles)
                mesh.indices.insert(mesh.indices.end(), {face[a], face[b], face[c]});
        }
    }
}

void skip(Values& values, const PlyElement& element) {
    for (std::size_t i = 0; i < element.count; ++i)
        for (const PlyProperty& property : element.properties)
            for (std::size_t n = property.list ? listLength(values, property) : 1; n > 0; --n)
                values.next(property.type);
}

}  // namespace

std::string encodePly(const Mesh& mesh) {
    Writer out;
    out.text("ply\nformat ascii 1.0\nelement vertex ");
    out.number(mesh.positions.size());
    out.text("\nproperty float x\nproperty float y\nproperty float z\n");
    if (!mesh.normals.empty())
        out.text("property float nx\nproperty float ny\nproperty float nz\n");
    if (!mesh.uvs.empty()) out.text("property float u\nproperty float v\n");
    out.text("element face ");
    out.number(mesh.triangles());
    out.text("\nproperty list uchar uint vertex_indices\nend_header\n");
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const auto add = [&out, first = true](float value) mutable {
            if (!first) out.text(" ");
            out.number(value);
            first = false;
        };
        auto put = add;
        for (int k = 0; k < 3; ++k) put(mesh.positions[i][k]);
        for (int k = 0; k < 3 && !mesh.normals.empty(); ++k) put(mesh.normals[i][k]);
        for (int k = 0; k < 2 && !mesh.uvs.empty(); ++k) put(mesh.uvs[i][k]);
        out.text("\n");
    }
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        out.text(i % 3 == 0 ? "3 " : " ");
        out.number(mesh.indices[i]);
        if (i % 3 == 2) out.text("\n");
    }
    return out.take();
}

bool looksLikePly(std::string_view bytes) {
    return bytes.substr(0, 4) == "ply\n" || bytes.substr(0, 5) == "ply\r\n";
}

Mesh decodePly(std::string_view bytes, const std::string& fileName, bool facesNeeded) {
    const PlyHeader header = parsePlyHeader(bytes, fileName);
    Values values(bytes, header, fileName);
    Mesh mesh;
    for (const PlyElement& element : header.elements) {
        if (element.name == "vertex")
            readVertices(values, element, mesh);
        else if (element.name == "face")
            readFaces(values, element, mesh, fileName);
        else
            skip(values, element);
    }
    if (mesh.positions.empty()) values.fail("mesh.empty", "the PLY file holds no vertices");
    if (facesNeeded && mesh.indices.empty())
        values.fail("mesh.empty",
                    "the PLY file holds no faces: a profile is revolved with \"revolve\"");
    return mesh;
}

}  // namespace farol::generator::io
