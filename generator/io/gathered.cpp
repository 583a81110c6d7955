#include "generator/io/gathered.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/text.h"
#include "generator/io/formats.h"
#include "generator/io/rows.h"
#include "generator/messages.h"

namespace farol::generator::io {
namespace {

struct RoleWords {
    Role role;
    std::vector<std::string_view> words;
};

const std::vector<RoleWords>& roleWords() {
    static const std::vector<RoleWords> made = {
        {Role::positions,
         {"v",      "p",     "vertex",      "vertexes",    "vertices",      "vertice",
          "verts",  "vert",  "position",    "positions",   "pos",           "point",
          "points", "ponto", "pontos",      "punto",       "puntos",        "vertexs",
          "coords", "coord", "coordinates", "coordenadas", "pontosvertices"}},
        {Role::normals, {"n", "vn", "normal", "normals", "normais", "normales", "norm", "norms"}},
        {Role::uvs,
         {"t", "vt", "uv", "uvs", "tex", "texcoord", "texcoords", "texture", "textures", "textura",
          "texturas", "texturecoords", "texturecoordinates", "st"}},
        {Role::indices,
         {"i", "f", "face", "faces", "index", "indexes", "indices", "indice", "idx", "tri", "tris",
          "triangle", "triangles", "triangulo", "triangulos", "elements"}},
        {Role::component,
         {"x",     "y",       "z",       "nx",      "ny",   "nz",   "u",     "s",
          "px",    "py",      "pz",      "posx",    "posy", "posz", "normx", "normy",
          "normz", "normalx", "normaly", "normalz", "tu",   "tv",   "texx",  "texy"}},
    };
    return made;
}

bool isUnit(const double* v) {
    const double squared = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    return std::abs(squared - 1.0) < 0.02;
}

}  // namespace

Role componentOf(std::string_view word, Role list) {
    const std::string lower = lowerCase(word.substr(0, 24));
    const bool plain = lower == "x" || lower == "y" || lower == "z";
    if (plain && (list == Role::normals || list == Role::uvs)) return list;
    if (plain || lower[0] == 'p') return Role::positions;
    return lower[0] == 'n' ? Role::normals : Role::uvs;
}

Role roleOf(std::string_view word) {
    std::string lower = lowerCase(word.substr(0, 24));
    while (lower.size() > 1 && isDigit(lower.back())) lower.pop_back();  // "v1:", "Triangle2"
    for (const RoleWords& row : roleWords())
        for (const std::string_view known : row.words)
            if (lower == known) return row.role;
    return Role::none;
}

void Gathered::add(Role role, const std::vector<double>& run, int line) {
    const std::size_t count = run.size();
    if (count == 0) return;
    lastLine_ = std::max(lastLine_, line);
    switch (role) {
        case Role::positions: {
            if (count == 1) return;  // how many follow
            if (positions_.empty()) firstPosition_ = line;
            const bool withNormal = count == 8 || (count == 6 && isUnit(&run[3]));
            const bool withUv = count == 8 || count == 5;
            const std::size_t places = withNormal || withUv ? 3 : count;
            for (std::size_t k = 0; k < places; ++k) {
                if (std::isnan(run[k])) fail(message<"mesh.number/nan">(), line);
                positions_.push_back(run[k]);
            }
            if (withNormal) normals_.insert(normals_.end(), run.begin() + 3, run.begin() + 6);
            if (withUv) uvs_.insert(uvs_.end(), run.end() - 2, run.end());
            return;
        }
        case Role::normals:
            if (count > 1) normals_.insert(normals_.end(), run.begin(), run.end());
            return;
        case Role::uvs:
            if (count > 1) uvs_.insert(uvs_.end(), run.begin(), run.end());
            return;
        case Role::indices:
            if (indices_.empty()) firstIndex_ = line;
            // "Triangle 1: " and nine coordinates.
            indices_.insert(indices_.end(), run.begin() + (count == 10 ? 1 : 0), run.end());
            if (indexRuns_.size() < 2) indexRuns_.push_back(count);
            return;
        case Role::none:
        case Role::component:
            unknown_ += count;
            return;
    }
}

void Gathered::takeIndices(RawMesh& mesh) {
    std::vector<double>& all = indices_;
    const std::size_t vertices = mesh.positions.size();
    // A count before them: alone, before rows of three, or one that is right.
    const auto rest = static_cast<double>(all.size()) - 1.0;
    const bool countFirst = !all.empty() && indexRuns_[0] == 1 &&
                            (all.size() == 1 || indexRuns_[1] > 1 ||
                             (all.size() % 3 == 1 && (all[0] == rest || 3.0 * all[0] == rest)));
    if (countFirst) all.erase(all.begin());
    if (all.empty()) {  // every three vertices are a triangle
        mesh.indices.resize(vertices);
        std::iota(mesh.indices.begin(), mesh.indices.end(), 0U);
        if (vertices % 3 != 0)
            fail(message<"mesh.truncated/indices-missing">("count"_arg = vertices), lastLine_);
        return;
    }
    if (all.size() % 3 != 0)
        fail(message<"mesh.truncated/indices">("count"_arg = all.size()), lastLine_);
    const double base = indexBase(all.data(), all.data() + all.size(), vertices);
    for (const double value : all) {
        if (!isCount(value - base) || value - base >= static_cast<double>(vertices))
            fail(message<"mesh.index/range">("index"_arg = value - base, "count"_arg = vertices),
                 firstIndex_);
        mesh.indices.push_back(static_cast<std::uint32_t>(value - base));
    }
}

RawMesh Gathered::take() {
    RawMesh mesh;
    // "Triangles:" before the places themselves.
    if (positions_.empty() && indices_.size() >= 9) {
        const bool countFirst = indexRuns_[0] == 1 && indices_.size() % 3 == 1;
        positions_.assign(indices_.begin() + (countFirst ? 1 : 0), indices_.end());
        indices_.clear();
        for (const double value : positions_)
            if (std::isnan(value)) fail(message<"mesh.number/nan">(), lastLine_);
    }
    if (positions_.empty()) fail(message<"mesh.empty/vertices">(), lastLine_);
    if (positions_.size() % 3 != 0)
        fail(message<"mesh.truncated/coordinates">("count"_arg = positions_.size()),
             firstPosition_);
    const std::size_t vertices = positions_.size() / 3;
    checkCounts(vertices, std::max(indices_.size(), vertices) / 3, file_);
    for (std::size_t i = 0; i < positions_.size(); i += 3)
        mesh.positions.emplace_back(positions_[i], positions_[i + 1], positions_[i + 2]);
    if (normals_.size() == 3) {
        mesh.normals.assign(vertices, vec3At(normals_.data()));
    } else if (normals_.size() == 3 * vertices) {
        for (std::size_t i = 0; i < normals_.size(); i += 3)
            mesh.normals.push_back(vec3At(&normals_[i]));
    } else if (!normals_.empty()) {
        mesh.leftOut["numbers of normals, which are not three a vertex"] += normals_.size();
    }
    if (uvs_.size() == 2 * vertices) {
        for (std::size_t i = 0; i < uvs_.size(); i += 2)
            mesh.uvs.emplace_back(uvs_[i], uvs_[i + 1]);
    } else if (!uvs_.empty()) {
        mesh.leftOut["numbers of texture coordinates, which are not two a vertex"] += uvs_.size();
    }
    if (unknown_ > 0) mesh.leftOut["numbers without a known word before them"] += unknown_;
    takeIndices(mesh);
    return mesh;
}

}  // namespace farol::generator::io
