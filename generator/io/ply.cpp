#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

#include "core/text.h"
#include "generator/io/formats.h"
#include "generator/io/ply_header.h"
#include "generator/io/polygon.h"
#include "generator/io/writer.h"
#include "generator/messages.h"

namespace farol::generator::io {
namespace {

/// The values of a PLY's body one after the other, ascii or binary.
class Values {
  public:
    Values(std::string_view bytes, const PlyHeader& header, const std::string& file)
        : rest_(bytes.substr(header.bytes)),
          size_(bytes.size()),
          file_(file),
          encoding_(header.encoding),
          line_(header.lines + 1) {}

    /// May be NaN or infinite.
    double next(PlyType type) {
        return encoding_ == PlyEncoding::ascii ? nextWord() : nextBinary(type);
    }

    /// Throws at the line of the value read last; a binary file has bytes instead.
    [[noreturn]] void fail(Message message) const { throw Error(std::move(message), where()); }
    Location where() const { return {file_, encoding_ == PlyEncoding::ascii ? line_ : 0, 0}; }
    /// The place in a binary file, "812"; "" in a text, whose lines are counted.
    std::string byte() const {
        return encoding_ == PlyEncoding::ascii ? "" : std::to_string(size_ - rest_.size());
    }

    /// Throws at the element's line in the header.
    [[noreturn]] void fail(Message message, const PlyElement& element) const {
        throw Error(std::move(message), {file_, element.line, 1});
    }

  private:
    double nextWord() {
        std::size_t at = 0;
        for (; at < rest_.size() && static_cast<unsigned char>(rest_[at]) <= ' '; ++at)
            line_ += rest_[at] == '\n' ? 1 : 0;
        rest_.remove_prefix(at);
        if (rest_.empty()) fail(message<"mesh.truncated/ply">("byte"_arg = byte()));
        std::size_t length = 0;
        while (length < rest_.size() && static_cast<unsigned char>(rest_[length]) > ' ') ++length;
        const std::optional<double> value = numberOf(rest_.substr(0, length), {file_, line_, 0});
        if (!value) fail(message<"mesh.syntax/ply-number">("value"_arg = rest_.substr(0, length)));
        rest_.remove_prefix(length);
        return *value;
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
        if (rest_.size() < plySize(type)) fail(message<"mesh.truncated/ply">("byte"_arg = byte()));
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
        throw std::logic_error("a PLY type that typeOf does not return");
    }

    std::string_view rest_;
    std::size_t size_;  ///< of the whole file, bytes
    const std::string& file_;
    PlyEncoding encoding_;
    int line_;
};

/// A vertex's or face's numbers that are drawn; others are skipped.
constexpr std::size_t kSlots = 11;
constexpr unsigned kPlaceBits = 7U, kNormalBits = 0x38U, kUvBits = 0xC0U, kColorBits = 0x700U;

/// Which of x y z nx ny nz u v red green blue a property is, or -1.
int slotOf(const PlyProperty& property) {
    static const std::array<std::vector<const char*>, kSlots> kNames{
        {{"x"},
         {"y"},
         {"z"},
         {"nx", "normal_x"},
         {"ny", "normal_y"},
         {"nz", "normal_z"},
         {"u", "s", "texture_u", "texture_s"},
         {"v", "t", "texture_v", "texture_t"},
         {"red", "r", "diffuse_red"},
         {"green", "g", "diffuse_green"},
         {"blue", "b", "diffuse_blue"}}};
    if (property.list) return -1;
    for (std::size_t i = 0; i < kNames.size(); ++i)
        for (const char* name : kNames[i])
            if (property.name == name) return static_cast<int>(i);
    return -1;
}

/// The slots of an element's properties, and which there are.
struct Slots {
    std::vector<int> of;
    unsigned have = 0;
    double most = 255.0;  ///< a colour's full value: 1 for floats, else that of the type

    explicit Slots(const PlyElement& element) {
        for (const PlyProperty& property : element.properties) {
            const int slot = slotOf(property);
            of.push_back(slot);
            if (slot >= 0) have |= 1U << static_cast<unsigned>(slot);
            if (slot < 8) continue;
            most = property.type >= PlyType::float32                                     ? 1.0
                   : property.type == PlyType::int16 || property.type == PlyType::uint16 ? 65535.0
                                                                                         : 255.0;
        }
    }
    bool hasColor() const { return (have & kColorBits) == kColorBits; }
    glm::u8vec4 color(const std::array<double, kSlots>& v) const {
        return {channelOf(v[8], most), channelOf(v[9], most), channelOf(v[10], most), 255};
    }
};

bool isCornerList(const PlyProperty& property) {
    return property.list && (property.name == "vertex_indices" || property.name == "vertex_index");
}

/// A list's length, which must fit into a face or be skipped.
std::size_t listLength(Values& values, const PlyProperty& property) {
    constexpr double kMaxLength = 1e9;
    const double length = values.next(property.lengthType);
    if (!isCount(length) || length > kMaxLength)
        values.fail(message<"mesh.count/list">("value"_arg = length, "most"_arg = kMaxLength,
                                               "byte"_arg = values.byte()));
    return static_cast<std::size_t>(length);
}

void readVertices(Values& values, const PlyElement& element, RawMesh& mesh) {
    const Slots slots(element);
    if ((slots.have & kPlaceBits) != kPlaceBits)
        values.fail(message<"mesh.format/places">(), element);
    const bool normals = (slots.have & kNormalBits) == kNormalBits;
    const bool uvs = (slots.have & kUvBits) == kUvBits;
    for (std::size_t i = 0; i < element.count; ++i) {
        std::array<double, kSlots> v{};
        for (std::size_t k = 0; k < slots.of.size(); ++k) {
            const PlyProperty& property = element.properties[k];
            std::size_t length = property.list ? listLength(values, property) : 1;
            for (; length > 0; --length) {
                const double value = values.next(property.type);
                if (slots.of[k] < 0) continue;
                if (std::abs(value) > kMaxCoordinate || (slots.of[k] < 3 && std::isnan(value)))
                    values.fail(message<"mesh.number/ply">("value"_arg = value,
                                                           "byte"_arg = values.byte()));
                v[static_cast<std::size_t>(slots.of[k])] = value;
            }
        }
        mesh.positions.emplace_back(v[0], v[1], v[2]);
        if (normals) mesh.normals.push_back(vec3At(&v[3]));
        if (uvs) mesh.uvs.emplace_back(v[6], v[7]);
        if (slots.hasColor()) mesh.colors.push_back(slots.color(v));
    }
}

/// The faces of a PLY, and its triangle strips.
class FaceReader {
  public:
    FaceReader(Values& values, RawMesh& mesh, const std::string& file)
        : values_(values), mesh_(mesh), file_(file) {}

    std::size_t count() const { return count_; }  ///< faces that were read
    void readFaces(const PlyElement& element) {
        const std::vector<PlyProperty> properties = propertiesOf(element);
        const PlyElement known{element.name, element.count, properties, element.line};
        const Slots slots(known);
        for (std::size_t i = 0; i < element.count; ++i, ++count_) {
            std::array<double, kSlots> v{};
            const std::size_t before = mesh_.triangles();
            for (std::size_t k = 0; k < properties.size(); ++k) {
                const PlyProperty& property = properties[k];
                if (isCornerList(property)) {
                    if (readCorners(property)) addFace();
                    continue;
                }
                std::size_t length = property.list ? listLength(values_, property) : 1;
                for (; length > 0; --length) {
                    const double value = values_.next(property.type);
                    if (slots.of[k] >= 0) v[static_cast<std::size_t>(slots.of[k])] = value;
                }
            }
            if (slots.hasColor())
                colors_.resize(colors_.size() + mesh_.triangles() - before, slots.color(v));
        }
    }

    /// Runs of corners of which every three in a row are a triangle; -1 ends a run.
    void readStrips(const PlyElement& element) {
        for (std::size_t i = 0; i < element.count; ++i)
            for (const PlyProperty& property : element.properties) {
                std::size_t length = property.list ? listLength(values_, property) : 1;
                std::size_t run = 0;
                std::array<std::uint32_t, 2> last{};
                for (; length > 0; --length) {
                    const double value = values_.next(property.type);
                    if (!isCornerList(property)) continue;
                    if (value == -1.0 || !isCorner(value)) {
                        if (value != -1.0)
                            skipFace("corners of strips out of range", outOfRange(value));
                        run = 0;
                        continue;
                    }
                    const auto corner = static_cast<std::uint32_t>(value);
                    if (run >= 2) addTriangle(run % 2 == 0, last[0], last[1], corner);
                    last = {last[1], corner};
                    ++run;
                }
            }
    }

    /// Throws the error of the first invalid face if no face is left.
    void finish() {
        if (mesh_.indices.empty() && problem_) throw Error(Diagnostics{*problem_});
        if (colors_.size() == mesh_.triangles() && !colors_.empty()) splitByColor(mesh_, colors_);
    }

  private:
    /// Returns the properties of an element. Home-made exporters leave out those of faces: then
    /// assumes a list "vertex_indices" and adds a warning.
    std::vector<PlyProperty> propertiesOf(const PlyElement& element) {
        std::vector<PlyProperty> properties = element.properties;
        if (element.count > 0 && properties.empty()) {
            PlyProperty corners;
            corners.name = "vertex_indices";
            corners.type = PlyType::int32;
            corners.list = true;
            properties.push_back(corners);
            mesh_.findings.push_back(
                diagnosticOf(Severity::warning, message<"mesh.assumed">(), {file_, 0, 0}));
        }
        const auto lists = std::count_if(properties.begin(), properties.end(), isCornerList);
        if (element.count > 0 && lists != 1)
            values_.fail(message<"mesh.format/corners">("count"_arg = lists), element);
        return properties;
    }

    bool isCorner(double value) const {
        return isCount(value) && value < static_cast<double>(mesh_.positions.size());
    }

    Message outOfRange(double index) const {
        return message<"mesh.index/ply">("index"_arg = index, "count"_arg = mesh_.positions.size(),
                                         "byte"_arg = values_.byte());
    }

    /// Counts a loss, and keeps the first problem at the number read last.
    void skipFace(const char* kind, Message problem) {
        ++mesh_.leftOut[kind];
        if (!problem_)
            problem_ = diagnosticOf(Severity::error, std::move(problem), values_.where());
    }

    /// Reads the corners of a face; false where it cannot be drawn.
    bool readCorners(const PlyProperty& property) {
        const std::size_t length = listLength(values_, property);
        face_.clear();
        bool inRange = true;
        for (std::size_t k = 0; k < length; ++k) {
            const double value = values_.next(property.type);
            if (!inRange) continue;
            inRange = isCorner(value);
            if (!inRange) {
                skipFace("faces with an index out of range", outOfRange(value));
                continue;
            }
            face_.push_back(static_cast<std::uint32_t>(value));
            if (k >= 2) checkTriangles(mesh_.triangles() + k - 1, file_);
        }
        if (inRange && length < 3)
            skipFace("faces of less than three corners",
                     message<"mesh.syntax/ply-face">("byte"_arg = values_.byte()));
        return inRange && length >= 3;
    }

    void addFace() {
        places_.clear();
        for (const std::uint32_t corner : face_) places_.push_back(mesh_.positions[corner]);
        triangulate(places_, triangles_);
        for (const auto& [a, b, c] : triangles_)
            mesh_.indices.insert(mesh_.indices.end(), {face_[a], face_[b], face_[c]});
    }

    void addTriangle(bool even, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (a == b || b == c || c == a) return;  // joins two strips
        checkTriangles(mesh_.triangles() + 1, file_);
        if (!even) std::swap(a, b);
        mesh_.indices.insert(mesh_.indices.end(), {a, b, c});
    }

    Values& values_;
    RawMesh& mesh_;
    const std::string& file_;
    std::vector<std::uint32_t> face_;
    std::vector<glm::dvec3> places_;
    std::vector<FaceTriangle> triangles_;
    std::size_t count_ = 0;
    std::vector<glm::u8vec4> colors_;  ///< of triangles
    std::optional<Diagnostic> problem_;
};

/// Profiles carry a face for programs that refuse a PLY file without any: they have places alone,
/// all points are in z = 0, and two of them or more are corners of no face.
bool isProfileWithDummy(const RawMesh& mesh) {
    if (!mesh.normals.empty() || !mesh.uvs.empty() || !mesh.colors.empty()) return false;
    std::vector<bool> used(mesh.positions.size());
    for (const std::uint32_t index : mesh.indices) used[index] = true;
    const auto count = static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
    return mesh.triangles() <= 2 && mesh.positions.size() >= 4 &&
           count + 2 <= mesh.positions.size() &&
           std::all_of(mesh.positions.begin(), mesh.positions.end(),
                       [](const glm::dvec3& p) { return p.z == 0.0; });
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
    out.number(mesh.positions().size());
    out.text(mesh.origin() == glm::dvec3(0.0)
                 ? "\nproperty float x\nproperty float y\nproperty float z\n"
                 : "\nproperty double x\nproperty double y\nproperty double z\n");
    if (!mesh.normals().empty())
        out.text("property float nx\nproperty float ny\nproperty float nz\n");
    if (!mesh.uvs().empty()) out.text("property float u\nproperty float v\n");
    if (!mesh.colors().empty())
        out.text("property uchar red\nproperty uchar green\nproperty uchar blue\n");
    out.text("element face ");
    out.number(mesh.triangles());
    out.text("\nproperty list uchar uint vertex_indices\nend_header\n");
    for (std::size_t i = 0; i < mesh.positions().size(); ++i) {
        const auto add = [&out](auto value) {
            out.text(" ");
            out.number(value);
        };
        out.place(mesh, i);
        for (int k = 0; k < 3 && !mesh.normals().empty(); ++k) add(mesh.normals()[i][k]);
        for (int k = 0; k < 2 && !mesh.uvs().empty(); ++k) add(mesh.uvs()[i][k]);
        for (int k = 0; k < 3 && !mesh.colors().empty(); ++k) add(mesh.colors()[i][k]);
        out.text("\n");
    }
    for (std::size_t i = 0; i < mesh.indices().size(); ++i) {
        out.text(i % 3 == 0 ? "3 " : " ");
        out.number(mesh.indices()[i]);
        if (i % 3 == 2) out.text("\n");
    }
    return out.take();
}

bool looksLikePly(std::string_view bytes) {
    return sameWord(bytes.substr(0, 3), "ply") && bytes.size() > 3 && isBlank(bytes[3]);
}

RawMesh decodePly(std::string_view bytes, const std::string& fileName, bool facesNeeded) {
    const PlyHeader header = parsePlyHeader(bytes, fileName);
    Values values(bytes, header, fileName);
    RawMesh mesh;
    FaceReader faces(values, mesh, fileName);
    for (const PlyElement& element : header.elements) {
        if (element.name == "vertex") {
            readVertices(values, element, mesh);
        } else if (element.name == "face") {
            try {
                faces.readFaces(element);
            } catch (const Error& error) {
                // A truncated file keeps its complete faces.
                if (error.code() != "mesh.truncated" || mesh.triangles() == 0) throw;
                mesh.findings.push_back(
                    diagnosticOf(Severity::warning,
                                 message<"mesh.count-wrong/ply">("count"_arg = element.count,
                                                                 "held"_arg = faces.count()),
                                 {fileName, 0, 0}));
                break;
            }
        } else if (element.name == "tristrips") {
            faces.readStrips(element);
        } else {
            skip(values, element);
            if (element.count > 0)
                mesh.leftOut["entries of \"" + shown(element.name) + "\""] += element.count;
        }
    }
    if (mesh.positions.empty()) values.fail(message<"mesh.empty/vertices">());
    if (!facesNeeded) return mesh;
    if (mesh.indices.empty() || isProfileWithDummy(mesh)) {
        faces.finish();
        values.fail(message<"mesh.empty/profile">());
    }
    faces.finish();
    return mesh;
}

bool isPlyProfile(std::string_view bytes, const std::string& fileName) {
    constexpr std::size_t kMaxFaces = 2;
    if (!looksLikePly(bytes)) return false;
    try {
        for (const PlyElement& element : parsePlyHeader(bytes, fileName).elements)
            if (element.name != "vertex" && element.count > kMaxFaces) return false;
        const RawMesh mesh = decodePly(bytes, fileName, false);
        if (!mesh.indices.empty()) return isProfileWithDummy(mesh);
        return mesh.positions.size() > 1 &&
               std::all_of(mesh.positions.begin(), mesh.positions.end(),
                           [](const glm::dvec3& p) { return p.z == 0.0; });
    } catch (const Error&) {
        return false;  // reported where the mesh is loaded
    }
}

}  // namespace farol::generator::io
