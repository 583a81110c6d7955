#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>

#include "core/number.h"
#include "generator/compare/checked.h"
#include "generator/compare/messages.h"

namespace farol::generator::compare {
namespace {

constexpr double kNormal = 0.99863;   // cosine of 3 degrees
constexpr double kCoordinate = 2e-3;  // of a texture
constexpr double kNearlyAll = 0.9;

/// A corner of an expected triangle.
struct Corner {
    glm::dvec3 normal, face;
    glm::dvec2 uv;
};

/// A vertex of the file at a matched triangle.
struct Vertex {
    std::uint32_t index;
    int id;
    glm::dvec3 face;  ///< of the expected triangle
};

glm::dvec3 faceOf(const Expected& expected, const Triangle& t) {
    const auto at = [&](std::size_t k) {
        return expected.places.all()[static_cast<std::size_t>(t[k])];
    };
    const glm::dvec3 normal = glm::cross(at(1) - at(0), at(2) - at(0));
    return glm::length(normal) > 0.0 ? glm::normalize(normal) : normal;
}

double wrapped(double difference) { return difference - std::round(difference); }

glm::dvec2 lowest(const std::vector<glm::vec2>& uvs) {
    glm::vec2 low(1e30F);
    for (const glm::vec2& uv : uvs) low = glm::min(low, uv);
    return glm::dvec2(low);
}

std::string uvText(const glm::dvec2& uv) {
    const auto number = [](double value) { return formatNumber(std::round(value * 1e4) / 1e4); };
    return number(uv.x) + " " + number(uv.y);
}

class CornerComparer {
  public:
    CornerComparer(const Expected& expected, const Checked& checked,
                   const std::vector<Matched>& matched, Findings& findings)
        : expected_(expected), checked_(checked), findings_(findings) {
        const MeshArrays& arrays = expected.mesh.arrays();
        for (std::size_t w = 0; w < expected.triangles.size(); ++w) {
            const glm::dvec3 face = faceOf(expected, expected.triangles[w]);
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t index = arrays.indices[3 * expected.sources[w] + k];
                corners_[expected.idOf[index]].push_back(
                    {arrays.normals.empty() ? face : glm::dvec3(arrays.normals[index]), face,
                     arrays.uvs.empty() ? glm::dvec2(0.0) : glm::dvec2(arrays.uvs[index])});
            }
        }
        std::set<std::pair<std::uint32_t, std::size_t>> known;
        for (const Matched& one : matched) {
            const glm::dvec3 face = faceOf(expected, expected.triangles[one.counterpart]);
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t index = checked.arrays.indices[3 * one.triangle + k];
                if (corners_.count(checked.idOf[index]) != 0)
                    vertices_.push_back({index, checked.idOf[index], face});
            }
        }
    }

    void compareNormals() {
        const std::vector<glm::vec3>& normals = checked_.arrays.normals;
        if (expected_.mesh.normals().empty()) return;
        if (normals.empty()) {
            findings_.add(Severity::error, checkMessage<"check.normals/none">());
            return;
        }
        std::set<std::uint32_t> all, inward, flat, longOnes, wrong;
        std::map<std::uint32_t, glm::dvec3> wanted;
        double length = 1.0;
        for (const Vertex& vertex : vertices_) {
            const glm::dvec3 given(normals[vertex.index]);
            const double size = glm::length(given);
            all.insert(vertex.index);
            constexpr double kUnit = 0.01;
            if (std::abs(size - 1.0) > kUnit && longOnes.insert(vertex.index).second) length = size;
            const glm::dvec3 normal = size > 0.0 ? given / size : given;
            double best = -2.0;
            for (const Corner* corner : cornersAt(vertex)) {
                const double dot = glm::dot(corner->normal, normal);
                if (dot > best) {
                    best = dot;
                    wanted[vertex.index] = corner->normal;
                }
            }
            if (isOnAxis(vertex.id) && hasMany(vertex, &isOtherNormal))
                best = glm::dot(normal, vertex.face) > 0.0 ? 1.0 : best;
            if (best >= kNormal) continue;
            wrong.insert(vertex.index);
            if (glm::dot(normal, wanted[vertex.index]) <= -kNormal) inward.insert(vertex.index);
            if (glm::dot(normal, vertex.face) >= kNormal) flat.insert(vertex.index);
        }
        const auto isMost = [&](const std::set<std::uint32_t>& some) {
            return some.size() > 2 &&
                   static_cast<double>(some.size()) >= kNearlyAll * static_cast<double>(all.size());
        };
        if (!longOnes.empty())
            findings_.add(
                Severity::error,
                checkMessage<"check.normals/length">("count"_arg = longOnes.size(),
                                                     "length"_arg = std::round(length * 1e4) / 1e4),
                checked_.lines[*longOnes.begin()]);
        if (isMost(inward)) {
            findings_.add(Severity::error,
                          checkMessage<"check.normals/inward">("count"_arg = inward.size()),
                          checked_.lines[*inward.begin()]);
            return;
        }
        // Faces of a box have normals of the faces on purpose: then none of them is wrong.
        if (flat.size() > 2 && flat.size() == wrong.size()) {
            findings_.add(Severity::error,
                          checkMessage<"check.normals/flat">("count"_arg = flat.size()),
                          checked_.lines[*flat.begin()]);
            return;
        }
        for (const std::uint32_t index : wrong)
            findings_.add(
                Severity::error,
                checkMessage<"check.normals">("found"_arg = placeText(glm::dvec3(normals[index])),
                                              "expected"_arg = placeText(wanted[index])),
                checked_.lines[index]);
    }

    void compareCoordinates() {
        if (expected_.mesh.uvs().empty()) return;
        if (checked_.arrays.uvs.empty()) {
            findings_.add(Severity::error, checkMessage<"check.uv/none">());
            return;
        }
        turns_ = glm::round(checked_.arrays.uvOrigin + lowest(checked_.arrays.uvs) -
                            lowest(expected_.mesh.uvs()));
        const auto same = [](const glm::dvec2& uv) { return uv; };
        std::set<std::uint32_t> wrong = wrongBy(same, 0.0);
        if (wrong.empty()) return;
        if (expected_.fold > 0) {
            const double start = mostUsualStart();
            const std::set<std::uint32_t> left = wrongBy(same, start);
            if (left.size() < wrong.size() / 10 + 1 && std::abs(start) > kCoordinate) {
                findings_.add(Severity::info, checkMessage<"check.seam">());
                reportEach(left, start);
                return;
            }
        }
        if (static_cast<double>(wrong.size()) < 0.3 * static_cast<double>(count())) {
            reportEach(wrong, 0.0);
            return;
        }
        struct Change {
            glm::dvec2 (*apply)(const glm::dvec2&);
            Message message;
        };
        const Change changes[] = {
            {[](const glm::dvec2& uv) { return glm::dvec2(uv.x, 1.0 - uv.y); },
             checkMessage<"check.uv/flipped">()},
            {[](const glm::dvec2& uv) { return glm::dvec2(1.0 - uv.x, uv.y); },
             checkMessage<"check.uv/mirrored">()},
            {[](const glm::dvec2& uv) { return 1.0 - uv; }, checkMessage<"check.uv/turned">()},
            {[](const glm::dvec2& uv) { return glm::dvec2(uv.y, uv.x); },
             checkMessage<"check.uv/swapped">()}};
        for (const Change& change : changes) {
            const std::set<std::uint32_t> left = wrongBy(change.apply, 0.0);
            if (static_cast<double>(left.size()) >
                (1.0 - kNearlyAll) * static_cast<double>(count()))
                continue;
            findings_.add(Severity::error, change.message, checked_.lines[*wrong.begin()]);
            return;
        }
        reportEach(wrong, 0.0);
    }

  private:
    std::size_t count() const {
        std::set<std::uint32_t> all;
        for (const Vertex& vertex : vertices_) all.insert(vertex.index);
        return all.size();
    }

    /// The expected corners at the vertex's place on its side of an edge.
    std::vector<const Corner*> cornersAt(const Vertex& vertex) const {
        constexpr double kSameSide = 0.5;
        std::vector<const Corner*> out;
        for (const Corner& corner : corners_.at(vertex.id))
            if (glm::dot(corner.face, vertex.face) > kSameSide) out.push_back(&corner);
        return out;
    }

    bool isOnAxis(int id) const {
        const glm::dvec3& at = expected_.places.all()[static_cast<std::size_t>(id)];
        return expected_.fold > 0 && std::hypot(at.x, at.z) <= expected_.places.reach();
    }

    static bool isOtherNormal(const Corner& a, const Corner& b) {
        return glm::dot(a.normal, b.normal) < kNormal;
    }
    bool hasMany(const Vertex& vertex, bool (*isOther)(const Corner&, const Corner&)) const {
        const std::vector<Corner>& all = corners_.at(vertex.id);
        return std::any_of(all.begin(), all.end(),
                           [&](const Corner& one) { return isOther(one, all.front()); });
    }

    /// The coordinate without the whole turns that all of the file's have more than expected.
    glm::dvec2 uvOf(std::uint32_t index) const {
        return checked_.arrays.uvOrigin + glm::dvec2(checked_.arrays.uvs[index]) - turns_;
    }

    /// Round a round shape u goes on after 1 with 0.
    double differenceOfU(double a, double b) const {
        return std::abs(expected_.fold > 0 ? wrapped(a - b) : a - b);
    }

    std::set<std::uint32_t> wrongBy(glm::dvec2 (*change)(const glm::dvec2&), double start) const {
        std::set<std::uint32_t> wrong;
        for (const Vertex& vertex : vertices_) {
            const glm::dvec2 uv = change(uvOf(vertex.index));
            const bool anyU = isOnAxis(vertex.id);
            bool isRight = false;
            for (const Corner* corner : cornersAt(vertex)) {
                const bool isU = anyU || differenceOfU(uv.x - start, corner->uv.x) <= kCoordinate;
                isRight = isRight || (isU && std::abs(uv.y - corner->uv.y) <= kCoordinate);
            }
            if (!isRight) wrong.insert(vertex.index);
        }
        return wrong;
    }

    /// The shift of u that most vertices have.
    double mostUsualStart() const {
        constexpr double kStep = 1e-3;
        std::map<long, int> counts;
        for (const Vertex& vertex : vertices_) {
            if (isOnAxis(vertex.id)) continue;
            std::set<long> here;
            for (const Corner* corner : cornersAt(vertex)) {
                double shift = uvOf(vertex.index).x - corner->uv.x;
                shift -= std::floor(shift);
                here.insert(std::lround(shift / kStep) % 1000);
            }
            for (const long shift : here) ++counts[shift];
        }
        const auto best =
            std::max_element(counts.begin(), counts.end(),
                             [](const auto& a, const auto& b) { return a.second < b.second; });
        return best == counts.end() ? 0.0 : wrapped(static_cast<double>(best->first) * kStep);
    }

    void reportEach(const std::set<std::uint32_t>& wrong, double start) {
        for (const std::uint32_t index : wrong)
            for (const Vertex& vertex : vertices_) {
                if (vertex.index != index) continue;
                const std::vector<const Corner*> corners = cornersAt(vertex);
                if (corners.empty()) continue;
                findings_.add(
                    Severity::error,
                    checkMessage<"check.uv">(
                        "found"_arg = uvText(uvOf(index)),
                        "expected"_arg = uvText(corners.front()->uv + glm::dvec2(start, 0.0))),
                    checked_.lines[index]);
                break;
            }
    }

    const Expected& expected_;
    const Checked& checked_;
    Findings& findings_;
    std::map<int, std::vector<Corner>> corners_;  ///< by place
    std::vector<Vertex> vertices_;
    glm::dvec2 turns_{0.0};
};

}  // namespace

void compareCorners(const Expected& expected, const Checked& checked,
                    const std::vector<Matched>& matched, Findings& findings) {
    CornerComparer comparer(expected, checked, matched, findings);
    comparer.compareNormals();
    comparer.compareCoordinates();
}

}  // namespace farol::generator::compare
