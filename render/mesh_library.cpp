#include "render/mesh_library.h"

#include <atomic>
#include <utility>

namespace farol::render {
namespace {

std::uint64_t nextId() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

std::string keyOf(const scene::Model& model, const scene::Assets& assets) {
    std::string key = std::to_string(static_cast<int>(model.source.kind)) + '\n' +
                      std::to_string(static_cast<int>(model.uv)) + (model.autoLod ? "a\n" : "\n");
    for (const std::string& word : model.source.words) key += word + ' ';
    if (!model.source.path.empty())
        key += '\n' + model.source.path + '\n' + assets.version(model.source.path);
    return key;
}

}  // namespace

std::size_t bytesOf(const MeshData& data) {
    return data.mesh.positions.size() * sizeof(glm::vec3) +
           data.mesh.normals.size() * sizeof(glm::vec3) + data.mesh.uvs.size() * sizeof(glm::vec2) +
           data.mesh.indices.size() * sizeof(std::uint32_t);
}

std::shared_ptr<const MeshData> MeshLibrary::keep(const Key& key, generator::Mesh mesh,
                                                  Diagnostics findings,
                                                  const std::vector<std::string>& balanced) {
    auto data = std::make_shared<MeshData>();
    data->id = nextId();
    data->mesh = std::move(mesh);
    if (!balanced.empty()) {
        data->balance = generator::balanceOf(balanced);
        data->fullTurn = generator::fullTurnOf(balanced);
    }
    data->findings = std::move(findings);
    for (const glm::vec3& position : data->mesh.positions) data->bounds.add(glm::dvec3(position));
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
    const Key key{
        {}, coarse.id, fineness.error, fineness.fullTurn, fineness.straightSide, fineness.balanced};
    if (const auto* kept = meshes_.find(key)) return *kept;
    // Many wishes end in the same divisions: one mesh, so that its models can share a draw call.
    const std::vector<std::string> words = generator::refine(model, assets, fineness);
    Key made{{}, coarse.id};
    for (const std::string& word : words) made.source += word + ' ';
    made.balanced = fineness.balanced;
    const auto* known = meshes_.find(made);
    const std::shared_ptr<const MeshData> mesh =
        known ? *known
              : keep(made, generator::generate(words, assets, model.uv), {},
                     fineness.balanced ? words : std::vector<std::string>());
    // Counted under each of its names, so that the bound is kept.
    return meshes_.put(key, mesh, bytesOf(*mesh));
}

}  // namespace farol::render
