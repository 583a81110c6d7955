#include "grade/rubric/lent_assets.h"

#include <algorithm>
#include <map>

#include "core/text.h"

namespace farol::grade {
namespace {

std::string nameOf(const std::string& path) { return lowerCase(baseName(path)); }

bool mayBeLent(const std::string& path) {
    static const std::set<std::string> kEndings{"png",   "jpg", "jpeg", "webp", "bmp", "tga",
                                                "gif",   "hdr", "tif",  "tiff", "dds", "exr",
                                                "patch", "obj", "ply",  "stl",  "off"};
    return kEndings.count(fileEnding(path)) != 0;
}

/// The files that a scene uses, each with the location of its first use.
class Uses {
  public:
    explicit Uses(const scene::Scene& scene) {
        for (const scene::Group& group : scene.groups) visit(group);
        add(scene.background.path, scene.background.where);
        if (scene.skybox) add(scene.skybox->path, scene.skybox->where);
    }
    const std::map<std::string, Location>& all() const { return all_; }

  private:
    void visit(const scene::Group& group) {
        for (const scene::Model& model : group.models) {
            add(model.source.path, model.where);
            if (model.texture) add(model.texture->path, model.texture->where);
        }
        for (const scene::Group& child : group.groups) visit(child);
    }
    void add(const std::string& path, const Location& where) {
        if (!path.empty()) all_.try_emplace(path, where);
    }

    std::map<std::string, Location> all_;
};

}  // namespace

LentAssets::LentAssets(std::shared_ptr<const scene::Assets> own,
                       std::shared_ptr<const scene::Assets> handedOut)
    : own_(std::move(own)), handedOut_(std::move(handedOut)) {
    std::set<std::string> names;
    for (const std::string& path : own_->list()) names.insert(nameOf(path));
    for (const std::string& path : handedOut_->list())
        if (mayBeLent(path) && names.count(nameOf(path)) == 0) lent_.insert(path);
}

std::vector<std::string> LentAssets::list() const {
    std::vector<std::string> all = own_->list();
    all.insert(all.end(), lent_.begin(), lent_.end());
    std::sort(all.begin(), all.end());
    return all;
}

const scene::Assets& LentAssets::holderOf(const std::string& path) const {
    return lent_.count(path) != 0 ? *handedOut_ : *own_;
}

bool LentAssets::has(const std::string& path) const { return holderOf(path).has(path); }

std::optional<std::string> LentAssets::read(const std::string& path) const {
    return holderOf(path).read(path);
}

std::optional<std::uint64_t> LentAssets::size(const std::string& path) const {
    return holderOf(path).size(path);
}

void LentAssets::prefetch(const std::vector<std::string>& paths) const {
    std::vector<std::string> own, lent;
    for (const std::string& path : paths) (lent_.count(path) != 0 ? lent : own).push_back(path);
    own_->prefetch(own);
    handedOut_->prefetch(lent);
}

std::string LentAssets::version(const std::string& path) const {
    return holderOf(path).version(path);
}

Diagnostics LentAssets::notes(const scene::Scene& scene) const {
    Diagnostics out;
    const Uses uses(scene);
    for (const auto& [path, where] : uses.all())
        if (lent_.count(path) != 0)
            out.push_back({Severity::info, "grade.lent", where,
                           farol::quoted(path) +
                               " is not among the submission's files; the reference's is used",
                           ""});
    return out;
}

}  // namespace farol::grade
