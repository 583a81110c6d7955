#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/enum_words.h"
#include "core/error.h"
#include "scene/shape_call.h"

/// The scene model that every dialect is read into. Right-handed, +Y up; lengths in the scene's
/// own units; colours are display values 0..1 (no sRGB decoding: the field's pictures are made
/// so). Angles are in degrees where the name ends in Deg. All numbers are finite.
namespace farol::scene {

/// Which of the field's dialects the document is written in (docs/scene-language.md).
enum class Dialect { course, engine2017, engine2020 };

/// A colour, or (cycles) a saturated hue that turns with the time: see colorAt in animation.h.
struct Color {
    glm::vec3 rgb{0.0F};
    bool cycles = false;
    bool operator==(const Color&) const = default;
};

/// Shininess in 0..128 by the dialects; larger values are kept and honoured.
struct Material {
    Color diffuse{glm::vec3(200.0F / 255.0F)};
    Color ambient{glm::vec3(50.0F / 255.0F)};
    Color specular{};
    Color emissive{};
    float shininess = 0.0F;
    float opacity = 1.0F;  ///< 0: invisible, 1: opaque
    bool operator==(const Material&) const = default;
};

/// Returns a material without colours: the course's 200/50, OpenGL's 0.8/0.2 in other dialects.
inline Material defaultMaterial(Dialect dialect) {
    Material material;
    if (dialect != Dialect::course) {
        material.diffuse.rgb = glm::vec3(0.8F);
        material.ambient.rgb = glm::vec3(0.2F);
    }
    return material;
}

enum class LightType { point, directional, spot };
inline constexpr EnumWords<LightType, LightType::spot> kLightTypeWords{"point", "directional",
                                                                       "spot"};
/// The space of a light's position and direction: its group (world) or the viewer (camera).
enum class LightSpace { world, camera };

struct Light {
    LightType type = LightType::point;
    LightSpace space = LightSpace::world;
    glm::dvec3 position{0.0};   ///< point and spot
    glm::dvec3 direction{0.0};  ///< directional: towards the light; spot: where it shines
    double cutoffDeg = 180.0;   ///< spot: half angle, 0..90, or 180: no cone
    double exponent = 0.0;      ///< spot: falls off as cos^exponent
    double constant = 1.0, linear = 0.0, quadratic = 0.0;  ///< attenuation, point and spot
    Color diffuse{glm::vec3(1.0F)}, ambient{}, specular{glm::vec3(1.0F)};
    Location where;
};

struct Translate {
    glm::dvec3 offset{0.0};
};
/// Along the closed Catmull-Rom curve through the points, one lap in `seconds` (> 0).
struct FollowCurve {
    double seconds = 1.0;
    bool align = false;
    std::vector<glm::dvec3> points;
};
struct Rotate {
    double angleDeg = 0.0;
    glm::dvec3 axis{0.0, 1.0, 0.0};
};
/// One turn about the axis in `seconds` (not 0; negative turns the other way).
struct Spin {
    double seconds = 1.0;
    glm::dvec3 axis{0.0, 1.0, 0.0};
};
struct Scale {
    glm::dvec3 factors{1.0};
};
using Transform = std::variant<Translate, FollowCurve, Rotate, Spin, Scale>;

enum class Filter { nearest, linear, mipmap, anisotropic };
inline constexpr EnumWords<Filter, Filter::anisotropic> kFilterWords{"nearest", "linear", "mipmap",
                                                                     "anisotropic"};
enum class Mapping { mesh, sphere, texgenObject, texgenEye };

/// A checker made by the renderer: `columns` x `rows` fields.
struct Chess {
    int columns = 8, rows = 8;
    glm::vec3 first{1.0F}, second{0.0F};
    bool operator==(const Chess&) const = default;
};

struct Texture {
    std::string file;  ///< as written; empty for a chess texture
    std::string path;  ///< the asset meant by it, set by resolveAssets
    std::optional<Chess> chess;
    Mapping mapping = Mapping::mesh;
    glm::dvec4 planeS{1, 0, 0, 0}, planeT{0, 1, 0, 0};  ///< texgen planes, GL semantics
    std::optional<Filter> filter;
    glm::dvec2 scale{1.0}, offset{0.0};  ///< of the mesh's own coordinates, before they are used
    bool clamp = false;                  ///< the picture's edge goes on beyond it; else it repeats
    Location where;
};

/// A material that a mesh file brings with it for those of its triangles that name it.
struct PartMaterial {
    std::string name;
    Material material;
    std::optional<Texture> texture;
};

/// Where a model's triangles come from. Filled by generator::resolve.
struct ModelSource {
    enum class Kind { none, file, shape } kind = Kind::none;
    std::string path;  ///< file: the asset's path. shape: a profile's or patch's path, else empty
    ShapeCall shape = {};
    bool isSheet = false;  ///< a flat shape that is seen from one side only
    /// file: the materials of its parts, used where the scene gives the model none.
    std::shared_ptr<const std::vector<PartMaterial>> materials = {};
    /// file: the shape of its name or comment, generated if the file's format is unknown.
    std::optional<ShapeCall> fallback = {};
    bool operator==(const ModelSource&) const = default;
};

enum class UvLayout { face, atlas, layout2017 };

struct Model {
    std::string file;            ///< as written; may be empty when a command makes it
    std::string command;         ///< "cone 1 2 4 3" or "revolution peon.ply 32"; may be empty
    std::optional<int> revolve;  ///< number of copies of the profile `file`
    UvLayout uv = UvLayout::face;
    ModelSource source;
    std::optional<Material> material;
    std::optional<Texture> texture;
    float opacity = 1.0F;  ///< 0..1: multiplies that of its materials
    bool twoSided = false;
    bool autoLod = false;  ///< lod="auto": tessellate on demand, overriding given counts
    std::string id, name;
    Location where;
};

/// N copies of the group's content at seeded random places of a ring about Y (2017 dialect).
struct Scatter {
    int count = 0;
    double radiusMin = 0.0, radiusMax = 0.0, yMin = 0.0, yMax = 0.0;
    std::uint64_t seed = 1;  ///< the reader numbers the scatters of a document from 1
};

struct Group {
    std::vector<Transform> transforms;   ///< each multiplies on the right, as OpenGL's stack does
    std::vector<Location> transformsAt;  ///< where each stands in its document; else empty
    std::vector<Light> lights;           ///< light this group and its descendants only
    std::vector<Model> models;
    std::vector<Group> groups;
    std::optional<Scatter> scatter;
    std::string name;
    Location where;
};

struct Camera {
    glm::dvec3 eye{0.0, 0.0, 5.0}, target{0.0}, up{0.0, 1.0, 0.0};
    double fovDeg = 60.0;  ///< vertical, 0 < fov < 180
    double near = 1.0, far = 1000.0;
    Location where;
};

/// Returns the camera that the 2017 dialect's own engine starts with: at the origin, looking
/// along +Z.
inline Camera engineCamera() {
    Camera camera;
    camera.eye = glm::dvec3(0.0);
    camera.target = glm::dvec3(0.0, 0.0, 1.0);
    camera.fovDeg = 45.0;
    return camera;
}

struct Window {
    int width = 512, height = 512;
};

enum class Shading { points, wireframe, solid, chess, flat, gouraud, phong };
inline constexpr EnumWords<Shading, Shading::phong> kShadingWords{
    "points", "wireframe", "solid", "chess", "flat", "gouraud", "phong"};
enum class Viewer { infinite, local };
inline constexpr EnumWords<Viewer, Viewer::local> kViewerWords{"infinite", "local"};
enum class Specular { single, separate };
inline constexpr EnumWords<Specular, Specular::separate> kSpecularWords{"single", "separate"};
/// See-through parts of textures and materials: drawn opaque; in sorted order of the models; or in
/// the order of each pixel.
enum class Transparency { off, on, exact };
inline constexpr EnumWords<Transparency, Transparency::exact> kTransparencyWords{"off", "on",
                                                                                 "exact"};
/// Shadows of the models in the lights: none, or by depth maps.
enum class Shadows { off, map };
inline constexpr EnumWords<Shadows, Shadows::map> kShadowsWords{"off", "map"};

struct Background {
    std::optional<glm::vec3> color;
    std::string file, path;
    Location where;
};
struct Skybox {
    std::string file, path;
    double width = 500.0;
    Location where;
};

/// The image settings of a scene; options of a request win.
struct RenderSettings {
    std::optional<Shading> shading;
    std::optional<int> samples;
    std::optional<bool> axes;
    std::optional<Viewer> viewer;
    std::optional<Specular> specular;
    std::optional<Transparency> transparency;
    std::optional<Shadows> shadows;
    std::optional<glm::dvec2> timeRangeS;  ///< begin < end: span of an animation or turntable
    bool operator==(const RenderSettings&) const = default;
};

/// A document by the name that messages show and by its path among its assets.
struct DocumentPlace {
    std::string name;
    std::string path;  ///< empty: at their top
    bool operator==(const DocumentPlace&) const = default;
};

struct Scene {
    DocumentPlace document;
    Dialect dialect = Dialect::course;
    Location where;  ///< of the root element; line 0: no document, but a mesh file
    std::string title, description;
    std::optional<Window> window;
    std::optional<Camera> camera;  ///< empty: a view that frames all models
    std::vector<Light> lights;
    /// Light on everything, by material ambient: 1 in the course dialect, OpenGL's 0.2 in the
    /// 2017 and 2020 ones.
    glm::vec3 globalAmbient{1.0F};
    std::vector<Group> groups;
    RenderSettings settings;
    Location transparencyWhere;  ///< of settings.transparency; line 0: the document has none
    Background background;
    std::optional<Skybox> skybox;
    std::string entityFile;         ///< as written
    std::shared_ptr<Scene> entity;  ///< drawn in eye space before the third-person camera
    /// `generator cone 1 2 4 3 cone_1_2_4_3.3d` comments: file name -> words after `generator`,
    /// without the file name; the shape's name may be missing or an alias.
    std::map<std::string, std::vector<std::string>> generatorComments;
};

}  // namespace farol::scene
