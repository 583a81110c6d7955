#include "classroom.h"

#include <filesystem>
#include <fstream>
#include <functional>
#include <set>

#include "generator/io/mesh_file.h"
#include "generator/registry.h"
#include "render/prepare.h"
#include "tests/support/paths.h"

namespace farol::test {
namespace {

namespace fs = std::filesystem;

std::string readFile(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

constexpr const char* kCamera =
    R"(<window width="320" height="240"/><camera><position x="5" y="4" z="8"/>
<lookAt x="0" y="0.5" z="0"/><up x="0" y="1" z="0"/><projection fov="50" near="1" far="100"/></camera>)";

/// A robot's arm in nested groups: order, signs and axes matter.
std::string armXml() {
    return std::string("<world>") + kCamera + R"(
<lights><light type="directional" dirx="1" diry="2" dirz="1.5"/></lights>
<group><transform><translate x="-1" y="0" z="0.5"/><rotate angle="35" x="0" y="1" z="0"/></transform>
 <models><model file="box_1_2.3d"><color><diffuse R="200" G="90" B="40"/><ambient R="40" G="20" B="10"/></color></model></models>
 <group><transform><translate x="0.2" y="1.2" z="0"/><rotate angle="-30" x="0" y="0" z="1"/><scale x="0.5" y="1.6" z="0.5"/></transform>
  <models><model file="cylinder_0.5_1_16_1.3d"><color><diffuse R="60" G="120" B="200"/><specular R="255" G="255" B="255"/><shininess value="40"/></color></model></models>
  <group><transform><translate x="0" y="1" z="0"/></transform>
   <models><model file="sphere_0.6_16_12.3d"><color><diffuse R="220" G="200" B="60"/></color></model></models></group>
 </group>
</group></world>)";
}

/// Lights of every kind on a floor.
std::string lightsXml() {
    return std::string("<world>") + kCamera + R"(
<lights><light type="point" posx="2" posy="3" posz="2" quadratic="0.02"/>
<light type="spot" posx="-2" posy="4" posz="1" dirx="0.4" diry="-1" dirz="-0.2" cutoff="25" exponent="4"/>
<light type="directional" dirx="-1" diry="1" dirz="0.5" diffR="0.3" diffG="0.3" diffB="0.4"/></lights>
<group><models><model file="plane_8_16.3d"><color><diffuse R="180" G="180" B="190"/></color></model></models>
 <group><transform><translate x="-1" y="0.8" z="0"/></transform>
  <models><model file="sphere_0.8_24_16.3d"><color><diffuse R="200" G="60" B="60"/><specular R="200" G="200" B="200"/><shininess value="30"/></color></model></models></group>
 <group><transform><translate x="1.5" y="0" z="-0.5"/><rotate angle="20" x="0" y="1" z="0"/></transform>
  <models><model file="cone_0.8_2_20_4.3d"><color><diffuse R="60" G="180" B="90"/></color></model></models></group>
</group></world>)";
}

/// Textured primitives: turned pictures show.
std::string texturesXml() {
    return std::string("<world>") + kCamera + R"(
<lights><light type="directional" dirx="0.5" diry="1" dirz="1"/></lights>
<group><models><model file="plane_6_8.3d"><texture file="compass.png"/><color><diffuse R="255" G="255" B="255"/></color></model></models>
 <group><transform><translate x="-1.2" y="0.9" z="0.6"/><rotate angle="25" x="0" y="1" z="0"/></transform>
  <models><model file="box_1.5_2.3d"><texture file="compass.png"/></model></models></group>
 <group><transform><translate x="1.5" y="1" z="0"/><scale x="1" y="0.7" z="1"/></transform>
  <models><model file="sphere_1_24_12.3d"><texture file="planks.jpg"/></model></models></group>
</group></world>)";
}

/// Wireframes, as the field's first exercises.
std::string wiresXml() {
    return std::string("<world>") + kCamera + R"(
<group><transform><translate x="-1" y="0" z="0"/><rotate angle="50" x="0" y="1" z="0"/></transform>
 <models><model file="cone_1_2_6_4.3d"/></models>
 <group><transform><translate x="3" y="0.5" z="0"/></transform><models><model file="box_1.5_3.3d"/></models></group></group>
<group><transform><scale x="1" y="2" z="1"/><translate x="0.5" y="0.2" z="-2"/></transform>
 <models><model file="sphere_1_10_6.3d"/></models></group></world>)";
}

/// Surfaces that end: which side is drawn shows. The sail is seen from behind.
std::string sheetsXml() {
    return std::string("<world>") + kCamera + R"(
<lights><light type="directional" dirx="1" diry="2" dirz="1.5"/></lights>
<group><models><model file="plane_6_8.3d"><color><diffuse R="150" G="170" B="120"/></color></model></models>
 <group><transform><translate x="-0.5" y="1.5" z="0"/><rotate angle="-100" x="1" y="0" z="0"/></transform>
  <models><model file="plane_2_4.3d" twoSided="true"><color><diffuse R="220" G="80" B="60"/></color></model></models></group>
 <group><transform><translate x="2" y="0.6" z="1"/></transform>
  <models><model file="sphere_0.6_16_12.3d"><color><diffuse R="60" G="90" B="200"/></color></model></models></group>
</group></world>)";
}

/// Glass and a lattice before others.
std::string glassXml() {
    return std::string("<world>") + kCamera + R"(
<lights><light type="directional" dirx="1" diry="2" dirz="1.5"/></lights>
<group><models><model file="plane_6_8.3d"><color><diffuse R="150" G="170" B="120"/></color></model></models>
 <group><transform><translate x="0" y="0.8" z="-1.2"/></transform>
  <models><model file="box_1.6_2.3d"><color><diffuse R="190" G="60" B="50"/></color></model></models></group>
 <group><transform><translate x="-0.8" y="1" z="1"/></transform>
  <models><model file="sphere_0.9_24_16.3d" opacity="0.35"><color><diffuse R="90" G="140" B="220"/></color></model></models></group>
 <group><transform><translate x="1.6" y="1" z="0.8"/><rotate angle="90" x="1" y="0" z="0"/></transform>
  <models><model file="plane_2_1.3d" twoSided="true"><texture file="lattice.png"/></model></models></group>
</group></world>)";
}

}  // namespace

std::vector<ReferenceScene> referenceScenes() {
    const fs::path root = fs::path(farol::test::kSourceDir) / "scenes";
    std::vector<ReferenceScene> all;
    std::set<std::string> kept;
    // Those that are drawn quickly; the others show nothing more of a grader.
    for (const char* name :
         {"can-and-pawns", "chess-hare", "house", "police-box", "primitives", "robot-arm",
          "snowman", "solar-system-wireframe", "teapots", "torch"}) {
        ReferenceScene one{name, readFile(root / name / "scene.xml"), {}};
        for (const auto& entry : fs::directory_iterator(root / name))
            if (entry.path().filename() != "scene.xml")
                one.files[entry.path().filename().string()] = readFile(entry.path());
        all.push_back(std::move(one));
    }
    all.push_back({"made: arm", armXml(), {}});
    all.push_back({"made: lights", lightsXml(), {}});
    all.push_back({"made: textures",
                   texturesXml(),
                   {{"compass.png", readFile(root / "primitives" / "compass.png")},
                    {"planks.jpg", readFile(root / "torch" / "planks.jpg")}}});
    all.push_back({"made: wires", wiresXml(), {}});
    all.push_back({"made: sheets", sheetsXml(), {}});
    all.push_back({"made: glass",
                   glassXml(),
                   {{"lattice.png", readFile(root / "see-through" / "lattice.png")}}});
    return all;
}

grade::Subject subjectOf(const std::string& xml, const Files& files) {
    grade::Subject subject;
    subject.job.name = "scene.xml";
    subject.job.xml = xml;
    subject.job.assets = std::make_shared<scene::BundleAssets>(files);
    return subject;
}

Work open(const ReferenceScene& reference) {
    render::Prepared prepared = render::prepare(subjectOf(reference.xml, reference.files).job);
    return {std::move(prepared.scene), reference.files, prepared.assets};
}

std::vector<scene::Group*> groupsOf(scene::Scene& scene) {
    std::vector<scene::Group*> all;
    const std::function<void(scene::Group&)> visit = [&](scene::Group& group) {
        all.push_back(&group);
        for (scene::Group& child : group.groups) visit(child);
    };
    for (scene::Group& group : scene.groups) visit(group);
    return all;
}

std::vector<Placed> modelsOf(scene::Scene& scene) {
    std::vector<Placed> all;
    for (scene::Group* group : groupsOf(scene))
        for (scene::Model& model : group->models) all.push_back({group, &model});
    return all;
}

bool replaceMesh(Work& work, scene::Model& model, const std::string& file,
                 void (*change)(generator::MeshArrays&)) {
    if (generator::isAdaptive(model) || model.revolve) return false;
    generator::MeshArrays arrays = generator::load(model, *work.assets).arrays();
    change(arrays);
    work.files[file] = generator::io::encodeMesh(generator::Mesh(std::move(arrays)),
                                                 *generator::io::formatOf(file));
    model.file = file;
    model.command.clear();
    model.uv = scene::UvLayout::face;
    return true;
}

std::string shapeNameOf(const scene::Model& model) {
    const generator::ShapeEntry* entry = model.source.shape.entry;
    return entry != nullptr ? entry->name : "";
}

void turnTriangles(generator::MeshArrays& mesh) {
    for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3)
        std::swap(mesh.indices[t + 1], mesh.indices[t + 2]);
}

}  // namespace farol::test
