#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/error.h"
#include "generator/mesh.h"

/// The parts of checkMesh.
namespace farol::generator::compare {

using Triangle = std::array<int, 3>;  ///< ids of places

/// Returns the triangle with its smallest id first, turning the same way round.
Triangle rotated(const Triangle& triangle);
Triangle reversed(const Triangle& triangle);
inline bool hasArea(const Triangle& t) { return t[0] != t[1] && t[1] != t[2] && t[2] != t[0]; }

/// Places by number: two within `reach` have the same one.
class Places {
  public:
    explicit Places(double reach) : reach_(reach) {}
    /// Returns the nearest place's id, or -1.
    int find(const glm::dvec3& at) const;
    /// Returns its id, a new one where there is none.
    int add(const glm::dvec3& at);
    const std::vector<glm::dvec3>& all() const { return all_; }
    double reach() const { return reach_; }

  private:
    static std::uint64_t keyOf(const glm::i64vec3& cell);
    glm::i64vec3 cellOf(const glm::dvec3& at) const;
    double reach_;
    std::vector<glm::dvec3> all_;
    std::unordered_map<std::uint64_t, std::vector<int>> cells_;
};

/// The expected mesh.
struct Expected {
    explicit Expected(const Mesh& mesh);

    const Mesh& mesh;
    glm::dvec3 low{0.0}, high{0.0};  ///< bounds
    Places places;
    std::vector<int> idOf;             ///< by vertex
    std::vector<Triangle> triangles;   ///< those with area
    std::vector<std::size_t> sources;  ///< the number of each in the mesh
    int fold = 0;  ///< symmetric by turns of 1/fold about y; 0: not a round shape
};

/// The mesh of the file. Vertices whose place is not expected have ids from places.all().size() on.
struct Checked {
    MeshArrays arrays;
    std::vector<glm::dvec3> at;  ///< by vertex, brought to the expected mesh's axes
    std::vector<int> lines;      ///< in the file
    std::vector<int> idOf;
    std::vector<glm::dvec3> others;  ///< places of the ids that are not expected
    std::vector<Triangle> triangles;

    std::string lineList(const Triangle& triangle) const;  ///< "5, 6, 16"; by its ids
    int lineOf(int id) const;                              ///< of the first vertex of a place
    std::map<int, int> firstLines;
};

/// Findings of one file; of each code the first few, then how many more.
class Findings {
  public:
    explicit Findings(std::string file) : file_(std::move(file)) {}
    void add(Severity severity, Message message, int line = 0);
    Diagnostics take();
    bool has(const std::string& code) const { return counts_.count(code) != 0; }

  private:
    std::string file_;
    Diagnostics all_;
    std::map<std::string, int> counts_;
};

std::string placeText(const glm::dvec3& at);  ///< "0 1 -0.5"

/// Brings the checked mesh to the expected one's axes, size, place and start, each with a finding,
/// where that makes most of its places meet. Returns the share of its places that then do.
double align(const Expected& expected, Checked& checked, Findings& findings);

/// A triangle of the file that is expected, also with another diagonal, and how it stands there.
struct Matched {
    std::size_t triangle;     ///< of the file
    std::size_t counterpart;  ///< of Expected::triangles; one of two, where the diagonal is another
    bool isReversed = false;
};

/// Compares triangles, after vertices that are a little off got the ids that they should have.
std::vector<Matched> matchTriangles(const Expected& expected, Checked& checked, Findings& findings);

/// Compares normals and texture coordinates of the vertices of matched triangles.
void compareCorners(const Expected& expected, const Checked& checked,
                    const std::vector<Matched>& matched, Findings& findings);

}  // namespace farol::generator::compare
