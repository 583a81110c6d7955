#include "grade/requirements/solids.h"

#include <algorithm>
#include <cmath>

#include "generator/io/repair.h"

namespace farol::grade {
namespace {

constexpr std::size_t kSamples = 24;  // vertices of an object that are tried

bool holds(const render::Box& outer, const render::Box& inner) {
    return !outer.empty() && !inner.empty() && glm::all(glm::lessThanEqual(outer.min, inner.min)) &&
           glm::all(glm::greaterThanEqual(outer.max, inner.max));
}

/// Whether a ray from `from` meets the triangle (Moeller and Trumbore 1997).
bool meets(const glm::dvec3& from, const glm::dvec3& way, const glm::dvec3& a, const glm::dvec3& b,
           const glm::dvec3& c) {
    const glm::dvec3 ab = b - a, ac = c - a, p = glm::cross(way, ac);
    const double det = glm::dot(ab, p);
    if (det == 0.0) return false;
    const glm::dvec3 t = from - a, q = glm::cross(t, ab);
    const double u = glm::dot(t, p) / det, v = glm::dot(way, q) / det;
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && glm::dot(ac, q) / det > 0.0;
}

}  // namespace

Solids::Solids(const Inventory& inventory, std::vector<double> timesS, std::vector<glm::dvec3> eyes)
    : inventory_(inventory), timesS_(std::move(timesS)), eyes_(std::move(eyes)) {
    for (const double timeS : timesS_) {
        std::vector<glm::dmat4>& worlds = worlds_.emplace_back();
        std::vector<render::Box>& boxes = boxes_.emplace_back();
        for (const Inventory::Object& object : inventory.objects()) {
            worlds.push_back(inventory.matrix(object.node, -1, timeS));
            render::Box& box = boxes.emplace_back();
            const render::Box& local = object.mesh->bounds;
            for (int i = 0; i < 8 && !local.empty(); ++i)
                box.add(glm::dvec3(worlds.back() *
                                   glm::dvec4(object.mesh->mesh.origin() + local.corner(i), 1.0)));
        }
    }
}

bool Solids::isClosed(std::size_t object) {
    const render::MeshData& data = *inventory_.objects()[object].mesh;
    const auto known = closed_.find(data.id);
    if (known != closed_.end()) return known->second;
    return closed_.emplace(data.id, generator::io::isClosed(data.mesh.arrays())).first->second;
}

bool Solids::hasInside(std::size_t solid, const glm::dvec3& world, std::size_t time) const {
    const generator::Mesh& mesh = inventory_.objects()[solid].mesh->mesh;
    const glm::dmat4& matrix = worlds_[time][solid];
    if (std::abs(glm::determinant(glm::dmat3(matrix))) < 1e-30) return false;
    const glm::dvec3 from = glm::dvec3(glm::inverse(matrix) * glm::dvec4(world, 1.0));
    const glm::dvec3 way(0.5351, 0.7129, 0.4537);  // along no edge that shapes have
    bool isOdd = false;
    const std::vector<std::uint32_t>& indices = mesh.indices();
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
        if (meets(from, way, mesh.place(indices[i]), mesh.place(indices[i + 1]),
                  mesh.place(indices[i + 2])))
            isOdd = !isOdd;
    return isOdd;
}

bool Solids::isInside(std::size_t object, std::size_t other, std::size_t time) {
    if (!holds(boxes_[time][other], boxes_[time][object]) || !isClosed(other)) return false;
    if (hasInside(other, eyes_[time], time)) return false;
    const generator::Mesh& mesh = inventory_.objects()[object].mesh->mesh;
    const std::size_t count = mesh.positions().size();
    const std::size_t step = std::max<std::size_t>(1, count / kSamples);
    for (std::size_t i = 0; i < count; i += step) {
        const glm::dvec3 at = glm::dvec3(worlds_[time][object] * glm::dvec4(mesh.place(i), 1.0));
        if (!hasInside(other, at, time)) return false;
    }
    return count > 0;
}

std::optional<std::size_t> Solids::around(std::size_t object) {
    for (std::size_t other = 0; other < inventory_.objects().size(); ++other) {
        if (other == object) continue;
        bool always = true;
        for (std::size_t time = 0; time < timesS_.size() && always; ++time)
            always = isInside(object, other, time);
        if (always) return other;
    }
    return std::nullopt;
}

}  // namespace farol::grade
