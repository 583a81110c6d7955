#include "render/mesh_library.h"

#include <atomic>

namespace farol::render {
namespace {

std::uint64_t nextId() {
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

std::string keyOf(const scene::Model& model, const scene::Assets& assets) {
    std::string key = std::to_string(static_cast<int>(model.source.kind)) + '\n' +
                      std::to_string(static_cast<int>(model.uv)) + '\n';
    for (const std::string& word : model.source.words) key += word + ' ';
    if (!model.source.path.empty())
        key += '\n' + model.source.path + '\n' + assets.version(model.source.path);
    return key;
}

}  // namespace

std::shared_ptr<const MeshData> MeshLibrary::get(const scene::Model& model,
                                                 const scene::Assets& assets) {
    const std::string key = keyOf(model, assets);
    if (const auto found = byKey_.find(key); found != byKey_.end()) {
        entries_.splice(entries_.begin(), entries_, found->second);
        return found->second->data;
    }
    auto data = std::make_shared<MeshData>();
    data->id = nextId();
    data->mesh = generator::load(model, assets);
    for (const glm::vec3& position : data->mesh.positions) data->bounds.add(glm::dvec3(position));
    const generator::Mesh& mesh = data->mesh;
    const std::size_t bytes =
        mesh.positions.size() * sizeof(glm::vec3) + mesh.normals.size() * sizeof(glm::vec3) +
        mesh.uvs.size() * sizeof(glm::vec2) + mesh.indices.size() * sizeof(std::uint32_t);
    entries_.push_front({key, data, bytes});
    byKey_[key] = entries_.begin();
    bytes_ += bytes;
    while (bytes_ > maxBytes_ && entries_.size() > 1) {
        bytes_ -= entries_.back().bytes;
        byKey_.erase(entries_.back().key);
        entries_.pop_back();
    }
    return data;
}

}  // namespace farol::render
