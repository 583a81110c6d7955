#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "generator/mesh.h"
#include "grade/rubric/grader.h"
#include "scene/scene.h"

/// Submissions of students: reference scenes, the mistakes people make with them, and changes that
/// are none.
namespace farol::test {

using Files = std::map<std::string, std::string>;

/// A scene and its files, taken apart.
struct Work {
    scene::Scene scene;
    Files files;
    std::shared_ptr<const scene::Assets> assets;  ///< of the reference, resolved
};

struct ReferenceScene {
    std::string name;
    std::string xml;
    Files files;
};

/// The example scenes, and some that are made here for what those lack.
std::vector<ReferenceScene> referenceScenes();

/// Reads and resolves it.
Work open(const ReferenceScene& reference);
grade::Subject subjectOf(const std::string& xml, const Files& files);

/// One kind of change. `apply` returns the changed document, or nothing where the scene has no
/// place for it.
struct Variant {
    std::string name;
    std::vector<std::string> codes;  ///< findings that name it rightly; none: it is harmless
    std::optional<std::string> (*apply)(Work&);
};

std::vector<Variant> mutants();
std::vector<Variant> harmless();

/// The groups of a scene, with their parents: in document order.
std::vector<scene::Group*> groupsOf(scene::Scene& scene);
/// The models with their groups.
struct Placed {
    scene::Group* group;
    scene::Model* model;
};
std::vector<Placed> modelsOf(scene::Scene& scene);

/// Puts a mesh file in the place of a model's mesh, as `change` makes it. False where the model has
/// no mesh to write (open divisions, profiles).
bool replaceMesh(Work& work, scene::Model& model, const std::string& file,
                 void (*change)(generator::MeshArrays&));
/// Returns the name of the model's shape; "" where it is none.
std::string shapeNameOf(const scene::Model& model);

/// Every triangle the other way round; normals stay.
void turnTriangles(generator::MeshArrays& mesh);

}  // namespace farol::test
