#include "grade/tree.h"

#include <map>

#include "scene/words.h"

namespace farol::grade {
namespace {

/// What the tree says of a model, whatever number of copies is drawn.
struct Standing {
    int number, group, parent;
    std::vector<Step> steps;
};

class Walker {
  public:
    explicit Walker(std::map<const scene::Model*, Standing>& out) : out_(out) {}

    void visit(const scene::Group& group, int parent, std::vector<Step> steps) {
        const int number = ++groups_;
        for (std::size_t i = 0; i < group.transforms.size(); ++i)
            steps.push_back({&group.transforms[i], number,
                             i < group.transformsAt.size() ? group.transformsAt[i] : group.where});
        for (const scene::Model& model : group.models)
            out_[&model] = {++models_, number, parent, steps};
        for (const scene::Group& child : group.groups) visit(child, number, steps);
    }
    int groups() const { return groups_; }

  private:
    std::map<const scene::Model*, Standing>& out_;
    int groups_ = 0, models_ = 0;
};

}  // namespace

Tree growTree(std::shared_ptr<const render::Prepared> prepared, double timeS,
              render::MeshLibrary& meshes) {
    Tree tree;
    tree.timeS = timeS;
    tree.list = render::collect(prepared->scene, timeS, false, *prepared->assets, meshes);
    std::map<const scene::Model*, Standing> standing;
    Walker walker(standing);
    for (const scene::Group& group : prepared->scene.groups) walker.visit(group, 0, {});
    tree.groups = walker.groups();
    for (const render::Instance& instance : tree.list.instances) {
        const Standing& where = standing.at(instance.model);
        Piece piece;
        piece.model = instance.model;
        piece.mesh = instance.mesh;
        piece.worldFromObject = instance.worldFromObject;
        piece.material =
            instance.model->material.value_or(scene::defaultMaterial(prepared->scene.dialect));
        piece.number = where.number;
        piece.group = where.group;
        piece.parent = where.parent;
        piece.steps = where.steps;
        tree.pieces.push_back(std::move(piece));
    }
    tree.prepared = std::move(prepared);
    return tree;
}

std::string meshNameOf(const scene::Model& model) {
    std::string text;
    for (const std::string& word : model.source.words) text += (text.empty() ? "" : " ") + word;
    if (text.empty()) text = model.file.empty() ? model.command : model.file;
    return scene::shown(text);
}

std::string nameOf(const Piece& piece) {
    const scene::Model& model = *piece.model;
    const std::string given = !model.name.empty() ? model.name : model.id;
    return "model " + std::to_string(piece.number) + " (" +
           (given.empty() ? meshNameOf(model) : scene::shown(given)) + ")";
}

}  // namespace farol::grade
