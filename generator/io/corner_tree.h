#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

namespace farol::generator::io {

/// Twice the area of a, b, c: positive where they turn left, 0 where they lie in one line.
/// Differences of floats are exact in double unless they are of very different size.
inline double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// A triangle that turns left, a query of CornerTree. Closed: its edges count as inside.
struct EarTriangle {
    glm::dvec2 a, b, c;
    bool closed;

    /// False at its corners: faces with holes go through some corners twice.
    bool contains(const glm::dvec2& p) const;
    /// False only where no point of the box is inside.
    bool meets(const glm::dvec2& low, const glm::dvec2& high) const;
};

/// The corners of a face that can be inside a triangle of others: a k-d tree of their places, from
/// which corners are removed. A query takes about the square root of the number of places, however
/// the corners lie: all in one line or at one place.
class CornerTree {
  public:
    CornerTree(const std::vector<glm::dvec2>& corners, const std::vector<bool>& included);

    /// Precondition: the corner was included, and has not been removed.
    void remove(std::size_t corner);
    bool anyIn(const EarTriangle& triangle) const { return !nodes_.empty() && anyIn(triangle, 0); }

  private:
    struct Place {
        glm::dvec2 at;
        std::uint32_t corners;  ///< number left here
        std::uint32_t leaf;
    };
    struct Node {
        glm::dvec2 low, high;
        std::uint32_t begin, end;  ///< places
        std::uint32_t second;      ///< the other child; the first follows its parent; 0: a leaf
        std::uint32_t parent;
        std::uint32_t corners;  ///< number left below it
    };

    std::uint32_t build(std::uint32_t begin, std::uint32_t end, std::uint32_t parent);
    bool anyIn(const EarTriangle& triangle, std::uint32_t node) const;

    std::vector<Place> places_;
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> placeOf_;  ///< of each corner included
};

}  // namespace farol::generator::io
