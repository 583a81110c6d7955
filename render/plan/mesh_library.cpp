#include "render/plan/mesh_library.h"

#include <atomic>
#include <utility>

#include "render/plan/coplanar.h"

namespace farol::render {
namespace {

std::string keyOf(const scene::Model& model, const scene::Assets& assets) {
    std::string key = std::to_string(static_cast<int>(model.source.kind)) + '\n' +
                      std::to_string(static_cast<int>(model.uv)) + (model.autoLod ? "a\n" : "\n");
    if (model.source.kind == scene::ModelSource::Kind::shape)
        key += generator::textOf(model.source.shape);
    if (!model.source.path.empty())
        key += '\n' + model.source.path + '\n' + assets.version(model.source.path);
    return key;
}

/// At most 1: a ring covers little of its box.
double filledPart(const generator::Mesh& mesh, const Box& bounds) {
    double area = 0.0;
    for (std::size_t i = 0; i + 2 < mesh.indices().size(); i += 3) {
        const glm::vec3& a = mesh.positions()[mesh.indices()[i]];
        area += 0.5 * static_cast<double>(
                          glm::length(glm::cross(mesh.positions()[mesh.indices()[i + 1]] - a,
                                                 mesh.positions()[mesh.indices()[i + 2]] - a)));
    }
    const glm::dvec3 side = bounds.max - bounds.min;
    const double faces = side.x * side.y + side.y * side.z + side.z * side.x;
    return faces > 0.0 && area < faces ? area / faces : 1.0;
}

}  // namespace

std::uint64_t nextMeshId() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

std::size_t bytesOf(const MeshData& data) {
    return data.mesh.positions().size() * sizeof(glm::vec3) +
           data.mesh.normals().size() * sizeof(glm::vec3) +
           data.mesh.uvs().size() * sizeof(glm::vec2) +
           data.mesh.colors().size() * sizeof(glm::u8vec4) +
           data.mesh.indices().size() * sizeof(std::uint32_t);
}

std::shared_ptr<const MeshData> MeshLibrary::keep(const Key& key, generator::Mesh mesh,
                                                  Diagnostics findings,
                                                  const generator::ShapeCall* balanced) {
    auto data = std::make_shared<MeshData>();
    data->id = nextMeshId();
    data->mesh = std::move(mesh);
    if (balanced != nullptr) {
        data->balance = generator::balancedScale(*balanced);
        data->fullTurn = generator::fullTurnOf(*balanced);
    }
    data->findings = std::move(findings);
    for (const glm::vec3& position : data->mesh.positions()) data->bounds.add(glm::dvec3(position));
    data->filled = filledPart(data->mesh, data->bounds);
    data->flats = flatFacesOf(data->mesh);
    const std::size_t bytes = bytesOf(*data);
    return meshes_.put(key, std::move(data), bytes);
}

std::shared_ptr<const MeshData> MeshLibrary::get(const scene::Model& model,
                                                 const scene::Assets& assets) {
    const Key key{keyOf(model, assets)};
    if (const auto* known = meshes_.find(key)) return *known;
    Diagnostics findings;
    generator::Mesh mesh = generator::load(model, assets, &findings);
    return keep(key, std::move(mesh), std::move(findings));
}

std::shared_ptr<const MeshData> MeshLibrary::get(const MeshData& coarse, const scene::Model& model,
                                                 const scene::Assets& assets,
                                                 const generator::Fineness& fineness) {
    // All numbers stand on ladders.
    const Key key{{},
                  coarse.id,
                  fineness.error,
                  fineness.fullTurn,
                  fineness.straightSide,
                  fineness.balanced,
                  fineness.textured};
    if (const auto* kept = meshes_.find(key)) return *kept;
    const std::shared_ptr<const MeshData> mesh = refined(coarse.id, model, assets, fineness);
    // Counted under each of its names, so that the bound is kept.
    return meshes_.put(key, mesh, bytesOf(*mesh));
}

std::shared_ptr<const MeshData> MeshLibrary::refined(std::uint64_t coarse,
                                                     const scene::Model& model,
                                                     const scene::Assets& assets,
                                                     const generator::Fineness& fineness) {
    // Different fineness may give the same divisions: one mesh, which models draw in one call.
    if (auto adapted = generator::adapt(model, assets, fineness)) {
        Key made{{}, coarse};
        for (const std::size_t level : adapted->divisions)
            made.source += std::to_string(level) + ' ';
        if (const auto* known = meshes_.find(made)) return *known;
        return keep(made, std::move(adapted->mesh));
    }
    const generator::ShapeCall call = generator::refine(model, assets, fineness);
    Key made{generator::textOf(call), coarse};
    made.balanced = fineness.balanced;
    if (const auto* known = meshes_.find(made)) return *known;
    return keep(made, generator::generate(call, assets, model.uv), {},
                fineness.balanced ? &call : nullptr);
}

}  // namespace farol::render
