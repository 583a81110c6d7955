#include "interchange/subject.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "image/format.h"
#include "image/image_file.h"
#include "image/orientation.h"
#include "render/plan/camera.h"
#include "render/plan/chess_board.h"
#include "render/plan/messages.h"
#include "render/plan/plan.h"
#include "render/plan/shading.h"
#include "scene/animation.h"

namespace farol::interchange {
namespace {

constexpr std::size_t kMeshCacheBytes = std::size_t{1} << 30U;

bool drawsLines(scene::Shading shading) {
    return shading == scene::Shading::wireframe || shading == scene::Shading::points;
}

/// Ambient light of the scene's own lights, display values, beside the global one.
glm::vec3 ambientOf(const scene::Scene& scene, double timeS) {
    glm::vec3 sum = scene.globalAmbient;
    for (const scene::Light& light : scene.lights)
        if (light.type == scene::LightType::directional ||
            (light.linear == 0.0 && light.quadratic == 0.0 && light.cutoffDeg == 180.0))
            sum += scene::colorAt(light.ambient, timeS);
    return sum;
}

}  // namespace

Subject::Subject(const render::Job& job)
    : options_(job.options), prepared_(render::prepare(job)), meshes_(kMeshCacheBytes) {
    placed_ = render::place(prepared_.scene, options_.timeS, false, *prepared_.assets, meshes_);
    prepared_.diagnostics.insert(prepared_.diagnostics.end(), placed_.scene.findings.begin(),
                                 placed_.scene.findings.end());
    size_ = render::pictureSize(prepared_.scene, options_);
    camera_ = render::chooseCamera(prepared_.scene, options_, placed_.scene.bounds,
                                   static_cast<double>(size_.x) / size_.y);
    shading_ = render::chooseShading(prepared_.scene, options_, placed_.scene);
    isLit_ = render::isLit(shading_, placed_.scene);
}

std::shared_ptr<const render::MeshData> Subject::meshOf(const scene::Model& model) {
    const std::shared_ptr<const render::MeshData> coarse = meshes_.get(model, *prepared_.assets);
    if (!generator::isAdaptive(model) || coarse->bounds.empty()) return coarse;
    generator::Fineness fineness{};
    fineness.error = kMeshError * glm::length(coarse->bounds.max - coarse->bounds.min);
    fineness.fullTurn = 64.0;
    fineness.straightSide = model.texture ? 16.0 : 8.0;
    fineness.textured = model.texture.has_value();
    if (!(fineness.error > 0.0)) return coarse;
    return meshes_.get(*coarse, model, *prepared_.assets, fineness);
}

bool Subject::isTransparent() const {
    const auto chosen =
        options().transparency ? options().transparency : scene().settings.transparency;
    return chosen != scene::Transparency::off;
}

PhongColors Subject::colorsOf(const scene::Material& material, const glm::vec3& ambient,
                              const scene::Scene& in) const {
    PhongColors colors;
    colors.diffuse = scene::colorAt(material.diffuse, timeS());
    colors.base = scene::colorAt(material.emissive, timeS()) + ambient * ambientOf(in, timeS());
    colors.specular = scene::colorAt(material.specular, timeS());
    colors.shininess = material.shininess;
    return colors;
}

std::vector<Look> Subject::looksOf(const scene::Model& model, const render::MeshData& mesh,
                                   const scene::Scene& in) const {
    const scene::Material undressed = scene::defaultMaterial(in.dialect);
    const glm::vec3 ambientOfWhite = undressed.ambient.rgb / undressed.diffuse.rgb;
    const bool hasLines = drawsLines(shading_);
    const bool isDressed = model.material || model.texture;
    const generator::Mesh& own = mesh.mesh;
    const auto finish = [&](Look& look, const scene::Texture* texture) {
        look.isTwoSided = model.twoSided;
        if (!isTransparent() || hasLines) look.opacity = 1.0F;
        if (hasLines || texture == nullptr) return;
        if (!isLit_) look.colors.diffuse = glm::vec3(1.0F);
        if (texture->mapping == scene::Mapping::mesh && own.uvs().empty()) return;
        if (texture->mapping != scene::Mapping::texgenEye) look.texture = texture;
    };
    std::vector<Look> looks;
    if (!isDressed && model.source.materials && !own.parts().empty()) {
        for (const generator::MeshPart& part : own.parts()) {
            const auto& all = *model.source.materials;
            const auto found = std::find_if(all.begin(), all.end(),
                                            [&](const auto& m) { return m.name == part.material; });
            const scene::Material& material = found == all.end() ? undressed : found->material;
            Look look;
            look.first = part.first;
            look.count = part.count;
            look.colors = colorsOf(material, material.diffuse.rgb * ambientOfWhite, in);
            look.opacity = material.opacity * model.opacity;
            if (hasLines) look.colors.diffuse = glm::vec3(1.0F);
            look.name = part.material;
            finish(look, found != all.end() && found->texture ? &*found->texture : nullptr);
            looks.push_back(std::move(look));
        }
        return looks;
    }
    const scene::Material& material = model.material ? *model.material : undressed;
    Look look;
    look.count = own.indices().size();
    look.colors = colorsOf(material, scene::colorAt(material.ambient, timeS()), in);
    look.opacity = material.opacity * model.opacity;
    if (hasLines && !model.material) look.colors.diffuse = glm::vec3(1.0F);
    if (!isDressed && !own.colors().empty() && !hasLines) {
        look.isColored = true;
        look.colors.diffuse = glm::vec3(1.0F);
        look.colors.base =
            scene::colorAt(material.emissive, timeS()) + ambientOfWhite * ambientOf(in, timeS());
    }
    finish(look, model.texture ? &*model.texture : nullptr);
    return {look};
}

namespace {

/// Longitude and latitude of a point, as the renderer's projection by a sphere: 0..1, v upwards.
glm::dvec2 sphereUv(const glm::dvec3& p) {
    return {0.5 + std::atan2(p.z, p.x) / (2.0 * std::numbers::pi),
            0.5 + std::atan2(p.y, std::hypot(p.x, p.z)) / std::numbers::pi};
}

/// Gives triangles over the seam of u, and those at a pole, which has every u, vertices of their
/// own.
void splitSeam(MappedMesh& mesh, const glm::dvec3& origin) {
    std::map<std::pair<std::uint32_t, float>, std::uint32_t> known;
    const auto vertexWith = [&](std::uint32_t index, float u) {
        if (mesh.uvs[index].x == u) return index;
        mesh.isSplit = true;
        const auto [at, isNew] =
            known.emplace(std::pair(index, u), static_cast<std::uint32_t>(mesh.positions.size()));
        if (!isNew) return at->second;
        mesh.positions.push_back(glm::vec3(mesh.positions[index]));
        if (!mesh.normals.empty()) mesh.normals.push_back(glm::vec3(mesh.normals[index]));
        if (!mesh.colors.empty()) mesh.colors.push_back(glm::u8vec4(mesh.colors[index]));
        mesh.uvs.emplace_back(u, mesh.uvs[index].y);
        return at->second;
    };
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        std::array<float, 3> u{};
        std::array<bool, 3> isPole{};
        float low = 1.0F, high = 0.0F, sum = 0.0F;
        int sides = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t index = mesh.indices[i + k];
            const glm::dvec3 place = origin + glm::dvec3(mesh.positions[index]);
            u[k] = mesh.uvs[index].x;
            isPole[k] = std::hypot(place.x, place.z) <= 1e-6 * std::abs(place.y);
            if (isPole[k]) continue;
            low = std::min(low, u[k]);
            high = std::max(high, u[k]);
        }
        for (std::size_t k = 0; k < 3; ++k) {
            if (isPole[k]) continue;
            if (high - low > 0.5F && u[k] < 0.5F) u[k] += 1.0F;
            sum += u[k];
            ++sides;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            if (isPole[k] && sides > 0) u[k] = sum / static_cast<float>(sides);
            mesh.indices[i + k] = vertexWith(mesh.indices[i + k], u[k]);
        }
    }
}

}  // namespace

MappedMesh mapped(const generator::Mesh& mesh, const scene::Texture* texture) {
    MappedMesh out{mesh.positions(), mesh.normals(), {}, mesh.colors(), mesh.indices()};
    if (texture == nullptr) return out;
    out.uvs.reserve(out.positions.size());
    switch (texture->mapping) {
        case scene::Mapping::mesh: {
            const glm::vec4 from = render::uvPlacement(*texture, mesh.uvOrigin());
            for (const glm::vec2& uv : mesh.uvs())
                out.uvs.push_back(uv * glm::vec2(from) + glm::vec2(from.z, from.w));
            break;
        }
        case scene::Mapping::sphere:
            for (std::size_t i = 0; i < out.positions.size(); ++i)
                out.uvs.emplace_back(sphereUv(mesh.place(i)));
            splitSeam(out, mesh.origin());
            break;
        case scene::Mapping::texgenObject:
            for (std::size_t i = 0; i < out.positions.size(); ++i) {
                const glm::dvec4 place(mesh.place(i), 1.0);
                out.uvs.emplace_back(glm::dot(texture->planeS, place),
                                     glm::dot(texture->planeT, place));
            }
            break;
        case scene::Mapping::texgenEye:
            break;
    }
    return out;
}

std::vector<std::uint32_t> edgesOf(const std::vector<std::uint32_t>& indices) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> known;
    std::vector<std::uint32_t> edges;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto pair = std::minmax(indices[i + k], indices[i + (k + 1) % 3]);
            if (known.emplace(pair.first, pair.second).second)
                edges.insert(edges.end(), {pair.first, pair.second});
        }
    return edges;
}

PortableImage imageOf(const scene::Texture& texture, const scene::Assets& assets) {
    PortableImage out{{}, "image/png", "png", image::Alpha::opaque};
    if (texture.chess) {
        out.bytes = image::encodePng(render::chessBoard(*texture.chess));
        return out;
    }
    std::optional<std::string> file = assets.read(texture.path);
    if (!file)
        throw Error(render::message<"asset.missing/image-file">("file"_arg = uncut(texture.path)),
                    texture.where);
    std::string damage;
    const image::Image image = image::decodeImage(*file, texture.path, texture.where, &damage);
    out.alpha = image::classifyAlpha(image);
    const bool isPng = image::hasSignature(*file, image::Format::png);
    if ((isPng || image::hasSignature(*file, image::Format::jpeg)) && damage.empty() &&
        image::orientationOf(*file) == 1) {
        if (!isPng) out = {{}, "image/jpeg", "jpg", image::Alpha::opaque};
        out.bytes = std::move(*file);
        return out;
    }
    out.bytes = image::encodePng(image);
    return out;
}

}  // namespace farol::interchange
