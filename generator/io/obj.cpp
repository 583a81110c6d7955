#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "core/text.h"
#include "generator/io/formats.h"
#include "generator/io/obj_text.h"
#include "generator/io/polygon.h"
#include "generator/messages.h"

namespace farol::generator::io {
namespace {

/// A face's corner: numbers of position, texture coordinate and normal (or group of shared
/// normals), from 0; -1 is none.
using Corner = std::array<std::int32_t, 3>;

class Reader {
  public:
    /// `base`: the first index, 1, or 0 in some home-made files.
    Reader(const std::string& file, int base) : file_(file), base_(base) {}

    /// Reads the faces of a file whose vertices are known already: they stand after the faces.
    void readFacesOnly() {
        facesOnly_ = true;
        problem_.reset();
        mesh_.leftOut.clear();
    }
    bool lostAllFaces() const { return corners_.empty() && problem_.has_value(); }

    void readLine(std::string_view line, int number) {
        line_ = number;
        line = line.substr(0, commentStart(line, false));
        std::string_view keyword = nextObjWord(line);
        if (keyword.empty()) return;
        if (keyword == "V" || keyword == "F") keyword = keyword == "V" ? "v" : "f";
        const bool isList = keyword == "v" || keyword == "vt" || keyword == "vn";
        if (isList && facesOnly_) return;
        if (keyword == "v")
            readVertex(line);
        else if (keyword == "vt")
            add(uvs_, dvec2(vector(line, 2, 1, true)));
        else if (keyword == "vn")
            readNormal(line);
        else if (keyword == "f" || keyword == "fo")
            readFace(line);
        else if (keyword == "s")
            smoothing_ = smoothingOf(nextObjWord(line));
        else if (keyword == "usemtl")
            chooseMaterial(trimmed(line));
        else if (keyword == "l" || keyword == "p")
            ++mesh_.leftOut[keyword == "l" ? "lines" : "points"];
        else if (keyword != "o" && keyword != "g" && keyword != "mtllib" && keyword != "mg")
            ++mesh_.leftOut["lines of the file with keywords that are not read"];
    }

    RawMesh take() {
        if (corners_.empty() && !problem_ && fileEnding(file_) != "obj") takeSoup();
        if (corners_.empty()) {
            if (problem_) throw Error(Diagnostics{*problem_});
            fail(message<"mesh.empty/faces">("format"_arg = "OBJ"));
        }
        if (bareCorners_ > 0 && bareCorners_ < corners_.size()) {
            mesh_.leftOut["normals, since other corners have none"] +=
                corners_.size() - bareCorners_;
            withNormals_ = false;
        } else {
            withNormals_ = bareCorners_ == 0;
        }
        sortByMaterial();
        if (!withNormals_) groupNormals();
        const bool plain = isPlain();
        if (plain)
            takePlain();
        else
            split();
        return std::move(mesh_);
    }

  private:
    using dvec2 = glm::dvec2;
    using dvec3 = glm::dvec3;

    [[noreturn]] void fail(Message message) const {
        throw Error(std::move(message), {file_, line_, 1});
    }

    template <class Vector>
    void add(std::vector<Vector>& list, const Vector& value) const {
        checkCounts(list.size() + 1, 0, file_);
        list.push_back(value);
    }

    /// Up to `size` numbers, of which `needed` must be there. NaN only where it does no harm.
    dvec3 vector(std::string_view& line, int size, int needed, bool nanAllowed) {
        dvec3 value(0.0);
        words_ = 0;
        for (int k = 0; k < size; ++k, ++words_) {
            const std::string_view word = nextObjWord(line);
            if (word.empty() && k >= needed) break;
            if (word.empty())
                fail(message<"mesh.truncated/vector">("count"_arg = k, "needed"_arg = needed));
            const std::optional<double> number = numberOf(word, {file_, line_, 1});
            if (!number) fail(message<"mesh.syntax/number">("value"_arg = word));
            if (!nanAllowed && std::isnan(*number)) fail(message<"mesh.number/nan">());
            value[k] = *number;
        }
        return value;
    }

    /// A normal of less than three numbers has no direction, and is replaced as these are.
    void readNormal(std::string_view line) {
        glm::dvec3 normal = vector(line, 3, 0, true);
        if (words_ < 3) normal = glm::dvec3(std::nan(""));
        add(normals_, glm::vec3(normal));
    }

    /// Every three vertices of a file without faces are one, with the normals and coordinates of
    /// the same number.
    void takeSoup() {
        if (positions_.empty() || positions_.size() % 3 != 0) return;
        const bool uvs = uvs_.size() == positions_.size();
        const bool normals = normals_.size() == positions_.size();
        for (std::size_t i = 0; i < positions_.size(); i += 3) {
            std::string face;
            for (std::size_t k = i + 1; k <= i + 3; ++k) {
                const std::string number = std::to_string(k - 1 + static_cast<std::size_t>(base_));
                face += number + (uvs || normals ? "/" : "") + (uvs ? number : "") +
                        (normals ? "/" + number : "") + " ";
            }
            readFace(face);
        }
    }

    /// x y z, and perhaps a weight, or red, green and blue.
    void readVertex(std::string_view line) {
        add(positions_, vector(line, 3, 3, false));
        std::array<double, 4> more{};
        std::size_t count = 0;
        for (std::string_view word = nextObjWord(line); !word.empty(); word = nextObjWord(line)) {
            const std::optional<double> number = numberOf(word, {file_, line_, 1});
            if (!number) fail(message<"mesh.syntax/number">("value"_arg = word));
            if (count < more.size()) more[count] = *number;
            ++count;
        }
        if (count == 1 && more[0] != 1.0) ++mesh_.leftOut["weights of vertices"];
        if (count < 3 || count > 4) {
            if (!colors_.empty()) colors_.push_back({1.0, 1.0, 1.0});
            return;
        }
        colors_.resize(positions_.size() - 1, dvec3(1.0));  // those before it are white
        colors_.emplace_back(more[0], more[1], more[2]);
        mostColor_ = std::max({mostColor_, more[0], more[1], more[2]});
    }

    /// 0: facets. "off" and "0" are, and files without the keyword.
    static std::uint32_t smoothingOf(std::string_view word) {
        std::uint32_t group = 0;
        const auto [stop, failed] = std::from_chars(word.data(), word.data() + word.size(), group);
        if (stop != word.data() + word.size() || failed != std::errc())
            return sameWord(word, "on") ? 1 : 0;
        return group;
    }

    static std::string_view trimmed(std::string_view text) {
        const std::size_t first = text.find_first_not_of(" \t\r");
        if (first == std::string_view::npos) return {};
        return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
    }

    void chooseMaterial(std::string_view name) {
        const std::string key(name.substr(0, 256));
        const auto found = materialOf_.find(key);
        if (found != materialOf_.end()) {
            material_ = found->second;
        } else if (materials_.size() < kMaxParts) {
            material_ = static_cast<std::uint32_t>(materials_.size());
            materialOf_.emplace(key, material_);
            materials_.push_back(key);
        } else {
            ++mesh_.leftOut["materials after the first " + std::to_string(kMaxParts)];
        }
    }

    /// One part of "7/1/3": counted from 1, or from the end when negative; 0 parts are errors.
    /// Returns -2 where it is out of range.
    std::int32_t index(std::string_view word, std::size_t size) const {
        std::int64_t number = 0;
        const char* end = word.data() + word.size();
        const auto [stop, failed] = std::from_chars(word.data(), end, number);
        if (base_ == 0 && number >= 0) ++number;
        if (stop != end || failed == std::errc::invalid_argument || number == 0)
            fail(message<"mesh.syntax/index">("value"_arg = word));
        const auto count = static_cast<std::int64_t>(size);
        const std::int64_t at = number > 0 ? number - 1 : count + number;
        if (failed != std::errc() || number < -count || number > count) return -2;
        return static_cast<std::int32_t>(at);  // lists are within kMaxVertices
    }

    /// Of part 0 to 2 of a corner, v/vt/vn; `count` of its kind are read.
    static Message outOfRange(std::size_t part, std::string_view index, std::size_t count) {
        if (part == 1) return message<"mesh.index/uvs">("index"_arg = index, "count"_arg = count);
        if (part == 2)
            return message<"mesh.index/normals">("index"_arg = index, "count"_arg = count);
        return message<"mesh.index/range">("index"_arg = index, "count"_arg = count);
    }

    /// Nothing where one of its indices is out of range.
    std::optional<Corner> corner(std::string_view word) {
        Corner out{-1, -1, -1};
        const std::size_t sizes[3] = {positions_.size(), uvs_.size(), normals_.size()};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t end = std::min(word.find('/'), word.size());
            const std::string_view part = word.substr(0, end);
            if (end > 0 || k == 0) out[k] = index(part, sizes[k]);
            if (out[k] == -2 && k > 0 && sizes[k] == 0) {
                out[k] = -1;  // a file that has none at all
            } else if (out[k] == -2) {
                note(outOfRange(k, part, sizes[k]));
                return std::nullopt;
            }
            if (end == word.size()) return out;
            word.remove_prefix(end + 1);
        }
        fail(message<"mesh.syntax/corner">());
    }

    /// Keeps the first problem of a face that is left out: the error where no face is left.
    void note(Message problem) {
        if (!problem_)
            problem_ = diagnosticOf(Severity::error, std::move(problem), {file_, line_, 1});
    }

    void readFace(std::string_view line) {
        face_.clear();
        for (std::string_view word = nextObjWord(line); !word.empty(); word = nextObjWord(line)) {
            const std::optional<Corner> one = corner(word);
            if (!one) {
                ++mesh_.leftOut["faces with an index out of range"];
                return;
            }
            face_.push_back(*one);
        }
        if (face_.size() < 3) {
            note(message<"mesh.syntax/face-corners">());
            ++mesh_.leftOut["faces of less than three corners"];
            return;
        }
        checkTriangles(corners_.size() / 3 + face_.size() - 2, file_);
        places_.clear();
        for (const Corner& one : face_)
            places_.push_back(positions_[static_cast<std::size_t>(one[0])]);
        triangulate(places_, triangles_);
        for (const auto& [a, b, c] : triangles_) {
            for (const std::uint32_t k : {a, b, c}) {
                corners_.push_back(face_[k]);
                if (face_[k][1] >= 0) ++uvCorners_;
                if (face_[k][2] < 0) ++bareCorners_;
            }
            triangleFaces_.push_back({material_, smoothing_, faces_});
        }
        ++faces_;
    }

    /// Brings the triangles of each material together, in the order of their first use.
    void sortByMaterial() {
        if (materials_.size() <= 1) return;
        std::vector<std::uint32_t> order(triangleFaces_.size());
        std::iota(order.begin(), order.end(), 0U);
        std::stable_sort(order.begin(), order.end(), [this](std::uint32_t a, std::uint32_t b) {
            return triangleFaces_[a].material < triangleFaces_[b].material;
        });
        std::vector<Corner> corners;
        std::vector<Source> sources;
        corners.reserve(corners_.size());
        for (const std::uint32_t t : order) {
            corners.insert(corners.end(), corners_.begin() + 3 * std::ptrdiff_t{t},
                           corners_.begin() + 3 * std::ptrdiff_t{t} + 3);
            sources.push_back(triangleFaces_[t]);
        }
        corners_ = std::move(corners);
        triangleFaces_ = std::move(sources);
        for (std::size_t t = 0; t < triangleFaces_.size(); ++t) {
            const std::uint32_t material = triangleFaces_[t].material;
            if (mesh_.parts.empty() || materials_[material] != mesh_.parts.back().material)
                mesh_.parts.push_back({materials_[material], 3 * t, 0});
            mesh_.parts.back().count += 3;
        }
    }

    /// Numbers groups of corners that share a computed normal: those of one smoothing group at one
    /// position (so that a texture's seam does not become an edge), or those of one face.
    void groupNormals() {
        const bool one =
            std::all_of(triangleFaces_.begin(), triangleFaces_.end(), [this](const Source& source) {
                return source.smoothing != 0 && source.smoothing == triangleFaces_[0].smoothing;
            });
        if (one) {
            for (Corner& corner : corners_) corner[2] = corner[0];
            return;
        }
        std::int32_t next = 0;
        std::vector<std::uint32_t> smooth;  // corners of smoothing groups
        for (std::uint32_t i = 0; i < corners_.size(); ++i) {
            const Source& source = triangleFaces_[i / 3];
            if (source.smoothing != 0) {
                smooth.push_back(i);
                continue;
            }
            const bool known = i > 0 && triangleFaces_[(i - 1) / 3].face == source.face;
            corners_[i][2] = known ? corners_[i - 1][2] : next++;
        }
        const auto keyOf = [this](std::uint32_t i) {
            return std::pair(triangleFaces_[i / 3].smoothing, corners_[i][0]);
        };
        std::sort(smooth.begin(), smooth.end(),
                  [&keyOf](std::uint32_t a, std::uint32_t b) { return keyOf(a) < keyOf(b); });
        for (std::size_t k = 0; k < smooth.size(); ++k) {
            const bool known = k > 0 && keyOf(smooth[k]) == keyOf(smooth[k - 1]);
            corners_[smooth[k]][2] = known ? corners_[smooth[k - 1]][2] : next++;
        }
    }

    /// True when positions, texture coordinates and normals go by the same numbers.
    bool isPlain() const {
        if (uvCorners_ > 0 && uvs_.size() != positions_.size()) return false;
        if (withNormals_ && normals_.size() != positions_.size()) return false;
        for (const Corner& one : corners_)
            if ((uvCorners_ > 0 && one[1] != one[0]) || one[2] != one[0]) return false;
        return true;
    }

    void takePlain() {
        for (const Corner& one : corners_)
            mesh_.indices.push_back(static_cast<std::uint32_t>(one[0]));
        for (const dvec3& color : colors_) mesh_.colors.push_back(rgba(color));
        if (!colors_.empty()) mesh_.colors.resize(positions_.size(), glm::u8vec4(255));
        mesh_.positions = std::move(positions_);
        if (uvCorners_ > 0) mesh_.uvs = std::move(uvs_);
        if (withNormals_) mesh_.normals = std::move(normals_);
    }

    glm::u8vec4 rgba(const dvec3& color) const {
        const double most = mostColor_ > 1.0 ? 255.0 : 1.0;
        return {channelOf(color.x, most), channelOf(color.y, most), channelOf(color.z, most), 255};
    }

    /// Gives every different corner a vertex, in the order of their first use.
    void split() {
        if (uvCorners_ == 0)
            for (Corner& one : corners_) one[1] = -1;
        // Sorted, not hashed: a file must not choose how many corners share a bucket.
        std::vector<std::uint32_t> order(corners_.size()), vertexOf(corners_.size());
        std::iota(order.begin(), order.end(), 0U);
        std::sort(order.begin(), order.end(), [this](std::uint32_t a, std::uint32_t b) {
            return corners_[a] != corners_[b] ? corners_[a] < corners_[b] : a < b;
        });
        for (std::size_t i = 0; i < order.size(); ++i) {  // to the first use of an equal corner
            const bool equal = i > 0 && corners_[order[i]] == corners_[order[i - 1]];
            vertexOf[order[i]] = equal ? vertexOf[order[i - 1]] : order[i];
        }
        std::vector<std::uint32_t> firstOfGroup;
        mesh_.indices.reserve(corners_.size());
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            const std::size_t first = vertexOf[i];
            if (first == i) {
                const Corner& one = corners_[i];
                const auto vertex = static_cast<std::uint32_t>(mesh_.positions.size());
                const auto position = static_cast<std::size_t>(one[0]);
                vertexOf[i] = vertex;
                mesh_.positions.push_back(positions_[position]);
                if (!colors_.empty())
                    mesh_.colors.push_back(position < colors_.size() ? rgba(colors_[position])
                                                                     : glm::u8vec4(255));
                if (uvCorners_ > 0)
                    mesh_.uvs.push_back(one[1] < 0 ? dvec2(0.0)
                                                   : uvs_[static_cast<std::size_t>(one[1])]);
                if (withNormals_) {
                    mesh_.normals.push_back(normals_[static_cast<std::size_t>(one[2])]);
                } else {  // the group is named by its first vertex
                    const auto group = static_cast<std::size_t>(one[2]);
                    if (group >= firstOfGroup.size()) firstOfGroup.resize(group + 1, kNone);
                    if (firstOfGroup[group] == kNone) firstOfGroup[group] = vertex;
                    mesh_.smooth.push_back(firstOfGroup[group]);
                }
            }
            mesh_.indices.push_back(vertexOf[first]);
        }
        const std::size_t bare = corners_.size() - uvCorners_;
        if (uvCorners_ > 0 && bare > 0)
            mesh_.leftOut["corners without a texture coordinate, which have (0, 0)"] += bare;
    }

    static constexpr std::uint32_t kNone = ~0U;

    /// Where a triangle comes from.
    struct Source {
        std::uint32_t material, smoothing, face;
    };

    const std::string& file_;
    int base_;
    bool facesOnly_ = false;
    int words_ = 0;  ///< that `vector` read
    int line_ = 1;
    RawMesh mesh_;
    std::vector<dvec3> positions_, colors_;  ///< colours: as long as positions once there is one
    std::vector<glm::vec3> normals_;
    std::vector<dvec2> uvs_;
    std::vector<Corner> corners_;
    std::vector<Source> triangleFaces_;
    std::vector<std::string> materials_{std::string()};  ///< the first: none is named
    std::map<std::string, std::uint32_t> materialOf_{{std::string(), 0}};
    std::uint32_t material_ = 0, smoothing_ = 0, faces_ = 0;
    std::size_t uvCorners_ = 0, bareCorners_ = 0;
    double mostColor_ = 1.0;
    bool withNormals_ = true;
    std::optional<Diagnostic> problem_;
    std::vector<Corner> face_;
    std::vector<dvec3> places_;  // of the face being read
    std::vector<FaceTriangle> triangles_;
};

}  // namespace

RawMesh decodeObj(std::string_view bytes, const std::string& fileName) {
    const int base = objIndexBase(bytes);
    Reader reader(fileName, base);
    const auto readLines = [&] {
        eachObjLine(bytes,
                    [&](std::string_view line, int number) { reader.readLine(line, number); });
    };
    readLines();
    if (reader.lostAllFaces()) {
        reader.readFacesOnly();
        readLines();
    }
    RawMesh mesh = reader.take();
    if (base == 0)
        mesh.findings.push_back(
            diagnosticOf(Severity::warning, message<"mesh.assumed/base">(), {fileName, 0, 0}));
    return mesh;
}

}  // namespace farol::generator::io
