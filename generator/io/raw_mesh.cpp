#include "generator/io/raw_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace farol::generator::io {
namespace {

/// A range of numbers along one axis.
struct Range {
    double low = HUGE_VAL, high = -HUGE_VAL;

    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    double size() const { return high - low; }
    double middle() const { return low + (high - low) / 2; }
};

/// Whole turns to take off: 0 where a float holds the coordinates well enough.
double turnsOf(const Range& range) {
    constexpr double kFar = 32.0;  // up to here a float resolves 1/100 of a texel of 4096
    const double middle = range.middle();
    const bool far = std::abs(middle) > std::max(kFar, 8.0 * range.size());
    return far && std::isfinite(middle) ? std::floor(middle) : 0.0;
}

std::vector<glm::vec2> settleUvs(RawMesh& raw, glm::dvec2& turns) {
    Range u, v;
    std::size_t lost = 0;
    for (glm::dvec2& uv : raw.uvs) {
        if (std::isnan(uv.x) || std::isnan(uv.y)) {
            uv = glm::dvec2(0.0);
            ++lost;
            continue;  // not part of the range
        }
        u.add(uv.x);
        v.add(uv.y);
    }
    if (lost > 0) raw.leftOut["texture coordinates that are no numbers"] += lost;
    if (u.low <= u.high) turns = {turnsOf(u), turnsOf(v)};
    std::vector<glm::vec2> out;
    out.reserve(raw.uvs.size());
    for (const glm::dvec2& uv : raw.uvs) out.emplace_back(uv - turns);
    return out;
}

}  // namespace

glm::dvec3 originOf(const std::vector<glm::dvec3>& positions) {
    constexpr double kFar = 64.0;  // sizes: up to here a float resolves 1/250,000 of the mesh
    Range range[3];
    for (const glm::dvec3& p : positions)
        for (int k = 0; k < 3; ++k) range[k].add(p[k]);
    if (positions.empty()) return glm::dvec3(0.0);
    const glm::dvec3 middle(range[0].middle(), range[1].middle(), range[2].middle());
    const double size = std::max({range[0].size(), range[1].size(), range[2].size()});
    const double away = std::max({std::abs(middle.x), std::abs(middle.y), std::abs(middle.z)});
    if (!(away > kFar * size) || !std::isfinite(away)) return glm::dvec3(0.0);
    if (size == 0.0) return middle;
    const double grid = std::exp2(std::ceil(std::log2(size)) + 1.0);
    glm::dvec3 origin;
    // A multiple of the grid is exact unless the mesh is so far away that its own places are not.
    for (int k = 0; k < 3; ++k) origin[k] = std::nearbyint(middle[k] / grid) * grid;
    return origin;
}

MeshArrays settle(RawMesh& raw) {
    MeshArrays mesh;
    const std::size_t count = raw.positions.size();
    const auto isGroup = [count](std::uint32_t group) { return group < count; };
    if (!raw.smooth.empty() &&
        (raw.smooth.size() != count || !std::all_of(raw.smooth.begin(), raw.smooth.end(), isGroup)))
        throw std::logic_error("a reader's smoothing groups are out of range");
    mesh.origin = originOf(raw.positions);
    mesh.positions.reserve(raw.positions.size());
    if (mesh.origin == glm::dvec3(0.0))
        for (const glm::dvec3& p : raw.positions) mesh.positions.emplace_back(p);
    else
        for (const glm::dvec3& p : raw.positions) mesh.positions.emplace_back(p - mesh.origin);
    raw.positions = {};
    mesh.uvs = settleUvs(raw, mesh.uvOrigin);
    raw.uvs = {};
    mesh.normals = std::move(raw.normals);
    mesh.colors = std::move(raw.colors);
    mesh.indices = std::move(raw.indices);
    mesh.parts = std::move(raw.parts);
    return mesh;
}

std::uint8_t channelOf(double value, double most) {
    if (!(value > 0.0)) return 0;
    return static_cast<std::uint8_t>(std::lround(std::min(value / most, 1.0) * 255.0));
}

void warn(Diagnostics& findings, const std::string& file, Message message) {
    findings.push_back(diagnosticOf(Severity::warning, std::move(message), {file, 0, 0}));
}

void splitByColor(RawMesh& raw, const std::vector<glm::u8vec4>& colors) {
    const std::size_t corners = raw.indices.size();
    const auto keyOf = [&](std::uint32_t corner) {
        const glm::u8vec4& c = colors[corner / 3];
        return std::pair(raw.indices[corner], c.r << 24U | c.g << 16U | c.b << 8U | c.a);
    };
    // Sorted, not hashed: a file must not choose how many corners share a bucket.
    std::vector<std::uint32_t> order(corners), vertexOf(corners);
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const auto left = keyOf(a), right = keyOf(b);
        return left != right ? left < right : a < b;
    });
    for (std::size_t i = 0; i < corners; ++i) {  // to the first use of an equal corner
        const bool equal = i > 0 && keyOf(order[i]) == keyOf(order[i - 1]);
        vertexOf[order[i]] = equal ? vertexOf[order[i - 1]] : order[i];
    }
    RawMesh split;
    constexpr std::uint32_t kNone = ~0U;
    std::vector<std::uint32_t> groups(raw.positions.size(), kNone);
    for (std::size_t i = 0; i < corners; ++i) {
        const std::size_t first = vertexOf[i];
        if (first == i) {
            const std::uint32_t from = raw.indices[i];
            vertexOf[i] = static_cast<std::uint32_t>(split.positions.size());
            split.positions.push_back(raw.positions[from]);
            if (!raw.normals.empty()) split.normals.push_back(raw.normals[from]);
            if (!raw.uvs.empty()) split.uvs.push_back(raw.uvs[from]);
            split.colors.push_back(colors[i / 3]);
            // The group is named by its first vertex.
            std::uint32_t& group = groups[raw.smooth.empty() ? from : raw.smooth[from]];
            if (group == kNone) group = vertexOf[i];
            split.smooth.push_back(group);
        }
        split.indices.push_back(vertexOf[first]);
    }
    split.leftOut = std::move(raw.leftOut);
    split.findings = std::move(raw.findings);
    raw = std::move(split);
}

}  // namespace farol::generator::io
