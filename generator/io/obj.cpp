#include <array>
#include <charconv>
#include <cmath>
#include <unordered_map>

#include "generator/io/formats.h"
#include "generator/io/polygon.h"
#include "generator/io/repair.h"
#include "generator/io/writer.h"

namespace farol::generator::io {
namespace {

/// The next word of a line; empty at its end.
std::string_view nextWord(std::string_view& line) {
    const std::size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return line = {};
    const std::size_t end = std::min(line.find_first_of(" \t\r", begin), line.size());
    const std::string_view word = line.substr(begin, end - begin);
    line.remove_prefix(end);
    return word;
}

/// A face's corner: numbers of position, texture coordinate and normal, from 0; -1 is none.
using Corner = std::array<std::int64_t, 3>;

struct CornerHash {
    std::size_t operator()(const Corner& c) const {
        std::uint64_t hash = 1469598103934665603U;  // FNV-1a
        for (const std::int64_t part : c)
            hash = (hash ^ static_cast<std::uint64_t>(part)) * 1099511628211U;
        return static_cast<std::size_t>(hash ^ hash >> 29U);
    }
};

class Reader {
  public:
    explicit Reader(const std::string& file) : file_(file) {}

    void readLine(std::string_view line, int number) {
        line_ = number;
        line = line.substr(0, line.find('#'));
        const std::string_view keyword = nextWord(line);
        if (keyword == "v") positions_.push_back(vector<glm::vec3>(line, 3, 3));
        if (keyword == "vt") uvs_.push_back(vector<glm::vec2>(line, 2, 1));
        if (keyword == "vn") normals_.push_back(vector<glm::vec3>(line, 3, 3));
        if (keyword == "f") readFace(line);
        // Everything else (groups, materials, lines, curves) says nothing about the triangles.
    }

    Mesh take() {
        if (corners_.empty()) fail("mesh.empty", "the OBJ file holds no faces");
        const bool withUvs = has(1), withNormals = has(2);
        if (!withNormals) computeNormals();
        return isPlain(withUvs, withNormals) ? plainMesh(withUvs, withNormals) : splitMesh(withUvs);
    }

  private:
    [[noreturn]] void fail(const char* code, const std::string& message) const {
        throw Error(code, message, {file_, line_, 1});
    }

    template <class Vector>
    Vector vector(std::string_view line, int size, int needed) const {
        Vector value(0);
        for (int k = 0; k < size; ++k) {
            std::string_view word = nextWord(line);
            if (word.empty() && k >= needed) break;
            double number = 0;
            if (word.size() > 1 && word[0] == '+') word.remove_prefix(1);
            const char* end = word.data() + word.size();
            const auto [stop, failed] = std::from_chars(word.data(), end, number);
            if (word.empty())
                fail("mesh.truncated", "expected " + std::to_string(needed) + " numbers");
            if (stop != end || failed == std::errc::invalid_argument)
                fail("mesh.syntax", "\"" + std::string(word.substr(0, 24)) + "\" is not a number");
            if (failed != std::errc() || !std::isfinite(number) ||
                std::abs(number) > kMaxCoordinate)
                fail("mesh.number", "a number is not finite or beyond 1e18");
            value[k] = static_cast<float>(number);
        }
        return value;
    }

    /// One part of "7/1/3": counted from 1, or from the end when negative; 0 parts are errors.
    std::int64_t index(std::string_view word, std::size_t size, const char* what) const {
        std::int64_t number = 0;
        const char* end = word.data() + word.size();
        const auto [stop, failed] = std::from_chars(word.data(), end, number);
        if (stop != end || failed != std::errc() || number == 0)
            fail("mesh.syntax", "\"" + std::string(word.substr(0, 24)) + "\" is no index");
        const auto count = static_cast<std::int64_t>(size);
        const std::int64_t at = number > 0 ? number - 1 : count + number;
        if (number < -count || number > count)
            fail("mesh.index", "the index " + std::to_string(number) +
                                   " is out of range: there are " + std::to_string(size) + " " +
                                   what);
        return at;
    }

    Corner corner(std::string_view word) const {
        Corner out{-1, -1, -1};
        const std::size_t sizes[3] = {positions_.size(), uvs_.size(), normals_.size()};
        const char* const names[3] = {"vertices", "texture coordinates", "normals"};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t end = std::min(word.find('/'), word.size());
            if (end > 0 || k == 0) out[k] = index(word.substr(0, end), sizes[k], names[k]);
            if (end == word.size()) return out;
            word.remove_prefix(end + 1);
        }
        fail("mesh.syntax", "a corner of a face has at most three parts");
    }

    void readFace(std::string_view line) {
        std::vector<Corner> face;
        for (std::string_view word = nextWord(line); !word.empty(); word = nextWord(line))
            face.push_back(corner(word));
        if (face.size() < 3) fail("mesh.syntax", "a face needs at least three corners");
        checkTriangles(corners_.size() / 3 + face.size() - 2, file_);
        places_.clear();
        for (const Corner& one : face)
            places_.push_back(positions_[static_cast<std::size_t>(one[0])]);
        triangulate(places_, triangles_);
        for (const auto& [a, b, c] : triangles_)
            corners_.insert(corners_.end(), {face[a], face[b], face[c]});
    }

    /// True when all corners name the part: otherwise it is left out (or computed) for all.
    bool has(std::size_t part) const {
        for (const Corner& one : corners_)
            if (one[part] < 0) return false;
        return true;
    }

    /// By position, so that a texture's seam does not become an edge.
    void computeNormals() {
        std::vector<std::uint32_t> indices;
        for (Corner& one : corners_) {
            indices.push_back(static_cast<std::uint32_t>(one[0]));
            one[2] = one[0];
        }
        normals_ = vertexNormals(positions_, indices);
    }

    /// True when positions, texture coordinates and normals go by the same numbers.
    bool isPlain(bool withUvs, bool withNormals) const {
        if (withUvs && uvs_.size() != positions_.size()) return false;
        if (withNormals && normals_.size() != positions_.size()) return false;
        for (const Corner& one : corners_)
            if ((withUvs && one[1] != one[0]) || one[2] != one[0]) return false;
        return true;
    }

    Mesh plainMesh(bool withUvs, bool withNormals) {
        Mesh mesh;
        for (const Corner& one : corners_)
            mesh.indices.push_back(static_cast<std::uint32_t>(one[0]));
        mesh.positions = std::move(positions_);
        if (withUvs) mesh.uvs = std::move(uvs_);
        if (withNormals) mesh.normals = std::move(normals_);
        return mesh;
    }

    Mesh splitMesh(bool withUvs) const {
        Mesh mesh;
        std::unordered_map<Corner, std::uint32_t, CornerHash> known;
        for (Corner one : corners_) {
            if (!withUvs) one[1] = -1;
            const auto next = static_cast<std::uint32_t>(mesh.positions.size());
            const auto [at, fresh] = known.try_emplace(one, next);
            mesh.indices.push_back(at->second);
            if (!fresh) continue;
            mesh.positions.push_back(positions_[static_cast<std::size_t>(one[0])]);
            mesh.normals.push_back(normals_[static_cast<std::size_t>(one[2])]);
            if (withUvs) mesh.uvs.push_back(uvs_[static_cast<std::size_t>(one[1])]);
        }
        return mesh;
    }

    const std::string& file_;
    int line_ = 1;
    std::vector<glm::vec3> positions_, normals_;
    std::vector<glm::vec2> uvs_;
    std::vector<Corner> corners_;
    std::vector<glm::vec3> places_;  // of the face being read
    std::vector<FaceTriangle> triangles_;
};

}  // namespace

std::string encodeObj(const Mesh& mesh) {
    Writer out;
    for (const glm::vec3& p : mesh.positions) out.row({p.x, p.y, p.z}, "v");
    for (const glm::vec2& uv : mesh.uvs) out.row({uv.x, uv.y}, "vt");
    for (const glm::vec3& n : mesh.normals) out.row({n.x, n.y, n.z}, "vn");
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        const std::uint64_t number = std::uint64_t{mesh.indices[i]} + 1;
        out.text(i % 3 == 0 ? "f " : " ");
        out.number(number);
        if (!mesh.uvs.empty() || !mesh.normals.empty()) out.text("/");
        if (!mesh.uvs.empty()) out.number(number);
        if (!mesh.normals.empty()) {
            out.text("/");
            out.number(number);
        }
        if (i % 3 == 2) out.text("\n");
    }
    return out.take();
}

bool looksLikeObj(std::string_view bytes) {
    for (int looked = 0; !bytes.empty() && looked < 1000; ++looked) {
        const std::size_t end = std::min(bytes.find('\n'), bytes.size());
        std::string_view line = bytes.substr(0, end);
        bytes.remove_prefix(std::min(end + 1, bytes.size()));
        const std::string_view word = nextWord(line);
        if (word.empty() || word[0] == '#') continue;
        for (const char* keyword : {"v", "vt", "vn", "f", "o", "g", "s", "mtllib", "usemtl"})
            if (word == keyword) return true;
        return false;
    }
    return false;
}

Mesh decodeObj(std::string_view bytes, const std::string& fileName) {
    Reader reader(fileName);
    std::string joined;  // a line that goes on after a backslash
    int number = 0;
    while (!bytes.empty()) {
        ++number;
        const std::size_t end = std::min(bytes.find('\n'), bytes.size());
        std::string_view line = bytes.substr(0, end);
        bytes.remove_prefix(std::min(end + 1, bytes.size()));
        if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
        if (!line.empty() && line.back() == '\\') {
            joined.append(line.substr(0, line.size() - 1)).append(" ");
            continue;
        }
        if (joined.empty()) {
            reader.readLine(line, number);
        } else {
            joined += line;
            reader.readLine(joined, number);
            joined.clear();
        }
    }
    if (!joined.empty()) reader.readLine(joined, number);
    return reader.take();
}

}  // namespace farol::generator::io
