#include "render/plan/coplanar.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "render/plan/batches.h"

namespace farol::render {
namespace {

constexpr std::size_t kMaxTriangles = 100'000;
constexpr double kSmallestShare = 1.0 / 64.0;
/// The share of its coordinates by which single precision may have moved a point: four of their
/// last places, in files and in vertices.
constexpr double kRounding = 5e-7;
/// The share of a face's side that two must have in common: those that only touch do not tie.
constexpr double kTouch = 1e-6;

struct Gathered {
    glm::dvec3 areaNormal{0.0};
    std::vector<std::uint32_t> corners;
};

/// A rectangle round the points, in the plane of the unit normal: along the longest line of its
/// first triangle, so that the rectangles of rectangles are exact.
FlatFace rectangleRound(const std::vector<std::uint32_t>& corners,
                        const std::vector<glm::vec3>& positions, const glm::dvec3& normal) {
    const glm::dvec3 a(positions[corners[0]]), b(positions[corners[1]]), c(positions[corners[2]]);
    // Of a halved rectangle the two shorter sides are its own.
    const std::array<glm::dvec3, 3> sides{b - a, c - b, a - c};
    const auto shorter = [](const glm::dvec3& x, const glm::dvec3& y) {
        return glm::dot(x, x) < glm::dot(y, y);
    };
    const glm::dvec3 side = *std::min_element(sides.begin(), sides.end(), shorter);
    const glm::dvec3 right = glm::normalize(side - normal * glm::dot(side, normal));
    const glm::dvec3 up = glm::cross(normal, right);
    glm::dvec2 low(std::numeric_limits<double>::max()), high(-low);
    for (const std::uint32_t corner : corners) {
        const glm::dvec3 from = glm::dvec3(positions[corner]) - a;
        const glm::dvec2 at(glm::dot(from, right), glm::dot(from, up));
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    const auto corner = [&](double x, double y) { return a + right * x + up * y; };
    return {{corner(low.x, low.y), corner(high.x, low.y), corner(high.x, high.y),
             corner(low.x, high.y)}};
}

/// True where flat opaque faces of the two in one plane have the same colour at each point.
bool looksAlike(const DrawItem& a, const DrawItem& b, const FrameStyle& style) {
    const bool byPixel =
        style.shading == scene::Shading::phong || style.shading == scene::Shading::solid;
    return byPixel && style.layer == Layer::color && a.texture < 0 && !a.colored &&
           a.opacity == 1.0F && a.lightSet == b.lightSet && sameMaterial(a, b);
}

}  // namespace

std::vector<FlatFace> flatFacesOf(const generator::Mesh& mesh) {
    const std::vector<glm::vec3>& positions = mesh.positions();
    const std::vector<std::uint32_t>& indices = mesh.indices();
    if (positions.empty() || mesh.triangles() > kMaxTriangles) return {};
    glm::dvec3 low(positions[0]), high(positions[0]);
    for (const glm::vec3& position : positions) {
        low = glm::min(low, glm::dvec3(position));
        high = glm::max(high, glm::dvec3(position));
    }
    const double size = glm::length(high - low);
    if (!(size > 0.0)) return {};
    // A plane that falls on two cells gives two faces, each large enough or left out.
    constexpr double kCells = 4096.0;
    std::map<std::array<int, 4>, Gathered> planes;
    double area = 0.0;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::dvec3 a(positions[indices[i]]);
        const glm::dvec3 normal = glm::cross(glm::dvec3(positions[indices[i + 1]]) - a,
                                             glm::dvec3(positions[indices[i + 2]]) - a);
        const double length = glm::length(normal);
        if (!(length > 0.0)) continue;
        area += length;
        const glm::dvec3 unit = normal / length;
        const auto cell = [](double value) {
            return static_cast<int>(std::lround(value * kCells));
        };
        Gathered& plane = planes[{cell(unit.x), cell(unit.y), cell(unit.z),
                                  cell(glm::dot(unit, a - low) / size)}];
        plane.areaNormal += normal;
        plane.corners.insert(plane.corners.end(), {indices[i], indices[i + 1], indices[i + 2]});
    }
    std::vector<FlatFace> faces;
    for (const auto& [key, plane] : planes) {
        const double share = glm::length(plane.areaNormal);
        if (share >= kSmallestShare * area)
            faces.push_back(rectangleRound(plane.corners, positions, plane.areaNormal / share));
    }
    return faces;
}

void CoplanarFaces::add(const MeshData& mesh, const glm::dmat4& viewFromObject,
                        const DrawItem& item, std::size_t index) {
    for (const FlatFace& flat : mesh.flats) {
        Face face;
        double reach = 0.0;
        for (std::size_t i = 0; i < 4; ++i) {
            // Seen from the front the corners go round counter-clockwise.
            const std::size_t from = item.mirrored ? 3 - i : i;
            face.corners[i] = glm::dvec3(viewFromObject * glm::dvec4(flat.corners[from], 1.0));
            reach = std::max(reach, glm::length(face.corners[i]));
        }
        const glm::dvec3 normal =
            glm::cross(face.corners[1] - face.corners[0], face.corners[3] - face.corners[0]);
        const double length = glm::length(normal);
        if (!(length > 0.0)) continue;
        face.normal = normal / length;
        face.distance = -glm::dot(face.normal, face.corners[0]);
        face.slack = kRounding * reach;
        if (!(face.distance > 0.0)) continue;  // only its back is seen
        face.item = static_cast<std::uint32_t>(index);
        face.model = item.id;
        faces_.push_back(face);
    }
}

bool CoplanarFaces::isCoplanar(const Face& a, const Face& b) {
    if (glm::dot(a.normal, b.normal) < 0.5) return false;
    // The smaller one lies in the plane of the larger one.
    const auto lies = [](const Face& in, const Face& face) {
        return std::all_of(face.corners.begin(), face.corners.end(), [&](const glm::dvec3& at) {
            return std::abs(glm::dot(in.normal, at) + in.distance) <= face.slack;
        });
    };
    return a.slack < b.slack ? lies(b, a) : lies(a, b);
}

bool CoplanarFaces::overlap(const Face& a, const Face& b) {
    // Convex and in one plane: apart where a line along a side parts them.
    const auto parts = [](const Face& from, const Face& other) {
        for (std::size_t i = 0; i < 4; ++i) {
            const glm::dvec3 across =
                glm::cross(from.normal, from.corners[(i + 1) % 4] - from.corners[i]);
            const double width = glm::dot(across, from.corners[(i + 2) % 4] - from.corners[i]);
            double most = -std::numeric_limits<double>::max();
            for (const glm::dvec3& corner : other.corners)
                most = std::max(most, glm::dot(across, corner - from.corners[i]));
            if (most <= kTouch * width) return true;
        }
        return false;
    };
    return !parts(a, b) && !parts(b, a);
}

int CoplanarFaces::rank(std::vector<DrawItem>& items, const FrameStyle& style) {
    // Their depths and normals are the same.
    if (style.layer == Layer::depth || style.layer == Layer::normal) return 0;
    std::sort(faces_.begin(), faces_.end(), [](const Face& a, const Face& b) {
        const double first = a.distance - a.slack, second = b.distance - b.slack;
        return first != second ? first < second : a.item < b.item;
    });
    struct Pair {
        std::uint32_t later, earlier;
    };
    std::vector<Pair> pairs;
    std::size_t compared = 0;
    for (std::size_t i = 0; i < faces_.size() && compared < kMaxPairs; ++i) {
        const Face& a = faces_[i];
        for (std::size_t j = i + 1; j < faces_.size() && compared < kMaxPairs; ++j, ++compared) {
            const Face& b = faces_[j];
            if (b.distance - b.slack > a.distance + a.slack) break;
            if (a.model != b.model && isCoplanar(a, b) && overlap(a, b) &&
                !looksAlike(items[a.item], items[b.item], style))
                pairs.push_back({std::max(a.item, b.item), std::min(a.item, b.item)});
        }
    }
    std::sort(pairs.begin(), pairs.end(),
              [](const Pair& a, const Pair& b) { return a.later < b.later; });
    int ranked = 0;
    for (const Pair& pair : pairs) {
        int& rank = items[pair.later].depthRank;
        if (rank == 0) ++ranked;
        rank = std::max(rank, std::min(kMaxRank, items[pair.earlier].depthRank + 1));
    }
    return ranked;
}

}  // namespace farol::render
