#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>
#include <set>

#include "generator/compare/checked.h"
#include "generator/compare/messages.h"

namespace farol::generator::compare {
namespace {

constexpr double kMost = 0.9;  // of the places: then a change explains the mesh

/// The places of the file's vertices that triangles use, each once, and the share that is expected.
class Cloud {
  public:
    Cloud(const Expected& expected, const Checked& checked) : expected_(expected) {
        Places once(expected.places.reach());
        for (const std::uint32_t index : checked.arrays.indices) once.add(checked.at[index]);
        all_ = once.all();
    }
    const std::vector<glm::dvec3>& all() const { return all_; }

    double share(const glm::dmat4& matrix) const {
        std::set<int> hit;
        std::size_t met = 0;
        for (const glm::dvec3& at : all_) {
            const int id = expected_.places.find(glm::dvec3(matrix * glm::dvec4(at, 1.0)));
            if (id < 0) continue;
            ++met;
            hit.insert(id);
        }
        if (all_.empty()) return 0.0;
        // Places that fall together explain nothing.
        return static_cast<double>(std::min(met, hit.size())) / static_cast<double>(all_.size());
    }
    void bounds(const glm::dmat4& matrix, glm::dvec3& low, glm::dvec3& high) const {
        low = glm::dvec3(1e300);
        high = glm::dvec3(-1e300);
        for (const glm::dvec3& at : all_) {
            const glm::dvec3 moved(matrix * glm::dvec4(at, 1.0));
            low = glm::min(low, moved);
            high = glm::max(high, moved);
        }
    }

  private:
    const Expected& expected_;
    std::vector<glm::dvec3> all_;
};

struct Axes {
    glm::dmat4 matrix{0.0};
    std::string text;
};

/// The ways to exchange and mirror axes but for none.
std::vector<Axes> otherAxes() {
    std::vector<Axes> out;
    const int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    for (const auto& order : orders)
        for (int signs = 0; signs < 8; ++signs) {
            Axes axes;
            for (int row = 0; row < 3; ++row) {
                const bool isNegative = (signs >> row & 1) != 0;
                axes.matrix[order[row]][row] = isNegative ? -1.0 : 1.0;
                axes.text +=
                    std::string(row > 0 ? " " : "") + (isNegative ? "-" : "") + "xyz"[order[row]];
            }
            axes.matrix[3][3] = 1.0;
            if (axes.text != "x y z") out.push_back(std::move(axes));
        }
    // Turns before mirror images, which many shapes equal, and fewer changes first.
    const auto rank = [](const Axes& axes) {
        const bool isMirror = glm::determinant(glm::dmat3(axes.matrix)) < 0.0;
        return (isMirror ? 4 : 0) + std::count(axes.text.begin(), axes.text.end(), '-');
    };
    std::stable_sort(out.begin(), out.end(),
                     [&](const Axes& a, const Axes& b) { return rank(a) < rank(b); });
    return out;
}

/// Brings the bounds to the expected ones.
glm::dmat4 fit(const Expected& expected, const Cloud& cloud, bool isScaled) {
    glm::dvec3 low, high;
    cloud.bounds(glm::dmat4(1.0), low, high);
    glm::dvec3 scale(1.0);
    for (int axis = 0; axis < 3 && isScaled; ++axis) {
        const double mine = high[axis] - low[axis];
        const double theirs = expected.high[axis] - expected.low[axis];
        if (mine > expected.places.reach() && theirs > expected.places.reach())
            scale[axis] = theirs / mine;
    }
    const glm::dvec3 middle = 0.5 * (low + high), wanted = 0.5 * (expected.low + expected.high);
    glm::dmat4 out = glm::translate(glm::dmat4(1.0), wanted);
    out = glm::scale(out, scale);
    return glm::translate(out, -middle);
}

/// The turn about y, where a round shape starts at another angle.
std::optional<double> startOf(const Expected& expected, const Cloud& cloud) {
    if (expected.fold == 0 || cloud.all().empty()) return std::nullopt;
    const double step = 2.0 * 3.14159265358979323846 / expected.fold;
    const auto farthest = std::max_element(
        cloud.all().begin(), cloud.all().end(), [](const glm::dvec3& a, const glm::dvec3& b) {
            return std::hypot(a.x, a.z) < std::hypot(b.x, b.z) - 1e-9;
        });
    for (const glm::dvec3& at : expected.places.all()) {
        if (std::abs(at.y - farthest->y) > expected.places.reach()) continue;
        const double turn = std::fmod(
            std::atan2(at.x, at.z) - std::atan2(farthest->x, farthest->z) + 8.0 * step, step);
        const glm::dmat4 matrix = glm::rotate(glm::dmat4(1.0), turn, glm::dvec3(0, 1, 0));
        if (cloud.share(matrix) >= kMost) return turn;
    }
    return std::nullopt;
}

void apply(const glm::dmat4& matrix, Checked& checked) {
    for (glm::dvec3& at : checked.at) at = glm::dvec3(matrix * glm::dvec4(at, 1.0));
    const glm::dmat3 normalMatrix = glm::inverseTranspose(glm::dmat3(matrix));
    for (glm::vec3& normal : checked.arrays.normals) {
        const double length = glm::length(glm::dvec3(normal));
        const glm::dvec3 turned = normalMatrix * glm::dvec3(normal);
        if (glm::length(turned) > 0.0)
            normal = glm::vec3(length * glm::normalize(turned));  // keeps a wrong length
    }
    // A mirror image has its triangles the other way round.
    if (glm::determinant(glm::dmat3(matrix)) >= 0.0) return;
    for (std::size_t i = 0; i + 2 < checked.arrays.indices.size(); i += 3)
        std::swap(checked.arrays.indices[i + 1], checked.arrays.indices[i + 2]);
}

}  // namespace

double align(const Expected& expected, Checked& checked, Findings& findings) {
    const Cloud cloud(expected, checked);
    const double asItIs = cloud.share(glm::dmat4(1.0));
    if (asItIs >= kMost) return asItIs;
    if (const std::optional<double> turn = startOf(expected, cloud)) {
        const glm::dmat4 matrix = glm::rotate(glm::dmat4(1.0), *turn, glm::dvec3(0, 1, 0));
        findings.add(Severity::info,
                     checkMessage<"check.turned">("degrees"_arg = glm::degrees(*turn)));
        apply(matrix, checked);
        return cloud.share(matrix);
    }
    for (const Axes& axes : otherAxes()) {
        const double share = cloud.share(axes.matrix);
        if (share < kMost || share <= asItIs) continue;
        findings.add(Severity::error, checkMessage<"check.axes">("found"_arg = axes.text));
        apply(axes.matrix, checked);
        return share;
    }
    glm::dvec3 low, high;
    cloud.bounds(glm::dmat4(1.0), low, high);
    for (const bool isScaled : {false, true}) {
        const glm::dmat4 matrix = fit(expected, cloud, isScaled);
        const double share = cloud.share(matrix);
        if (share < kMost) continue;
        if (isScaled)
            findings.add(Severity::error,
                         checkMessage<"check.size">(
                             "found"_arg = placeText(high - low),
                             "expected"_arg = placeText(expected.high - expected.low)));
        const glm::dvec3 mine = 0.5 * (low + high), theirs = 0.5 * (expected.low + expected.high);
        const bool isMoved = glm::length(mine - theirs) > expected.places.reach() && !isScaled;
        if (isMoved)
            findings.add(Severity::error,
                         checkMessage<"check.place">("found"_arg = placeText(mine),
                                                     "expected"_arg = placeText(theirs)));
        apply(matrix, checked);
        return share;
    }
    return asItIs;
}

}  // namespace farol::generator::compare
