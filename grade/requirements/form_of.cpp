#include "grade/requirements/form_of.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <unordered_set>
#include <vector>

#include "core/text.h"
#include "generator/call.h"
#include "generator/io/repair.h"
#include "generator/registry.h"

namespace farol::grade {
namespace {

constexpr double kRough = 4e-3;  // of the size: files with three digits

/// A mesh's vertices about the middle of its bounds, scaled to a half extent of 1.
struct Points {
    std::vector<glm::dvec3> all;
    glm::dvec3 half{0.0};  ///< extents, the largest 1

    explicit Points(const generator::Mesh& mesh) {
        glm::dvec3 low(1e300), high(-1e300);
        for (const std::uint32_t index : mesh.indices()) {
            low = glm::min(low, mesh.place(index));
            high = glm::max(high, mesh.place(index));
        }
        const glm::dvec3 middle = 0.5 * (low + high);
        half = 0.5 * (high - low);
        const double size = std::max({half.x, half.y, half.z});
        if (!(size > 0.0)) return;
        std::vector<bool> isUsed(mesh.positions().size(), false);
        for (const std::uint32_t index : mesh.indices()) isUsed[index] = true;
        for (std::size_t i = 0; i < isUsed.size(); ++i)
            if (isUsed[i]) all.push_back((mesh.place(i) - middle) / size);
        half /= size;
    }

    template <typename Test>
    bool every(Test test) const {
        return std::all_of(all.begin(), all.end(), test);
    }
    template <typename Test>
    bool any(Test test) const {
        return std::any_of(all.begin(), all.end(), test);
    }
};

bool isNear(double a, double b) { return std::abs(a - b) <= kRough; }

/// Whether a corner of the bounds is a vertex: all of them, where an extent is 0 two are one.
bool hasCorners(const Points& points) {
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 at(corner & 1 ? points.half.x : -points.half.x,
                            corner & 2 ? points.half.y : -points.half.y,
                            corner & 4 ? points.half.z : -points.half.z);
        if (!points.any([&](const glm::dvec3& p) { return glm::length(p - at) <= 2.0 * kRough; }))
            return false;
    }
    return true;
}

bool isBox(const Points& points) {
    return hasCorners(points) && points.every([&](const glm::dvec3& p) {
        return isNear(std::abs(p.x), points.half.x) || isNear(std::abs(p.y), points.half.y) ||
               isNear(std::abs(p.z), points.half.z);
    });
}

/// The vertices by their height along an axis and their distance from it.
struct Profile {
    std::vector<glm::dvec2> all;  ///< height -h..h, distance
    double height = 0.0, width = 0.0;

    Profile(const Points& points, int axis) : height(points.half[axis]) {
        for (const glm::dvec3& p : points.all) {
            const double a = p[(axis + 1) % 3], b = p[(axis + 2) % 3];
            all.emplace_back(p[axis], std::hypot(a, b));
            width = std::max(width, all.back().y);
        }
    }
    template <typename Test>
    bool every(Test test) const {
        return std::all_of(all.begin(), all.end(), test);
    }
    bool has(double at, double distance) const {
        return std::any_of(all.begin(), all.end(), [&](const glm::dvec2& p) {
            return isNear(p.x, at) && isNear(p.y, distance);
        });
    }
};

bool isCylinder(const Profile& profile) {
    return profile.has(profile.height, profile.width) &&
           profile.has(-profile.height, profile.width) && profile.every([&](const glm::dvec2& p) {
               return isNear(p.y, profile.width) || isNear(std::abs(p.x), profile.height);
           });
}

bool isCone(const Profile& profile, double up) {
    const double h = profile.height;
    return profile.has(-up * h, profile.width) && profile.has(up * h, 0.0) &&
           profile.every([&](const glm::dvec2& p) {
               return isNear(p.x, -up * h) ||
                      isNear(p.y, profile.width * (1.0 - (up * p.x + h) / (2.0 * h)));
           });
}

bool isTorus(const Profile& profile) {
    double least = profile.width;
    for (const glm::dvec2& p : profile.all) least = std::min(least, p.y);
    const double tube = 0.5 * (profile.width - least), ring = 0.5 * (profile.width + least);
    return least > 10.0 * kRough && isNear(tube, profile.height) &&
           profile.every(
               [&](const glm::dvec2& p) { return isNear(std::hypot(p.x, p.y - ring), tube); });
}

/// Whether all vertices are on the unit sphere after a division by `radii`. Coarse spheres have
/// other bounds than the exact one, so the middle may be off by half a division.
bool isBall(const std::vector<glm::dvec3>& points, const glm::dvec3& radii) {
    return std::all_of(points.begin(), points.end(),
                       [&](const glm::dvec3& p) { return isNear(glm::length(p / radii), 1.0); });
}

std::optional<std::string> ballOf(const generator::Mesh& mesh, const Points& points) {
    constexpr std::size_t kMinTriangles = 16;
    if (mesh.triangles() < kMinTriangles) return std::nullopt;
    if (isBall(points.all, glm::dvec3(1.0))) return "sphere";
    // About the origin, where meshes of spheres are made.
    std::vector<glm::dvec3> places;
    double most = 0.0;
    for (const std::uint32_t index : mesh.indices()) {
        places.push_back(mesh.place(index));
        most = std::max(most, glm::length(places.back()));
    }
    if (most > 0.0 && isBall(places, glm::dvec3(most))) return "sphere";
    if (std::min({points.half.x, points.half.y, points.half.z}) > 10.0 * kRough &&
        isBall(points.all, points.half))
        return "ellipsoid";
    return std::nullopt;
}

std::optional<std::string> formOf(const generator::Mesh& mesh) {
    const Points points(mesh);
    if (points.all.empty()) return std::nullopt;
    for (int axis = 0; axis < 3; ++axis)
        if (points.half[axis] < 1e-4)
            return hasCorners(points) ? std::optional<std::string>("plane") : std::nullopt;
    if (isBox(points)) return "box";
    for (int axis = 0; axis < 3; ++axis) {
        const Profile profile(points, axis);
        if (isCylinder(profile)) return "cylinder";
        if (isCone(profile, 1.0) || isCone(profile, -1.0)) return "cone";
    }
    if (const auto ball = ballOf(mesh, points)) return ball;
    for (int axis = 0; axis < 3; ++axis)
        if (isTorus(Profile(points, axis))) return "torus";
    return std::nullopt;
}

/// Cells of space; places are compared by cell and its neighbours.
class Cells {
  public:
    explicit Cells(double size) : size_(size) {}
    void add(const glm::dvec3& p) { cells_.insert(keyOf(cellOf(p))); }
    bool has(const glm::dvec3& p) const {
        const glm::i64vec3 cell = cellOf(p);
        for (int k = 0; k < 27; ++k)
            if (cells_.count(keyOf(cell + glm::i64vec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1))) != 0)
                return true;
        return false;
    }

  private:
    glm::i64vec3 cellOf(const glm::dvec3& p) const { return glm::i64vec3(glm::floor(p / size_)); }
    static std::uint64_t keyOf(const glm::i64vec3& cell) {
        constexpr std::uint64_t kMask = (std::uint64_t{1} << 21U) - 1;
        return (static_cast<std::uint64_t>(cell.x) & kMask) << 42U |
               (static_cast<std::uint64_t>(cell.y) & kMask) << 21U |
               (static_cast<std::uint64_t>(cell.z) & kMask);
    }
    double size_;
    std::unordered_set<std::uint64_t> cells_;
};

/// Whether the mesh's vertices are those of a patch file at some level.
bool isMadeOf(const generator::Mesh& mesh, const std::string& path, const scene::Assets& assets) {
    constexpr int kMaxLevel = 32;
    constexpr std::size_t kMaxMade = 200'000;  // triangles of all levels tried
    std::size_t spent = 0;
    for (int level = 1; level <= kMaxLevel; ++level) {
        const auto call = generator::parseCall({"patch", path, std::to_string(level)});
        const std::size_t triangles = generator::countTriangles(call, assets);
        // A file of this level has as many triangles, or fewer where it leaves out slivers.
        if (mesh.triangles() > triangles || 2 * mesh.triangles() < triangles) continue;
        spent += triangles;
        if (spent > kMaxMade) return false;
        const generator::Mesh made = generator::generate(call, assets);
        glm::dvec3 low(1e300), high(-1e300);
        for (std::size_t i = 0; i < made.positions().size(); ++i) {
            low = glm::min(low, made.place(i));
            high = glm::max(high, made.place(i));
        }
        Cells cells(std::max(1e-12, kRough * glm::length(high - low)));
        for (std::size_t i = 0; i < made.positions().size(); ++i) cells.add(made.place(i));
        std::size_t same = 0;
        for (std::size_t i = 0; i < mesh.positions().size(); ++i)
            same += cells.has(mesh.place(i)) ? 1 : 0;
        if (same == mesh.positions().size() && same > 0) return true;
    }
    return false;
}

bool isPatch(const scene::Model& model, const generator::Mesh& mesh, const scene::Scene& scene,
             const scene::Assets& assets) {
    for (const auto& [file, words] : scene.generatorComments)
        if (sameWord(baseName(file), baseName(model.file)) && !words.empty() &&
            (sameWord(words[0], "patch") || sameWord(words[0], "bezier")))
            return true;
    constexpr int kMaxFiles = 16;
    int files = 0;
    for (const std::string& path : assets.list()) {
        if (fileEnding(path) != "patch" || ++files > kMaxFiles) continue;
        try {
            if (isMadeOf(mesh, path, assets)) return true;
        } catch (const Error&) {  // a patch file that cannot be read makes no mesh
            continue;
        }
    }
    return false;
}

}  // namespace

std::string formOf(const scene::Model& model, const generator::Mesh& mesh,
                   const scene::Scene& scene, const scene::Assets& assets) {
    if (model.source.kind == scene::ModelSource::Kind::shape && model.source.shape.entry != nullptr)
        return model.source.shape.entry->name;
    if (const auto form = formOf(mesh)) return *form;
    return isPatch(model, mesh, scene, assets) ? "patch" : "file";
}

}  // namespace farol::grade
