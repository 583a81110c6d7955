#include "generator/io/repair.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "generator/io/raw_mesh.h"
#include "generator/messages.h"

namespace farol::generator::io {
namespace {

using glm::dvec3;

/// Numbers positions so that equal ones share a number (-0 equals +0).
std::vector<std::uint32_t> weld(const std::vector<glm::vec3>& positions) {
    const auto count = static_cast<std::uint32_t>(positions.size());
    std::vector<std::uint32_t> order(count), welded(count);
    std::iota(order.begin(), order.end(), 0U);
    const auto less = [&](std::uint32_t a, std::uint32_t b) {
        const glm::vec3 &p = positions[a], &q = positions[b];
        if (p.x != q.x) return p.x < q.x;
        if (p.y != q.y) return p.y < q.y;
        return p.z < q.z;
    };
    std::sort(order.begin(), order.end(), less);
    for (std::uint32_t i = 0; i < count; ++i)
        welded[order[i]] = i > 0 && !less(order[i - 1], order[i]) ? welded[order[i - 1]] : order[i];
    return welded;
}

dvec3 faceNormal(const std::vector<glm::vec3>& p, const std::uint32_t* corner) {
    const dvec3 a(p[corner[0]]);
    return glm::cross(dvec3(p[corner[1]]) - a, dvec3(p[corner[2]]) - a);
}

/// Replaces normals of zero or infinite length, normalises the rest; returns the number replaced.
std::size_t replaceNormals(MeshArrays& mesh, const std::vector<std::uint32_t>& smooth) {
    // Files with six digits give lengths that are off by 1e-6: those stay as they are.
    constexpr double kTolerance = 1e-5;
    std::size_t replaced = 0;
    std::vector<glm::vec3> computed;
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        const double squared = glm::dot(dvec3(mesh.normals[i]), dvec3(mesh.normals[i]));
        if (squared > 0 && std::isfinite(squared)) {
            if (std::abs(squared - 1) > kTolerance)
                mesh.normals[i] = glm::vec3(dvec3(mesh.normals[i]) / std::sqrt(squared));
            continue;
        }
        if (computed.empty()) computed = vertexNormals(mesh.positions, mesh.indices, smooth);
        mesh.normals[i] = computed[i];
        ++replaced;
    }
    return replaced;
}

bool hasArea(const MeshArrays& mesh) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        if (faceNormal(mesh.positions, &mesh.indices[i]) != dvec3(0)) return true;
    return false;
}

}  // namespace

std::vector<glm::vec3> vertexNormals(const std::vector<glm::vec3>& positions,
                                     const std::vector<std::uint32_t>& indices,
                                     const std::vector<std::uint32_t>& smooth) {
    std::vector<dvec3> sums(positions.size(), dvec3(0));
    const auto groupOf = [&smooth](std::uint32_t i) { return smooth.empty() ? i : smooth[i]; };
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const dvec3 normal = faceNormal(positions, &indices[i]);
        const double length = glm::length(normal);
        if (!(length > 0)) continue;
        for (std::size_t k = 0; k < 3; ++k) sums[groupOf(indices[i + k])] += normal / length;
    }
    std::vector<glm::vec3> normals;
    normals.reserve(sums.size());
    for (std::uint32_t i = 0; i < sums.size(); ++i) {
        const dvec3& sum = sums[groupOf(i)];
        const double length = glm::length(sum);
        // Opposite faces cancel up to rounding: no direction is better than another then.
        normals.emplace_back(length > 1e-9 ? glm::vec3(sum / length) : glm::vec3(0, 1, 0));
    }
    return normals;
}

double signedVolume(const MeshArrays& mesh) {
    double volume = 0;
    const auto& p = mesh.positions;
    if (p.empty()) return 0;
    const dvec3 origin(p[0]);  // near the mesh, so that no digits are lost far from the origin
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        volume += glm::dot(dvec3(p[mesh.indices[i]]) - origin, faceNormal(p, &mesh.indices[i])) / 6;
    return volume;
}

bool isClosed(const MeshArrays& mesh) {
    const std::vector<std::uint32_t> welded = weld(mesh.positions);
    // Sorted, not hashed: a file must not choose how many edges share a bucket.
    std::vector<std::uint64_t> edges;  // lower vertex, higher vertex (31 bits), direction
    edges.reserve(mesh.indices.size());
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t v[3] = {welded[mesh.indices[i]], welded[mesh.indices[i + 1]],
                                    welded[mesh.indices[i + 2]]};
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint64_t a = v[k], b = v[(k + 1) % 3];
            edges.push_back(std::min(a, b) << 32U | std::max(a, b) << 1U | (a < b ? 1U : 0U));
        }
    }
    std::sort(edges.begin(), edges.end());
    std::int64_t balance = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        if (i > 0 && edges[i] >> 1U != edges[i - 1] >> 1U && balance != 0) return false;
        balance += (edges[i] & 1U) != 0 ? 1 : -1;
    }
    return !edges.empty() && balance == 0;
}

void repair(MeshArrays& mesh, const std::vector<std::uint32_t>& smooth, const std::string& fileName,
            Diagnostics& findings) {
    const bool given = !mesh.normals.empty();
    if (signedVolume(mesh) < 0 && isClosed(mesh)) {
        for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
            std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
        // Normals that agree with the inward faces are turned with them; normals that point
        // outwards already are correct and stay.
        double outward = 0;
        for (std::size_t i = 0; given && i + 2 < mesh.indices.size(); i += 3)
            outward += glm::dot(faceNormal(mesh.positions, &mesh.indices[i]),
                                dvec3(mesh.normals[mesh.indices[i]]));
        if (outward < 0)
            for (glm::vec3& normal : mesh.normals) normal = -normal;
        warn(findings, fileName, message<"mesh.inward">("file"_arg = uncut(fileName)));
    }
    if (!hasArea(mesh))
        warn(findings, fileName, message<"mesh.flat">("file"_arg = uncut(fileName)));
    if (!given) {
        mesh.normals = vertexNormals(mesh.positions, mesh.indices, smooth);
        return;
    }
    const std::size_t replaced = replaceNormals(mesh, smooth);
    if (replaced > 0)
        warn(findings, fileName,
             message<"mesh.normal">("count"_arg = replaced, "file"_arg = uncut(fileName)));
}

}  // namespace farol::generator::io
