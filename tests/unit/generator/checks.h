#pragma once

#include <array>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <utility>

#include "generator/registry.h"
#include "scene/files/assets.h"

/// Measures of meshes that share no code with the generator.
namespace checks {

using farol::generator::Mesh;
using glm::dvec3;

inline std::vector<std::string> words(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> out;
    for (std::string word; in >> word;) out.push_back(word);
    return out;
}

inline Mesh make(const std::string& text,
                 farol::scene::UvLayout uv = farol::scene::UvLayout::face) {
    return farol::generator::generate(farol::generator::parseCall(words(text)),
                                      farol::scene::BundleAssets(), uv);
}

inline std::array<dvec3, 3> corners(const Mesh& mesh, std::size_t triangle) {
    std::array<dvec3, 3> out;
    for (std::size_t k = 0; k < 3; ++k)
        out[k] = dvec3(mesh.positions()[mesh.indices()[3 * triangle + k]]);
    return out;
}

inline double volume(const Mesh& mesh) {
    double sum = 0;
    for (std::size_t t = 0; t < mesh.triangles(); ++t) {
        const auto [a, b, c] = corners(mesh, t);
        sum += glm::dot(a, glm::cross(b, c)) / 6;
    }
    return sum;
}

inline double area(const Mesh& mesh) {
    double sum = 0;
    for (std::size_t t = 0; t < mesh.triangles(); ++t) {
        const auto [a, b, c] = corners(mesh, t);
        sum += glm::length(glm::cross(b - a, c - a)) / 2;
    }
    return sum;
}

/// Every edge exactly once in each direction, positions compared bit by bit (after -0 = +0).
inline bool closedAndManifold(const Mesh& mesh) {
    using Key = std::array<float, 3>;
    std::map<std::pair<Key, Key>, int> edges;
    for (std::size_t t = 0; t < mesh.triangles(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto key = [&](std::size_t i) {
                const glm::vec3 p = mesh.positions()[mesh.indices()[3 * t + i % 3]];
                return Key{p.x + 0.0F, p.y + 0.0F, p.z + 0.0F};
            };
            ++edges[{key(k), key(k + 1)}];
        }
    }
    for (const auto& [edge, uses] : edges) {
        const auto back = edges.find({edge.second, edge.first});
        if (uses != 1 || back == edges.end() || back->second != 1) return false;
    }
    return true;
}

/// The least height of a triangle relative to its longest side.
inline double thinnest(const Mesh& mesh) {
    double least = 1;
    for (std::size_t t = 0; t < mesh.triangles(); ++t) {
        const auto [a, b, c] = corners(mesh, t);
        const double longest =
            std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
        least = std::min(least, glm::length(glm::cross(b - a, c - a)) / (longest * longest));
    }
    return least;
}

}  // namespace checks
