#include "grade/rubric/drawing.h"

#include <algorithm>

#include "generator/io/mesh_file.h"
#include "grade/images/measures.h"
#include "grade/structure/dressing.h"
#include "scene/animation.h"

namespace farol::grade {
namespace {

constexpr int kSeenLevels = 32;  // of 255: a change of colour that counts whole

/// The bytes of a mesh with its triangles the other way round. The reader turns closed meshes that
/// face inwards, and grading shows them as they are: a speck of a triangle opens the mesh.
std::string reversed(const std::string& bytes, const std::string& path) {
    const auto format = generator::io::formatOf(path);
    if (!format) return bytes;  // of a form that is not written
    Diagnostics unused;
    generator::MeshArrays arrays = generator::io::decodeMesh(bytes, path, unused).arrays();
    for (std::size_t t = 0; t + 2 < arrays.indices.size(); t += 3)
        std::swap(arrays.indices[t + 1], arrays.indices[t + 2]);
    if (arrays.positions.empty()) return bytes;
    constexpr float kSpeck = 1e-5F;
    const float reach = kSpeck * std::max(1.0F, glm::length(arrays.positions.front()));
    for (const glm::vec3& off : {glm::vec3(0), glm::vec3(reach, 0, 0), glm::vec3(0, reach, 0)}) {
        arrays.indices.push_back(static_cast<std::uint32_t>(arrays.positions.size()));
        arrays.positions.push_back(arrays.positions.front() + off);
        if (!arrays.normals.empty()) arrays.normals.push_back(arrays.normals.front());
        if (!arrays.uvs.empty()) arrays.uvs.push_back(arrays.uvs.front());
    }
    return generator::io::encodeMesh(generator::Mesh(std::move(arrays)), *format);
}

/// A submission's files, the same reversed below kReversedFolder, and the reference's below
/// kReferenceFolder.
class BothAssets final : public scene::Assets {
  public:
    BothAssets(std::shared_ptr<const scene::Assets> own,
               std::shared_ptr<const scene::Assets> reference)
        : own_(std::move(own)), reference_(std::move(reference)) {}

    std::vector<std::string> list() const override { return own_->list(); }
    bool has(const std::string& path) const override {
        if (isReversed(path)) return own_->has(original(path));
        return isTheirs(path) ? reference_->has(theirs(path)) : own_->has(path);
    }
    std::optional<std::string> read(const std::string& path) const override {
        if (isReversed(path)) {
            const auto bytes = own_->read(original(path));
            return bytes ? std::optional(reversed(*bytes, original(path))) : std::nullopt;
        }
        return isTheirs(path) ? reference_->read(theirs(path)) : own_->read(path);
    }
    std::optional<std::uint64_t> size(const std::string& path) const override {
        if (isReversed(path)) {
            const auto bytes = read(path);
            return bytes ? std::optional<std::uint64_t>(bytes->size()) : std::nullopt;
        }
        return isTheirs(path) ? reference_->size(theirs(path)) : own_->size(path);
    }
    void prefetch(const std::vector<std::string>& paths) const override {
        std::vector<std::string> own, reference;
        for (const std::string& path : paths) {
            if (isTheirs(path))
                reference.push_back(theirs(path));
            else
                own.push_back(isReversed(path) ? original(path) : path);
        }
        own_->prefetch(own);
        reference_->prefetch(reference);
    }
    std::string version(const std::string& path) const override {
        if (isReversed(path)) return "reversed " + own_->version(original(path));
        return isTheirs(path) ? reference_->version(theirs(path)) : own_->version(path);
    }

  private:
    static bool isReversed(const std::string& path) { return path.starts_with(kReversedFolder); }
    static std::string original(const std::string& path) {
        return path.substr(std::string(kReversedFolder).size());
    }
    static bool isTheirs(const std::string& path) { return path.starts_with(kReferenceFolder); }
    static std::string theirs(const std::string& path) {
        return path.substr(std::string(kReferenceFolder).size());
    }
    std::shared_ptr<const scene::Assets> own_, reference_;
};

}  // namespace

RepairPainter::RepairPainter(render::Renderer& renderer, const Reference& reference,
                             std::shared_ptr<const scene::Assets> own)
    : renderer_(renderer),
      reference_(reference),
      files_(
          std::make_shared<const BothAssets>(std::move(own), reference.scene->prepared->assets)) {}

image::Image RepairPainter::drawOne(const std::shared_ptr<const render::Prepared>& prepared,
                                    const Shot& shot) {
    render::Job job;
    job.name = reference_.job.name;
    job.options = shot.options;
    image::Image image;
    renderer_.draw(prepared, job, image);
    return image;
}

std::vector<image::Image> RepairPainter::draw(const Outline& outline) {
    auto prepared = std::make_shared<render::Prepared>();
    prepared->scene = sceneOf(outline);
    prepared->assets = files_;
    prepared->animated = scene::isAnimated(prepared->scene);
    std::vector<image::Image> images;
    for (const Shot& shot : reference_.fixed) images.push_back(drawOne(prepared, shot));
    return images;
}

double RepairPainter::spoiled(const std::vector<image::Image>& right,
                              const std::vector<image::Image>& wrong) const {
    Spoiled sum(reference_.work);
    for (std::size_t v = 0; v < right.size(); ++v) {
        if (right[v] == wrong[v])
            sum.add(v, std::vector<float>(reference_.work.items[v].size(), 0.0F));
        else
            sum.add(v, beyondAPixel(right[v], wrong[v], kSeenLevels).values);
    }
    return sum.share();
}

double RepairPainter::spoiledByCamera(const scene::Camera& camera) {
    Shot shot = reference_.fixed.front();
    const image::Image right = drawOne(reference_.scene->prepared, shot);
    useCamera(shot.options, camera);
    const image::Image wrong = drawOne(reference_.scene->prepared, shot);
    if (right == wrong) return 0.0;
    return shareOf(beyondAPixel(right, wrong, kSeenLevels), contentOf(right, wrong));
}

}  // namespace farol::grade
