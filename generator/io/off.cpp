#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>

#include "core/text.h"
#include "generator/io/formats.h"
#include "generator/io/polygon.h"
#include "generator/messages.h"

namespace farol::generator::io {
namespace {

/// The parts of a vertex, by the letters before "OFF" (Geomview's order of the numbers: place,
/// normal, colour, texture coordinate).
struct OffHead {
    std::size_t length = 0;  ///< of the word, with blanks before it; 0: no word
    bool uvs = false, colors = false, normals = false, weights = false;
    std::size_t bytes = 0;
};

/// The word that OFF files begin with: [ST][C][N][4]OFF, any case; none where it is another.
OffHead headOf(std::string_view bytes) {
    OffHead head;
    std::size_t at = bytes.find_first_not_of(" \t\r\n");
    if (at == std::string_view::npos) return {};
    const std::size_t end = std::min(bytes.find_first_of(" \t\r\n#", at), bytes.size());
    std::string word = lowerCase(std::string(bytes.substr(at, std::min<std::size_t>(end - at, 8))));
    const auto drop = [&word](std::string_view prefix) {
        if (word.rfind(prefix, 0) != 0) return false;
        word.erase(0, prefix.size());
        return true;
    };
    head.uvs = drop("st");
    head.colors = drop("c");
    head.normals = drop("n");
    head.weights = drop("4");
    if (word != "off") return {};
    head.length = end;
    return head;
}

/// Numbers of a colour that begin at `v`: three or four, 0..1 or 0..255 (`most`).
glm::u8vec4 colorAt(const double* v, double most) {
    return {channelOf(v[0], most), channelOf(v[1], most), channelOf(v[2], most), 255};
}

class OffReader {
  public:
    OffReader(const NumberRows& rows, const OffHead& head) : rows_(rows), head_(head) {}

    RawMesh read() {
        const Row& head = rows_.rows[0];
        if (head.count < 2 || !isCount(rows_.at(head)[0]) || !isCount(rows_.at(head)[1]))
            rows_.refuse(message<"mesh.count/off">(), head);
        const double vertices = rows_.at(head)[0], faces = rows_.at(head)[1];
        if (vertices + faces > static_cast<double>(rows_.rows.size() - 1))
            rows_.refuse(message<"mesh.truncated/short">(), head);
        first_ = 1 + static_cast<std::size_t>(vertices);
        last_ = first_ + static_cast<std::size_t>(faces);
        for (std::size_t i = 1; i < first_; ++i) readVertex(rows_.rows[i]);
        findMost();
        for (std::size_t i = first_; i < last_; ++i) readFace(rows_.rows[i]);
        if (mesh_.indices.empty()) {
            if (problem_) throw Error(Diagnostics{*problem_});
            rows_.refuse(message<"mesh.empty/faces">("format"_arg = "OFF"), head);
        }
        if (head_.colors) takeVertexColors();
        if (anyFaceColor_) splitByColor(mesh_, faceColors_);
        return std::move(mesh_);
    }

  private:
    void readVertex(const Row& row) {
        const double* v = rows_.at(row);
        std::size_t need = 3 + (head_.weights ? 1 : 0) + (head_.normals ? 3 : 0) +
                           (head_.colors ? 3 : 0) + (head_.uvs ? 2 : 0);
        if (row.count < need)
            rows_.refuse(
                message<"mesh.syntax/off-numbers">("count"_arg = row.count, "needed"_arg = need),
                row);
        glm::dvec3 place = placeAt(rows_, row, v);
        std::size_t at = 3;
        if (head_.weights) {
            if (v[3] != 0.0) place /= v[3];
            ++at;
        }
        mesh_.positions.push_back(place);
        if (head_.normals) mesh_.normals.push_back(vec3At(v + at));
        at += head_.normals ? 3 : 0;
        colorAt_ = at;
        if (head_.uvs) mesh_.uvs.emplace_back(v[row.count - 2], v[row.count - 1]);
        // Without letters in the head: colours after the position, as many programs write them.
        const std::size_t extra = row.count - at - (head_.uvs ? 2 : 0);
        if (!head_.colors && extra > 0) ++mesh_.leftOut["numbers behind a vertex's own"];
    }

    /// Colours are 0..1, unless one of them is larger.
    void findMost() {
        const auto look = [this](const double* v, std::size_t count) {
            for (std::size_t k = 0; k < std::min<std::size_t>(count, 3); ++k)
                if (v[k] > 1.0) most_ = 255.0;
        };
        for (std::size_t i = 1; i < first_ && head_.colors; ++i)
            look(rows_.at(rows_.rows[i]) + colorAt_, rows_.rows[i].count - colorAt_);
        for (std::size_t i = first_; i < last_; ++i) {
            const Row& row = rows_.rows[i];
            const double* v = rows_.at(row);
            if (!isCount(v[0]) || v[0] > row.count - 1.0) continue;
            const std::size_t after = 1 + static_cast<std::size_t>(v[0]);
            if (row.count >= after + 3) look(v + after, row.count - after);
        }
    }

    void takeVertexColors() {
        for (std::size_t i = 1; i < first_; ++i)
            mesh_.colors.push_back(colorAt(rows_.at(rows_.rows[i]) + colorAt_, most_));
    }

    void skipFace(const Error& error) {
        if (!problem_) problem_ = error.primary();
        ++mesh_.leftOut["faces with an index out of range"];
    }

    void readFace(const Row& row) {
        const double* v = rows_.at(row);  // the number of corners, these, perhaps a colour
        if (!isCount(v[0]) || v[0] > row.count - 1.0)
            rows_.refuse(message<"mesh.syntax/off-corners">(), row);
        const auto corners = static_cast<std::size_t>(v[0]);
        if (corners < 3) {
            ++mesh_.leftOut["faces of less than three corners"];
            return;
        }
        checkTriangles(mesh_.triangles() + corners - 2, rows_.file);
        places_.clear();
        face_.clear();
        try {
            for (std::size_t k = 0; k < corners; ++k)
                face_.push_back(indexIn(rows_, row, v[1 + k], mesh_.positions.size()));
        } catch (const Error& error) {
            return skipFace(error);
        }
        for (const std::uint32_t corner : face_) places_.push_back(mesh_.positions[corner]);
        triangulate(places_, triangles_);
        const std::size_t left = row.count - 1 - corners;  // one number is an index in a colour map
        const bool colored = left >= 3;
        anyFaceColor_ = anyFaceColor_ || colored;
        const glm::u8vec4 color =
            colored ? colorAt(v + 1 + corners, most_) : glm::u8vec4(255, 255, 255, 255);
        for (const auto& [a, b, c] : triangles_) {
            mesh_.indices.insert(mesh_.indices.end(), {face_[a], face_[b], face_[c]});
            faceColors_.push_back(color);
        }
    }

    const NumberRows& rows_;
    OffHead head_;
    RawMesh mesh_;
    std::size_t first_ = 0, last_ = 0;  ///< rows of the faces
    std::size_t colorAt_ = 3;           ///< of a vertex's numbers
    double most_ = 1.0;                 ///< a channel's full value
    bool anyFaceColor_ = false;
    std::vector<glm::u8vec4> faceColors_;  ///< of each triangle
    std::vector<std::uint32_t> face_;
    std::vector<glm::dvec3> places_;
    std::vector<FaceTriangle> triangles_;
    std::optional<Diagnostic> problem_;  ///< of the first face that was lost
};

/// Makes one row of counts that stand in a line each.
void joinCounts(NumberRows& rows) {
    std::size_t alone = 0;
    while (alone < std::min<std::size_t>(rows.rows.size(), 3) && rows.rows[alone].count == 1)
        ++alone;
    if (alone < 2) return;
    rows.rows[0].count = static_cast<std::uint32_t>(alone);
    rows.rows.erase(rows.rows.begin() + 1, rows.rows.begin() + static_cast<std::ptrdiff_t>(alone));
}

/// Geomview's binary form: big-endian 32-bit counts, floats and indices; a face has the number of
/// its corners, these, and a number of colour components.
RawMesh decodeBinaryOff(std::string_view bytes, const OffHead& head, const std::string& fileName) {
    std::size_t at = 0;
    const auto word = [&]() -> std::uint32_t {
        if (bytes.size() - at < 4) throw Error(message<"mesh.truncated/off">(), {fileName, 0, 0});
        std::uint32_t value = 0;
        for (int k = 0; k < 4; ++k) value = value << 8U | static_cast<unsigned char>(bytes[at++]);
        return value;
    };
    const std::size_t vertices = word(), faces = word();
    word();  // edges
    const std::size_t width = 3 + (head.weights ? 1 : 0) + (head.normals ? 3 : 0) +
                              (head.colors ? 4 : 0) + (head.uvs ? 2 : 0);
    checkCounts(vertices, faces, fileName);
    if (vertices > bytes.size() / (4 * width))
        throw Error(message<"mesh.truncated/off">(), {fileName, 0, 0});
    RawMesh mesh;
    for (std::size_t i = 0; i < vertices; ++i) {
        glm::dvec3 place;
        for (std::size_t k = 0; k < width; ++k) {
            const double value = std::bit_cast<float>(word());
            if (k < 3) place[static_cast<int>(k)] = value;
            if (k < 3 && !(std::abs(value) <= kMaxCoordinate))
                throw Error(message<"mesh.number/stored">(), {fileName, 0, 0});
        }
        mesh.positions.push_back(place);
    }
    std::vector<std::uint32_t> face;
    std::vector<glm::dvec3> places;
    std::vector<FaceTriangle> triangles;
    for (std::size_t i = 0; i < faces; ++i) {
        const std::size_t corners = word();
        if (corners > bytes.size() / 4)
            throw Error(message<"mesh.truncated/off">(), {fileName, 0, 0});
        checkTriangles(mesh.triangles() + corners, fileName);
        face.clear();
        places.clear();
        for (std::size_t k = 0; k < corners; ++k) {
            face.push_back(word());
            if (face.back() < vertices) places.push_back(mesh.positions[face.back()]);
        }
        const std::size_t colors = word();
        if (colors > 4) throw Error(message<"mesh.truncated/off">(), {fileName, 0, 0});
        for (std::size_t k = 0; k < colors; ++k) word();
        if (colors > 0) ++mesh.leftOut["colours of faces"];
        if (places.size() < corners) ++mesh.leftOut["faces with an index out of range"];
        if (corners < 3) ++mesh.leftOut["faces of less than three corners"];
        if (corners < 3 || places.size() < corners) continue;
        triangulate(places, triangles);
        for (const auto& [a, b, c] : triangles)
            mesh.indices.insert(mesh.indices.end(), {face[a], face[b], face[c]});
    }
    if (mesh.indices.empty())
        throw Error(message<"mesh.empty/faces">("format"_arg = "OFF"), {fileName, 0, 0});
    return mesh;
}

}  // namespace

bool looksLikeOff(std::string_view bytes, const std::string& fileName) {
    return headOf(bytes).length > 0 || fileEnding(fileName) == "off";
}

RawMesh decodeOff(std::string_view bytes, const std::string& fileName) {
    const OffHead head = headOf(bytes);
    const std::string_view before = bytes.substr(0, head.length);
    const auto lines = static_cast<int>(std::count(before.begin(), before.end(), '\n'));
    const std::size_t column = before.size() - (before.rfind('\n') + 1);  // npos + 1 is 0
    std::string_view rest = bytes.substr(head.length);
    if (sameWord(trimmed(rest.substr(0, rest.find('\n'))), "binary"))
        return decodeBinaryOff(rest.substr(std::min(rest.find('\n'), rest.size() - 1) + 1), head,
                               fileName);
    NumberRows rows = parseRows(rest, fileName, 1 + lines, static_cast<int>(column) + 1);
    joinCounts(rows);
    return OffReader(rows, head).read();
}

}  // namespace farol::generator::io
