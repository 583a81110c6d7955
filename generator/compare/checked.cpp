#include "generator/compare/checked.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/number.h"
#include "generator/compare/messages.h"

namespace farol::generator::compare {
namespace {

constexpr double kReach = 5e-4;  // of the diagonal

double reachOf(const Mesh& mesh, glm::dvec3& low, glm::dvec3& high) {
    low = glm::dvec3(1e300);
    high = glm::dvec3(-1e300);
    for (std::size_t i = 0; i < mesh.positions().size(); ++i) {
        low = glm::min(low, mesh.place(i));
        high = glm::max(high, mesh.place(i));
    }
    const double diagonal = std::max(glm::length(high - low), 1e-12);
    double shortest = diagonal;
    const std::vector<std::uint32_t>& indices = mesh.indices();
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) {
            const double length =
                glm::length(mesh.place(indices[i + k]) - mesh.place(indices[i + (k + 1) % 3]));
            if (length > 1e-6 * diagonal) shortest = std::min(shortest, length);
        }
    return std::min(kReach * diagonal, 0.25 * shortest);
}

glm::dvec3 turnedAboutY(const glm::dvec3& at, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * at.x + s * at.z, at.y, -s * at.x + c * at.z};
}

/// The number of equal places round the axis, where turns by that part bring all places to others.
int foldOf(const Places& places) {
    constexpr int kMinFold = 5, kMaxFold = 512;
    const std::vector<glm::dvec3>& all = places.all();
    std::size_t far = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (std::hypot(all[i].x, all[i].z) > std::hypot(all[far].x, all[far].z)) far = i;
    if (all.empty()) return 0;
    const double width = std::hypot(all[far].x, all[far].z);
    int count = 0;
    for (const glm::dvec3& at : all)
        if (std::abs(at.y - all[far].y) <= places.reach() &&
            std::abs(std::hypot(at.x, at.z) - width) <= places.reach())
            ++count;
    if (count < kMinFold || count > kMaxFold) return 0;
    const double angle = 2.0 * 3.14159265358979323846 / count;
    for (const glm::dvec3& at : all)
        if (places.find(turnedAboutY(at, angle)) < 0) return 0;
    return count;
}

}  // namespace

Triangle rotated(const Triangle& triangle) {
    Triangle out = triangle;
    std::rotate(out.begin(), std::min_element(out.begin(), out.end()), out.end());
    return out;
}

Triangle reversed(const Triangle& triangle) {
    return rotated({triangle[0], triangle[2], triangle[1]});
}

glm::i64vec3 Places::cellOf(const glm::dvec3& at) const {
    return glm::i64vec3(glm::floor(at / (2.0 * reach_)));
}

std::uint64_t Places::keyOf(const glm::i64vec3& cell) {
    constexpr std::uint64_t kMask = (std::uint64_t{1} << 21U) - 1;
    return (static_cast<std::uint64_t>(cell.x) & kMask) << 42U |
           (static_cast<std::uint64_t>(cell.y) & kMask) << 21U |
           (static_cast<std::uint64_t>(cell.z) & kMask);
}

int Places::find(const glm::dvec3& at) const {
    int best = -1;
    double least = reach_;
    const glm::i64vec3 cell = cellOf(at);
    for (int k = 0; k < 27; ++k) {
        const auto found =
            cells_.find(keyOf(cell + glm::i64vec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1)));
        if (found == cells_.end()) continue;
        for (const int id : found->second) {
            const double away = glm::length(all_[static_cast<std::size_t>(id)] - at);
            if (away > least) continue;
            least = away;
            best = id;
        }
    }
    return best;
}

int Places::add(const glm::dvec3& at) {
    if (const int known = find(at); known >= 0) return known;
    all_.push_back(at);
    const int id = static_cast<int>(all_.size()) - 1;
    cells_[keyOf(cellOf(at))].push_back(id);
    return id;
}

Expected::Expected(const Mesh& of) : mesh(of), places(reachOf(of, low, high)) {
    for (std::size_t i = 0; i < mesh.positions().size(); ++i)
        idOf.push_back(places.add(mesh.place(i)));
    const std::vector<std::uint32_t>& indices = mesh.indices();
    std::set<Triangle> known;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const Triangle triangle{idOf[indices[i]], idOf[indices[i + 1]], idOf[indices[i + 2]]};
        if (!hasArea(triangle) || !known.insert(rotated(triangle)).second) continue;
        triangles.push_back(triangle);
        sources.push_back(i / 3);
    }
    fold = foldOf(places);
}

std::string placeText(const glm::dvec3& at) {
    std::string out;
    for (int axis = 0; axis < 3; ++axis) {
        const double value = std::round(at[axis] * 1e5) / 1e5;
        out += (axis > 0 ? " " : "") + formatNumber(value == 0.0 ? 0.0 : value);
    }
    return out;
}

int Checked::lineOf(int id) const {
    const auto found = firstLines.find(id);
    return found == firstLines.end() ? 0 : found->second;
}

std::string Checked::lineList(const Triangle& triangle) const {
    std::string out;
    for (const int id : triangle) out += (out.empty() ? "" : ", ") + std::to_string(lineOf(id));
    return out;
}

void Findings::add(Severity severity, Message message, int line) {
    constexpr int kShown = 6;
    const std::string code = message.code();
    if (++counts_[code] > kShown) return;
    all_.push_back(diagnosticOf(severity, std::move(message), {file_, line, 0}));
}

Diagnostics Findings::take() {
    constexpr int kShown = 6;
    Diagnostics out;
    for (std::size_t i = 0; i < all_.size(); ++i) {
        out.push_back(all_[i]);
        const int count = counts_[all_[i].code];
        const bool isLast =
            std::none_of(all_.begin() + static_cast<std::ptrdiff_t>(i) + 1, all_.end(),
                         [&](const Diagnostic& later) { return later.code == all_[i].code; });
        if (isLast && count > kShown)
            out.push_back(diagnosticOf(all_[i].severity,
                                       checkMessage<"check.more">("count"_arg = count - kShown),
                                       {file_, 0, 0}));
    }
    return out;
}

}  // namespace farol::generator::compare
