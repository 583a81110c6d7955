#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "core/text.h"
#include "generator/compare/checked.h"
#include "generator/compare/messages.h"

namespace farol::generator::compare {
namespace {

using Edge = std::pair<int, int>;

Edge undirected(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

/// Finds what the triangles of a file are among the expected ones.
class TriangleMatcher {
  public:
    TriangleMatcher(const Expected& expected, Checked& checked, Findings& findings)
        : expected_(expected), checked_(checked), findings_(findings) {}

    std::vector<Matched> run() {
        moveToExpected();
        number();
        reportDoubled();
        matchEqual();
        matchQuads();
        reportJunctions();
        reportPositions();
        reportWinding();
        reportMissing();
        for (const std::size_t t : left_)
            if (isOpen_[t])
                findings_.add(Severity::error,
                              checkMessage<"check.extra">(
                                  "triangle"_arg = t + 1,
                                  "lines"_arg = checked_.lineList(checked_.triangles[t])),
                              checked_.lineOf(checked_.triangles[t][0]));
        return std::move(matched_);
    }

  private:
    glm::dvec3 placeOf(int id) const {
        const auto known = static_cast<int>(expected_.places.all().size());
        return id < known ? expected_.places.all()[static_cast<std::size_t>(id)]
                          : checked_.others[static_cast<std::size_t>(id - known)];
    }
    bool isOther(int id) const { return id >= static_cast<int>(expected_.places.all().size()); }

    /// Gives a vertex that is at no expected place the id of the one that its triangles need: the
    /// third corner of an expected triangle whose other two corners are right.
    void moveToExpected() {
        std::set<int> used;
        for (const std::uint32_t index : checked_.arrays.indices) used.insert(checked_.idOf[index]);
        std::map<Edge, int> third;  // by directed edge
        for (const Triangle& t : expected_.triangles)
            for (int k = 0; k < 3; ++k) third[{t[k], t[(k + 1) % 3]}] = t[(k + 2) % 3];
        std::map<int, std::map<int, int>> votes;
        const std::vector<std::uint32_t>& indices = checked_.arrays.indices;
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
            const Triangle t{checked_.idOf[indices[i]], checked_.idOf[indices[i + 1]],
                             checked_.idOf[indices[i + 2]]};
            for (int k = 0; k < 3; ++k) {
                const int a = t[(k + 1) % 3], b = t[(k + 2) % 3];
                if (!isOther(t[k]) || isOther(a) || isOther(b)) continue;
                for (const Edge& edge : {Edge{a, b}, Edge{b, a}})
                    if (const auto found = third.find(edge);
                        found != third.end() && used.count(found->second) == 0)
                        ++votes[t[k]][found->second];
            }
        }
        for (const auto& [id, counts] : votes) {
            const auto best =
                std::max_element(counts.begin(), counts.end(),
                                 [](const auto& a, const auto& b) { return a.second < b.second; });
            moved_[id] = best->first;
        }
    }

    int idAfterMove(int id) const {
        const auto found = moved_.find(id);
        return found == moved_.end() ? id : found->second;
    }

    void number() {
        const std::vector<std::uint32_t>& indices = checked_.arrays.indices;
        for (std::size_t v = 0; v < checked_.idOf.size(); ++v) {
            checked_.idOf[v] = idAfterMove(checked_.idOf[v]);
            checked_.firstLines.emplace(checked_.idOf[v], checked_.lines[v]);
        }
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
            checked_.triangles.push_back({checked_.idOf[indices[i]], checked_.idOf[indices[i + 1]],
                                          checked_.idOf[indices[i + 2]]});
        isOpen_.assign(checked_.triangles.size(), true);
        isMissing_.assign(expected_.triangles.size(), true);
    }

    int lineOfTriangle(std::size_t t) const {
        return checked_.lines[checked_.arrays.indices[3 * t]];
    }

    /// Triangles without area, and those that are there already, on either side.
    void reportDoubled() {
        std::set<Triangle> wanted, seen;
        for (const Triangle& t : expected_.triangles) wanted.insert(rotated(t));
        for (std::size_t t = 0; t < checked_.triangles.size(); ++t) {
            const Triangle& triangle = checked_.triangles[t];
            if (!hasArea(triangle)) {
                const int corner = triangle[0] == triangle[1] ? 0 : 2;
                findings_.add(
                    Severity::warning,
                    checkMessage<"check.degenerate">(
                        "triangle"_arg = t + 1, "place"_arg = placeText(placeOf(
                                                    triangle[static_cast<std::size_t>(corner)]))),
                    lineOfTriangle(t));
                isOpen_[t] = false;
                continue;
            }
            const Triangle key = rotated(triangle), back = reversed(triangle);
            const bool isTwice = seen.count(key) != 0;
            const bool isBack = !isTwice && seen.count(back) != 0 && wanted.count(key) == 0;
            if (isTwice)
                findings_.add(Severity::error,
                              checkMessage<"check.doubled">("triangle"_arg = t + 1),
                              lineOfTriangle(t));
            if (isBack)
                findings_.add(Severity::error,
                              checkMessage<"check.doubled/back">("triangle"_arg = t + 1),
                              lineOfTriangle(t));
            if (isTwice || isBack) isOpen_[t] = false;
            seen.insert(key);
        }
    }

    void match(std::size_t triangle, std::size_t counterpart, bool isReversed) {
        isOpen_[triangle] = false;
        matched_.push_back({triangle, counterpart, isReversed});
    }

    void matchEqual() {
        std::map<Triangle, std::size_t> numbers;
        for (std::size_t w = 0; w < expected_.triangles.size(); ++w)
            numbers[rotated(expected_.triangles[w])] = w;
        for (const bool isReversed : {false, true})
            for (std::size_t t = 0; t < checked_.triangles.size(); ++t) {
                if (!isOpen_[t]) continue;
                const Triangle& triangle = checked_.triangles[t];
                const auto found =
                    numbers.find(isReversed ? reversed(triangle) : rotated(triangle));
                if (found == numbers.end() || !isMissing_[found->second]) continue;
                isMissing_[found->second] = false;
                match(t, found->second, isReversed);
            }
        for (std::size_t t = 0; t < checked_.triangles.size(); ++t)
            if (isOpen_[t]) left_.push_back(t);
    }

    using Quad = std::array<int, 4>;
    struct Pair {
        std::size_t first, second;
        std::vector<Edge> rim;  ///< directed, sorted
    };

    /// Two triangles at every edge that they share.
    static std::multimap<Quad, Pair> pairsOf(const std::vector<Triangle>& all,
                                             const std::vector<std::size_t>& among) {
        std::map<Edge, std::vector<std::size_t>> byEdge;
        for (const std::size_t t : among)
            for (std::size_t k = 0; k < 3; ++k)
                byEdge[undirected(all[t][k], all[t][(k + 1) % 3])].push_back(t);
        std::multimap<Quad, Pair> out;
        for (const auto& [edge, two] : byEdge) {
            if (two.size() != 2) continue;
            Pair pair{two[0], two[1], {}};
            std::set<int> corners;
            for (const std::size_t t : two)
                for (std::size_t k = 0; k < 3; ++k) {
                    corners.insert(all[t][k]);
                    const Edge rim{all[t][k], all[t][(k + 1) % 3]};
                    if (undirected(rim.first, rim.second) != edge) pair.rim.push_back(rim);
                }
            if (corners.size() != 4) continue;
            std::sort(pair.rim.begin(), pair.rim.end());
            Quad key{};
            std::copy(corners.begin(), corners.end(), key.begin());
            out.emplace(key, std::move(pair));
        }
        return out;
    }

    static std::vector<Edge> turned(std::vector<Edge> rim) {
        for (Edge& edge : rim) std::swap(edge.first, edge.second);
        std::sort(rim.begin(), rim.end());
        return rim;
    }

    /// The other diagonal of a quad is no mistake.
    void matchQuads() {
        std::vector<std::size_t> missing;
        for (std::size_t w = 0; w < isMissing_.size(); ++w)
            if (isMissing_[w]) missing.push_back(w);
        if (missing.empty() || left_.empty()) return;
        const auto wanted = pairsOf(expected_.triangles, missing);
        for (const auto& [key, mine] : pairsOf(checked_.triangles, left_)) {
            const auto [begin, end] = wanted.equal_range(key);
            for (auto theirs = begin; theirs != end; ++theirs) {
                const Pair& other = theirs->second;
                if (!isOpen_[mine.first] || !isOpen_[mine.second] || !isMissing_[other.first] ||
                    !isMissing_[other.second])
                    continue;
                const bool isReversed = turned(mine.rim) == other.rim;
                if (!isReversed && mine.rim != other.rim) continue;
                isMissing_[other.first] = isMissing_[other.second] = false;
                match(mine.first, other.first, isReversed);
                match(mine.second, other.second, isReversed);
            }
        }
    }

    /// Vertices inside an edge that only one triangle has.
    void reportJunctions() {
        std::map<Edge, int> uses;
        for (std::size_t t = 0; t < checked_.triangles.size(); ++t) {
            const Triangle& one = checked_.triangles[t];
            if (!hasArea(one)) continue;
            for (std::size_t k = 0; k < 3; ++k) ++uses[undirected(one[k], one[(k + 1) % 3])];
        }
        std::vector<Edge> open;
        std::set<int> ends;
        for (const auto& [edge, count] : uses)
            if (count == 1) {
                open.push_back(edge);
                ends.insert(edge.first);
                ends.insert(edge.second);
            }
        constexpr std::size_t kMaxPairs = 4'000'000;
        if (open.size() * ends.size() > kMaxPairs) return;
        for (const Edge& edge : open)
            for (const int id : ends)
                if (isInside(edge, id)) reportJunction(edge, id);
    }

    bool isInside(const Edge& edge, int id) const {
        if (id == edge.first || id == edge.second) return false;
        const glm::dvec3 a = placeOf(edge.first), b = placeOf(edge.second), p = placeOf(id);
        const double length = glm::length(b - a), reach = expected_.places.reach();
        if (!(length > 2.0 * reach)) return false;
        const glm::dvec3 way = (b - a) / length;
        const double along = glm::dot(p - a, way);
        return along > reach && along < length - reach && glm::length(p - a - along * way) <= reach;
    }

    void reportJunction(const Edge& edge, int id) {
        if (!junctions_.insert(id).second) return;
        findings_.add(Severity::error,
                      checkMessage<"check.t-junction">(
                          "lines"_arg = std::to_string(checked_.lineOf(edge.first)) + " and " +
                                        std::to_string(checked_.lineOf(edge.second))),
                      checked_.lineOf(id));
        // The triangles of the split follow from it.
        for (const std::size_t t : left_)
            for (const int corner : checked_.triangles[t])
                if (corner == id) isOpen_[t] = false;
        for (std::size_t w = 0; w < isMissing_.size(); ++w) {
            const Triangle& t = expected_.triangles[w];
            const auto has = [&](int corner) {
                return t[0] == corner || t[1] == corner || t[2] == corner;
            };
            if (has(edge.first) && has(edge.second)) isMissing_[w] = false;
        }
    }

    void reportPositions() {
        for (const auto& [id, to] : moved_) {
            const int line = lineOfOther(id);
            findings_.add(Severity::error,
                          checkMessage<"check.position">("found"_arg = placeText(placeOf(id)),
                                                         "expected"_arg = placeText(placeOf(to))),
                          line);
        }
        std::set<int> reported;
        for (const std::size_t t : left_)
            for (const int id : checked_.triangles[t]) {
                if (!isOther(id) || junctions_.count(id) != 0 || !reported.insert(id).second)
                    continue;
                double least = 1e300;
                for (const glm::dvec3& at : expected_.places.all())
                    least = std::min(least, glm::length(at - placeOf(id)));
                findings_.add(Severity::error,
                              checkMessage<"check.position/extra">(
                                  "found"_arg = placeText(placeOf(id)),
                                  "distance"_arg = std::round(least * 1e5) / 1e5),
                              checked_.lineOf(id));
            }
    }

    /// The line of a vertex that was moved to an expected place.
    int lineOfOther(int id) const {
        const glm::dvec3 at = placeOf(id);
        for (std::size_t v = 0; v < checked_.at.size(); ++v)
            if (glm::length(checked_.at[v] - at) <= expected_.places.reach())
                return checked_.lines[v];
        return 0;
    }

    void reportWinding() {
        const auto count = std::count_if(matched_.begin(), matched_.end(),
                                         [](const Matched& one) { return one.isReversed; });
        if (count > 1 && 10 * static_cast<std::size_t>(count) >= 9 * matched_.size()) {
            findings_.add(Severity::error, checkMessage<"check.winding/all">("count"_arg = count),
                          lineOfTriangle(matched_.front().triangle));
            return;
        }
        for (const Matched& one : matched_)
            if (one.isReversed)
                findings_.add(Severity::error,
                              checkMessage<"check.winding">("triangle"_arg = one.triangle + 1),
                              lineOfTriangle(one.triangle));
    }

    glm::dvec3 normalOf(const Triangle& t) const {
        const glm::dvec3 a = placeOf(t[0]);
        const glm::dvec3 normal = glm::cross(placeOf(t[1]) - a, placeOf(t[2]) - a);
        const double length = glm::length(normal);
        return length > 0.0 ? normal / length : normal;
    }

    /// A flat side that is missing as a whole, and not all of the mesh.
    void reportCaps() {
        constexpr double kFlat = 1e-4;
        for (std::size_t w = 0; w < isMissing_.size(); ++w) {
            if (!isMissing_[w]) continue;
            const glm::dvec3 normal = normalOf(expected_.triangles[w]);
            const double height = glm::dot(normal, placeOf(expected_.triangles[w][0]));
            std::vector<std::size_t> side;
            bool isWhole = true;
            glm::dvec3 sum(0.0);
            for (std::size_t other = 0; other < isMissing_.size() && isWhole; ++other) {
                const Triangle& t = expected_.triangles[other];
                bool isIn = glm::dot(normalOf(t), normal) > 1.0 - kFlat;
                for (const int id : t)
                    isIn = isIn && std::abs(glm::dot(normal, placeOf(id)) - height) <=
                                       expected_.places.reach();
                if (!isIn) continue;
                side.push_back(other);
                isWhole = isMissing_[other];
                for (const int id : t) sum += placeOf(id);
            }
            if (!isWhole || side.size() < 2 || side.size() == isMissing_.size()) continue;
            for (const std::size_t other : side) isMissing_[other] = false;
            findings_.add(
                Severity::error,
                checkMessage<"check.cap">(
                    "count"_arg = side.size(),
                    "place"_arg = placeText(sum / (3.0 * static_cast<double>(side.size())))),
                checked_.lineOf(expected_.triangles[side.front()][0]));
        }
    }

    void reportMissing() {
        constexpr std::size_t kMaxTriangles = 3000;  // each is compared with each
        if (isMissing_.size() <= kMaxTriangles) reportCaps();
        for (std::size_t w = 0; w < isMissing_.size(); ++w) {
            if (!isMissing_[w]) continue;
            const Triangle& t = expected_.triangles[w];
            int line = 0;
            bool hasAll = true;
            for (const int id : t) {
                const int of = checked_.lineOf(id);
                hasAll = hasAll && of > 0;
                if (line == 0) line = of;
            }
            findings_.add(Severity::error,
                          hasAll ? checkMessage<"check.missing">("lines"_arg = checked_.lineList(t))
                                 : checkMessage<"check.missing/place">(
                                       "places"_arg = uncut(placeText(placeOf(t[0])) + ", " +
                                                            placeText(placeOf(t[1])) + " and " +
                                                            placeText(placeOf(t[2])))),
                          line);
        }
    }

    const Expected& expected_;
    Checked& checked_;
    Findings& findings_;
    std::map<int, int> moved_;  ///< ids that are not expected, and those that they stand for
    std::vector<bool> isOpen_, isMissing_;
    std::vector<std::size_t> left_;
    std::set<int> junctions_;
    std::vector<Matched> matched_;
};

}  // namespace

std::vector<Matched> matchTriangles(const Expected& expected, Checked& checked,
                                    Findings& findings) {
    return TriangleMatcher(expected, checked, findings).run();
}

}  // namespace farol::generator::compare
