#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/enum_words.h"
#include "scene/scene.h"

/// What a rubric asks of a scene without a reference (docs/reference/requirements.md).
namespace farol::grade {

/// An interval, both ends included.
struct NumberRange {
    double least = 0.0, most = 1.0;
};

/// What is left out of a render to see whether it matters.
enum class Effect { light, texture, normals };
inline constexpr EnumWords<Effect, Effect::normals> kEffectWords{"light", "texture", "normals"};

/// Conditions on an object: all that are set hold. Names of other objects are the ids of
/// definitions, or of requirements that stand before.
struct Selector {
    std::vector<std::string> shapes;  ///< names of shapes, or "file"; empty: any
    std::string name;                 ///< pattern with * and ?; empty: any
    std::optional<bool> isTextured, isEmissive, moves, turns, isBuried;
    /// Groups around the object.
    struct Depth {
        int least = 1, most = 64;
    };
    std::optional<Depth> depth;
    struct Curve {
        int points = 4;             ///< at least
        std::optional<bool> align;  ///< nothing: either
    };
    std::optional<Curve> curve;
    /// Brightness of colours, the mean of the channels, 0..1; shininess 0..128.
    struct Look {
        std::optional<NumberRange> diffuse, ambient, specular, emissive, shininess;
    };
    std::optional<Look> material;
    std::string turnsAbout, below, above, isNot;
    struct Seen {
        int pixels = 1;  ///< at least
        int times = 1;   ///< of the rubric's times, at least
    };
    std::optional<Seen> seen;
    std::vector<std::string> matters;  ///< of kEffectWords
};

/// Objects that a rubric gives a name to, and no points.
struct Definition {
    std::string id;
    Selector select;
};

struct LightSelector {
    std::optional<scene::LightType> type;
    std::string near;     ///< an id; empty: anywhere
    double within = 1.0;  ///< times the radius of that object
    std::string lights;   ///< an id: half of those that are visible change without the light
};

struct MeshSelector {
    std::string file = "*.3d";  ///< pattern of the file's name
    std::string shape;          ///< a call as of `farol generate`: "sphere 1 10 10"
};

/// What counts once among several matches.
enum class Distinct { objects, textures, meshes };
inline constexpr EnumWords<Distinct, Distinct::meshes> kDistinctWords{"objects", "textures",
                                                                      "meshes"};

/// A property by which matches are put in order.
enum class OrderKey { document, radius, orbit, period, depth };
inline constexpr EnumWords<OrderKey, OrderKey::depth> kOrderWords{"document", "radius", "orbit",
                                                                  "period", "depth"};
struct Order {
    OrderKey by = OrderKey::orbit, rising = OrderKey::period;
};

/// One line of a rubric without a reference. Exactly one of `select`, `light`, `mesh` is set.
struct Requirement {
    std::string id;    ///< unique in the rubric
    std::string text;  ///< for the student
    double points = 1.0;
    std::optional<Selector> select;
    std::optional<LightSelector> light;
    std::optional<MeshSelector> mesh;
    std::string each;           ///< an id: all matches of it are asked for, in place of `count`
    int count = 1;              ///< at least so many
    std::optional<int> atMost;  ///< more are too many
    bool partial = true;        ///< points by the share that is there
    Distinct distinct = Distinct::objects;
    std::optional<Order> order;
};

/// A part that a person marks: overrides.csv fills it.
struct ManualCriterion {
    std::string id, text;
    double points = 1.0;
};

/// Returns what is wrong with MeshSelector::shape, as parseCall says it, or "".
std::string problemOfShape(const std::string& call);

/// The words of `shape`: those of the generator's table, then "file".
const std::vector<std::string_view>& shapeWords();

}  // namespace farol::grade
