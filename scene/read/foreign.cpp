#include "scene/read/foreign.h"

#include <algorithm>
#include <vector>

#include "core/did_you_mean.h"
#include "core/text.h"
#include "scene/messages.h"
#include "scene/read/tables.h"

namespace farol::scene {
namespace {

struct Language {
    std::string_view name;      ///< with its article
    std::string_view roots;     ///< its root elements
    std::string_view children;  ///< elements by which a <scene> or <world> of it is known
    std::string_view fix = "send a scene whose root is <world> or <scene>";
};
constexpr std::string_view kExport = "export the meshes as .obj and name them in a scene";

constexpr Language kLanguages[] = {
    {"an X3D scene", "x3d", "viewpoint navigationinfo shape worldinfo", kExport},
    {"a COLLADA file", "collada", "", kExport},
    {"an AMF model", "amf", "", kExport},
    {"a VTK data file", "vtkfile", "", kExport},
    {"an OGRE scene or mesh", "mesh skeleton", "nodes externals submeshes environment", kExport},
    {"a Mitsuba scene", "", "integrator sensor bsdf shape emitter film"},
    {"a ray tracer's scene", "",
     "cameras vertices vertexdata objects materials backgroundcolor maxrecursiondepth "
     "shadowrayepsilon intersectiontestepsilon ambientlight pointlight spheres triangles"},
    {"a scene of the LAIG course", "yas lxs lsx dsx sxs lsf", ""},
    {"a robot description", "robot sdf mujoco", "physics plugin worldbody", kExport},
    {"an HTML page", "html body head", "", "send the scene itself, not a page"},
    {"an SVG drawing", "svg", ""},
    {"a draw.io diagram", "mxfile mxgraphmodel", ""},
    {"a graph file", "graphml gexf", ""},
    {"a map", "kml gpx osm map tileset", ""},
    {"a news feed", "rss feed", ""},
    {"an Android or Java project file", "manifest resources project beans", ""},
    {"a Visual Studio file", "visualstudioproject configuration package", ""},
    {"a property list", "plist", ""},
    {"a spreadsheet or text document", "workbook worksheet office:document", ""},
};

/// The local name: "collada" of "ns:COLLADA".
std::string_view localName(std::string_view name) {
    const std::size_t colon = name.rfind(':');
    return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

bool isKnownElement(std::string_view name) {
    const auto specs = elementSpecs();
    return std::any_of(specs.begin(), specs.end(), [name](const ElementSpec& spec) {
        return sameWord(spec.name, name) || isAmong(spec.aliases, name);
    });
}

}  // namespace

std::optional<Message> foreignRoot(pugi::xml_node root) {
    const std::string_view name = root.name();
    if (isSceneRoot(name)) return std::nullopt;
    for (const Language& language : kLanguages)
        if (isAmong(language.roots, name) || isAmong(language.roots, localName(name)))
            return message<"scene.root/foreign">("element"_arg = name,
                                                 "language"_arg = language.name,
                                                 "fix"_arg = uncut(language.fix));
    return std::nullopt;
}

std::optional<Message> foreignContent(pugi::xml_node root, bool isWhole) {
    constexpr std::size_t kMaxNamed = 3, kMaxNameBytes = 64;
    const ElementSpec& spec = elementSpec("world");
    std::vector<std::string> names;
    for (const std::string_view name : split(spec.children)) names.emplace_back(name);
    const Language* language = nullptr;
    bool isScene = false;
    std::vector<std::string> unknown;
    for (const pugi::xml_node child : root.children()) {
        if (child.type() != pugi::node_element) continue;
        const ElementSpec* known = findChild(spec, child.name());
        // Anything that can be drawn, or leads to it: a scene with mistakes.
        if (known != nullptr &&
            isAmong("group models model xmls xml entity skybox background", known->name))
            return std::nullopt;
        for (const Language& one : kLanguages)
            if (language == nullptr && isAmong(one.children, child.name())) language = &one;
        isScene = isScene || known != nullptr || isKnownElement(child.name()) ||
                  !didYouMean(std::string(child.name()).substr(0, kMaxNameBytes), names).empty();
        if (known == nullptr && unknown.size() <= kMaxNamed)
            unknown.push_back("<" + shown(child.name()) + ">");
    }
    if (language != nullptr)
        return message<"scene.foreign">("element"_arg = root.name(),
                                        "language"_arg = language->name,
                                        "fix"_arg = uncut(language->fix));
    if (unknown.empty() || isScene || !isWhole) return std::nullopt;
    const bool hasMore = unknown.size() > kMaxNamed;
    if (hasMore) unknown.back() = "...";
    return message<"scene.foreign/unknown">("element"_arg = root.name(),
                                            "unknown"_arg = uncut(joined(unknown, ", ")));
}

}  // namespace farol::scene
