#include "scene/read/tables.h"

#include <cassert>
#include <string>
#include <vector>

#include "core/text.h"

namespace farol::scene {
namespace {

constexpr double kTiny = 1e-9;  ///< lengths and times that must not be zero
constexpr std::string_view kShadings =
    "points wireframe|wire|line|lines solid|unlit chess flat gouraud|smooth phong";
constexpr std::string_view kFilters =
    "nearest linear|bilinear mipmap|trilinear|mipmaps anisotropic|anisotropy";

struct Range {
    double min = -kHugeNumber, max = kHugeNumber;
};
using Text = std::string_view;

constexpr AttributeSpec number(Text name, Text aliases, Text fallback, Text meaning,
                               Range range = {}, bool clamped = false) {
    return {name, aliases, Kind::number, range.min, range.max, {}, clamped, fallback, meaning};
}
constexpr AttributeSpec whole(Text name, Text aliases, Text fallback, Text meaning, Range range) {
    return {name, aliases, Kind::integer, range.min, range.max, {}, false, fallback, meaning};
}
constexpr AttributeSpec text(Text name, Text aliases, Text fallback, Text meaning) {
    return {name, aliases, Kind::text, 0, 0, {}, false, fallback, meaning};
}
constexpr AttributeSpec flag(Text name, Text aliases, Text fallback, Text meaning) {
    return {name, aliases, Kind::flag, 0, 0, {}, false, fallback, meaning};
}
constexpr AttributeSpec word(Text name, Text aliases, Text words, Text fallback, Text meaning) {
    return {name, aliases, Kind::word, 0, 0, words, false, fallback, meaning};
}

constexpr AttributeSpec kRoot[] = {
    word("dialect", "", "course|2022 engine2017|2017 engine2020|2020", "guessed",
         "how the words that dialects read differently are read"),
    text("title", "", "", "see `<title>`"),
    word("camera", "", "framed engine", "framed",
         "the view of a scene without `<camera>`: `framed` shows all models, `engine` is the start "
         "of the 2017 engine"),
    number("camX", "cameraX", "0",
           "a camera by place and angles, degrees: `yaw` 0 looks along +Z, 90 along +X"),
    number("camY", "cameraY", "0", ""),
    number("camZ", "cameraZ", "0", ""),
    number("yaw", "", "0", ""),
    number("pitch", "", "0", "up is positive", {-90, 90}),
};
constexpr AttributeSpec kWindow[] = {
    whole("width", "w", "512", "px", {1, 4096}),
    whole("height", "h", "512", "px", {1, 4096}),
    text("title", "", "", "ignored"),
};
constexpr AttributeSpec kVector[] = {
    number("x", "", "0", ""),
    number("y", "", "0", ""),
    number("z", "", "0", ""),
};
constexpr AttributeSpec kScale[] = {
    number("x", "", "1", "0 flattens, negative mirrors"),
    number("y", "", "1", ""),
    number("z", "", "1", ""),
};
constexpr AttributeSpec kProjection[] = {
    number("fov", "fovy", "60", "vertical field of view, degrees", {1e-3, 179.999}),
    number("near", "znear", "1", "near plane, over 0", {kTiny}),
    number("far", "zfar", "1000", "far plane, more than near", {kTiny}),
};
constexpr AttributeSpec kLights[] = {
    text("name", "", "", ""),
};
constexpr AttributeSpec kLight[] = {
    word("type", "", "point|positional directional|direction|dir|sun spot|spotlight",
         "by the others",
         "point: `pos`. directional: `dir` points *towards* the light. spot: `pos`, `dir` is where "
         "it shines"),
    number(
        "posX", "x positionX", "0",
        "place, in the coordinates of its group; of a directional light without `dir`: its vector"),
    number("posY", "y positionY", "0", ""),
    number("posZ", "z positionZ", "0", ""),
    number("dirX", "spotDirX directionX", "0", "need not be of unit length; must not be zero"),
    number("dirY", "spotDirY directionY", "0", ""),
    number("dirZ", "spotDirZ directionZ", "0", ""),
    number("cutoff", "cut cutoffAngle spotCutoff", "180",
           "spot: half the cone's angle, degrees; 180: no cone", {0, 180}),
    number("exponent", "exp cutoffExponent spotExponent", "0",
           "spot: light falls off as cos^exponent", {0, 10000}),
    number("constant", "attenuationConstant attConstant cons", "1",
           "attenuation 1 / (constant + linear d + quadratic d^2)", {0}),
    number("linear", "attenuationLinear attLinear lin", "0", "", {0}),
    number("quadratic", "attenuationQuadratic attenuation attQuadratic quad", "0",
           "the 2020 dialect calls it `attenuation`", {0}),
    number("alpha", "", "0", "directional, by angles in degrees: longitude about Y"),
    number("beta", "", "0", "latitude; both 0 is +Z"),
    word("space", "", "world camera|eye|view", "world",
         "`camera`: place and direction move with the viewer"),
    number("diffR", "diffuseR", "1",
           "colours 0 to 1 (over 1: all three as 0 to 255, with a warning)", {0, 255}),
    number("diffG", "diffuseG", "1", "", {0, 255}),
    number("diffB", "diffuseB", "1", "", {0, 255}),
    number("ambtR", "ambR ambientR", "0", "", {0, 255}),
    number("ambtG", "ambG ambientG", "0", "", {0, 255}),
    number("ambtB", "ambB ambientB", "0", "", {0, 255}),
    number("specR", "specularR", "1", "", {0, 255}),
    number("specG", "specularG", "1", "", {0, 255}),
    number("specB", "specularB", "1", "", {0, 255}),
    text("diffuse", "color colour", "", "a colour by name or #rrggbb instead"),
    text("ambient", "", "", ""),
    text("specular", "", "", ""),
    text("name", "id", "", ""),
};
constexpr AttributeSpec kGroup[] = {
    text("name", "id", "", "for the grader and for picking"),
};
constexpr AttributeSpec kTranslate[] = {
    number("x", "", "0", ""),
    number("y", "", "0", ""),
    number("z", "", "0", ""),
    number("time", "seconds duration", "", "seconds a lap, with points (1 if left out)", {0}),
    flag("align", "orient aligned", "false", "turn along the curve"),
    text("tracking", "", "", "has no effect"),
};
constexpr AttributeSpec kRotate[] = {
    number("angle", "degrees", "", "degrees, counter-clockwise seen against the axis"),
    number("time", "seconds duration", "",
           "seconds a turn instead; negative turns back; 0 turns nothing"),
    number("x", "axisX", "0", "axis, of any length; 0 0 0 turns nothing"),
    number("y", "axisY", "0", ""),
    number("z", "axisZ", "0", ""),
};
constexpr AttributeSpec kScatter[] = {
    whole("count", "rand n", "0", "copies", {0, 100000}),
    number("xzMin", "xzMinR", "0", "ring about Y: least distance", {0}),
    number("xzMax", "xzMaxR", "xzMin", "largest distance", {0}),
    number("yMin", "yMinR", "0", "height range"),
    number("yMax", "yMaxR", "0", ""),
    whole("seed", "", "counted", "the same number gives the same places", {0, 1e9}),
};
constexpr AttributeSpec kModel[] = {
    text("file", "src path filename", "", "a mesh file, or one to be generated: see below"),
    text("command", "", "", "a shape and its arguments instead: `sphere 1 32 16`"),
    whole("revolve", "", "", "copies of the profile `file` turned about Y", {3, 4096}),
    text("texture", "tex", "", "short for `<texture file>`"),
    word("uv", "", "face atlas layout2017|2017", "face",
         "layout of texture coordinates of generated shapes"),
    word("lod", "", "file auto", "file",
         "`auto`: tessellate on demand, whatever counts the name gives"),
    word("mapping", "", "mesh sphere", "mesh", "`sphere`: from the normalised position"),
    word("filter", "", kFilters, "", "see `<texture>`"),
    flag("twoSided", "", "false", "draw back faces too"),
    number("opacity", "", "1",
           "0 invisible to 1 opaque; multiplies the opacity of its colours and of its texture",
           {0, 1}, true),
    text("id", "", "", "a name to find it by in `layer=id` images"),
    text("name", "", "", ""),
    number("diffR", "diffuseR diffX diffuseX R red", "",
           "material colours 0 to 1 (over 1: all three as 0 to 255, with a warning)", {0, 255}),
    number("diffG", "diffuseG diffY diffuseY G green", "", "", {0, 255}),
    number("diffB", "diffuseB diffZ diffuseZ B blue", "", "", {0, 255}),
    number("ambtR", "ambR ambientR ambX ambientX", "", "", {0, 255}),
    number("ambtG", "ambG ambientG ambY ambientY", "", "", {0, 255}),
    number("ambtB", "ambB ambientB ambZ ambientZ", "", "", {0, 255}),
    number("specR", "specularR specX specularX", "", "", {0, 255}),
    number("specG", "specularG specY specularY", "", "", {0, 255}),
    number("specB", "specularB specZ specularZ", "", "", {0, 255}),
    number("emisR", "emiR emissR emissiveR emissionR emisX emissX emissiveX emissionX", "", "",
           {0, 255}),
    number("emisG", "emiG emissG emissiveG emissionG emisY emissY emissiveY emissionY", "", "",
           {0, 255}),
    number("emisB", "emiB emissB emissiveB emissionB emisZ emissZ emissiveZ emissionZ", "", "",
           {0, 255}),
    number("shininess", "shine shin", "0", "", {0, 10000}),
    text("diffuse", "color colour", "", "a colour by name, `rgb`, #rrggbb, or r,g,b with 0 to 255"),
    text("ambient", "", "", ""),
    text("specular", "", "", ""),
    text("emission", "emissive", "", ""),
    whole("rand", "", "", "copies at random: makes a group with `<scatter>`", {0, 100000}),
    number("xzMinR", "xzMin", "0", "see `<scatter>`", {0}),
    number("xzMaxR", "xzMax", "xzMinR", "", {0}),
    number("yMinR", "yMin", "0", ""),
    number("yMaxR", "yMax", "0", ""),
};
constexpr AttributeSpec kTexture[] = {
    text("file", "src path name", "", "an image, or `chess:COLUMNSxROWS`"),
    word("mapping", "", "mesh sphere", "mesh",
         "`sphere`: u = 0.5 + atan2(z, x) / 2 pi, v = 0.5 - asin(y) / pi of the normalised "
         "position, v = 0 the top row"),
    word("filter", "", kFilters, "mipmap", ""),
    text("color1", "first colour1", "white", "of a chess texture: name, #rrggbb or r,g,b"),
    text("color2", "second colour2", "black", ""),
};
constexpr AttributeSpec kTexgen[] = {
    word("mode", "", "object|object_linear|objectlinear eye|eye_linear|eyelinear", "object",
         "planes in the model's or the viewer's coordinates, as OpenGL's"),
    text("s", "", "1 0 0 0", "plane: s = a x + b y + c z + d"),
    text("t", "", "0 1 0 0", ""),
};
constexpr AttributeSpec kColorPart[] = {
    number("R", "red", "200", "a component left out keeps its default", {0, 255}, true),
    number("G", "green", "200", "", {0, 255}, true),
    number("B", "blue", "200", "", {0, 255}, true),
    number("A", "alpha opacity", "255",
           "opacity, of `<diffuse>` only: 0 to 1, or 0 to 255 if over 1", {0, 255}, true),
    word("max", "", "255 1", "255", "what is full intensity; says which scale is meant"),
    flag("cycles", "", "false", "the turning hue instead"),
};
constexpr AttributeSpec kShininess[] = {
    number("value", "v", "0", "the dialects' range is 0 to 128; more is honoured", {0, 10000}),
};
constexpr AttributeSpec kColor[] = {
    number("R", "red", "", "short for `<diffuse>`: 0 to 255, or 0 to 1 if none is over 1", {0, 255},
           true),
    number("G", "green", "", "", {0, 255}, true),
    number("B", "blue", "", "", {0, 255}, true),
    number("A", "alpha opacity", "255", "opacity of the material, as `A` of `<diffuse>`", {0, 255},
           true),
};
constexpr AttributeSpec kNamedColor[] = {
    text("name", "", "", "any but `rgb`"),
    number("r", "red", "0", "0 to 1", {0, 255}),
    number("g", "green", "0", "", {0, 255}),
    number("b", "blue", "0", "", {0, 255}),
    number("a", "alpha opacity", "1", "opacity of models whose `diffuse` it is: 0 to 1", {0, 255}),
};
constexpr AttributeSpec kGenerator[] = {
    text("argv", "args arguments", "", "the words of a `generator` comment"),
};
constexpr AttributeSpec kSkybox[] = {
    number("width", "size", "500", "has no effect on the image: the box is at infinity", {kTiny}),
    text("texture", "file", "",
         "one image, 4 x 3 fields: top over front, left front right back, bottom under front"),
};
constexpr AttributeSpec kBackground[] = {
    text("texture", "file image", "", "an image that fills the window behind everything"),
    text("color", "colour", "", "#rrggbb, r,g,b with 0 to 255, or a name"),
    number("R", "red", "0", "the colour instead: 0 to 255, or 0 to 1 if none is over 1", {0, 255}),
    number("G", "green", "0", "", {0, 255}),
    number("B", "blue", "0", "", {0, 255}),
};
constexpr AttributeSpec kInclude[] = {
    text("file", "src", "",
         "an XML scene of the bundle, looked for beside the including file first"),
};
constexpr AttributeSpec kEntity[] = {
    text("file", "src", "", "an XML scene of the bundle"),
};
constexpr AttributeSpec kRender[] = {
    word("shading", "", kShadings, "automatic", "see below"),
    whole("aa", "samples antialiasing", "4",
          "samples a pixel: 1, 2, 4, 8 or 16; from 8 on each is shaded, and outlines are held to "
          "1/8 and 1/16 px",
          {1, 16}),
    text("background", "", "", "short for `<background>`"),
    flag("axes", "", "false", "axis lines, -100 to 100"),
    word("viewer", "", "infinite local", "infinite", "of the specular term"),
    word("specular", "", "single separate", "single", "`separate`: added after texturing"),
    word("transparency", "", "off on exact", "on",
         "of textures and materials that are not opaque; see below"),
    word("shadows", "", "off map", "off", "of the models in the lights; see below"),
    text("time", "", "", "range of an animation, seconds: `0..10`"),
};

// The root is a group too: older and smaller dialects put everything straight into it.
constexpr std::string_view kInGroup =
    "transform translate rotate scale lights light models model group scatter xmls xml color";
constexpr std::string_view kInRoot =
    "window camera colors skybox background entity render title description "
    "transform translate rotate scale lights light models model group scatter xmls xml color";

constexpr std::span<const AttributeSpec> kNone;

constexpr ElementSpec kElements[] = {
    {"world", "scene", kRoot, kInRoot,
     "A scene. `<scene>` is the root of the 2017 and 2020 dialects."},
    {"xmls", "includes", kNone, "xml",
     "Other scenes of the bundle, in place: a list of `<xml file>`."},
    {"xml", "include", kInclude, "", "One scene to include."},
    {"title", "", kNone, "", "Text, at most 200 bytes; for the gallery."},
    {"description", "", kNone, "", "Text, at most 4000 bytes; for the gallery."},
    {"window", "", kWindow, "", "The image's size in pixels."},
    {"camera", "", kNone, "position lookAt up projection",
     "`<position>`, `<lookAt>`, `<up>` and `<projection>`, each at most once."},
    {"position", "pos eye", kVector, "", "Where the eye is."},
    {"lookAt", "look look_at target center centre", kVector, "",
     "The point that the camera looks at: `x`, `y`, `z`, 0 if left out.", "position"},
    {"up", "", kVector, "",
     "The direction that is up in the image: `x`, `y`, `z`; 0 1 0 without the element, 0 for a "
     "component left out. Not zero.",
     "position"},
    {"projection", "perspective", kProjection, "",
     "Vertical field of view in degrees, near and far planes."},
    {"lights", "", kLights, "light", "A list of `<light>`."},
    {"light", "", kLight, "", "A point, directional or spot light."},
    {"group", "", kGroup, kInGroup,
     "Transforms, lights, models and groups. Children inherit the transforms."},
    {"transform", "transforms", kNone, "translate rotate scale color",
     "Holds `<translate>`, `<rotate>` and `<scale>`, one of each at most, applied in document "
     "order."},
    {"translate", "translation", kTranslate, "point",
     "A fixed step, or along a closed Catmull-Rom curve in `time` seconds."},
    {"point", "", kVector, "", "A point of a curve."},
    {"rotate", "rotation", kRotate, "", "By degrees about an axis, or one turn in `time` seconds."},
    {"scale", "", kScale, "", "Factors along the axes."},
    {"scatter", "", kScatter, "",
     "Copies of all of the group's content at random places of a ring about Y, evenly over its "
     "area."},
    {"models", "", kNone, "model xml",
     "A list of `<model>`; a model may also stand straight in a group."},
    {"model", "", kModel, "texture color texgen generator",
     "A mesh file, or a shape generated on demand."},
    {"texture", "", kTexture, "", "An image that covers the model."},
    {"texgen", "", kTexgen, "", "Texture coordinates by two planes; the model needs a texture."},
    {"generator", "", kGenerator, "", "The shape behind the model's file."},
    {"color", "colour material", kColor, "diffuse ambient specular emissive shininess",
     "The material of a model; what is left out keeps its default. In a group or a `<transform>`: "
     "of all models in it that have no colour themselves."},
    {"diffuse", "", kColorPart, "", "The colour of lit surfaces."},
    {"ambient", "", kColorPart, "", "As `<diffuse>`, 50 by default.", "diffuse"},
    {"specular", "", kColorPart, "", "As `<diffuse>`, 0 by default.", "diffuse"},
    {"emissive", "emission", kColorPart, "", "As `<diffuse>`, 0 by default.", "diffuse"},
    {"shininess", "", kShininess, "", "The exponent of highlights."},
    {"colors", "colours", kNone, "namedColor",
     "Names for colours, for the attributes `diffuse`, `ambient`, `specular` and `emission` of "
     "models and lights."},
    {"namedColor", "color colour", kNamedColor, "", "A name for a colour."},
    {"skybox", "", kSkybox, "", "An inward box at infinity, one image in the 4 x 3 cross layout."},
    {"background", "", kBackground, "", "An image or colour behind everything."},
    {"entity", "", kEntity, "",
     "A second scene, drawn in eye space in front of a camera that trails it (third person)."},
    {"render", "", kRender, "", "How the scene is to be rendered. A request's own options win."},
};

bool isNamed(std::string_view name, std::string_view aliases, std::string_view word) {
    return sameWord(name, word) || isAmong(aliases, word);
}

}  // namespace

bool isAmong(std::string_view words, std::string_view word) {
    while (!words.empty()) {
        const std::size_t end = std::min(words.find(' '), words.size());
        if (sameWord(words.substr(0, end), word)) return !word.empty();
        words.remove_prefix(std::min(end + 1, words.size()));
    }
    return false;
}

bool isSceneRoot(std::string_view name) { return isAmong("world scene xmls includes", name); }

const ElementSpec* findChild(const ElementSpec& parent, std::string_view name) {
    // The rows of each element's possible children: look-ups need not search all rows.
    static const auto kChildren = [] {
        std::vector<std::vector<const ElementSpec*>> rows(std::size(kElements));
        for (std::size_t i = 0; i < rows.size(); ++i)
            for (const ElementSpec& one : kElements)
                if (isAmong(kElements[i].children, one.name)) rows[i].push_back(&one);
        return rows;
    }();
    for (const ElementSpec* one : kChildren[static_cast<std::size_t>(&parent - kElements)])
        if (isNamed(one->name, one->aliases, name)) return one;
    return nullptr;
}

const ElementSpec& elementSpec(std::string_view canonical) {
    for (const ElementSpec& one : kElements)
        if (one.name == canonical) return one;
    assert(false && "no such element");
    return kElements[0];
}

const AttributeSpec* findAttribute(const ElementSpec& element, std::string_view name) {
    for (const AttributeSpec& one : element.attributes)
        if (isNamed(one.name, one.aliases, name)) return &one;
    return nullptr;
}

std::string_view commonWord(std::string_view word) {
    constexpr std::string_view kOpacity = "opacity alpha transparency transparent translucency";
    constexpr std::string_view kShadows =
        "shadows shadow castShadow castShadows castsShadows receiveShadow receiveShadows";
    for (const std::string_view words : {kOpacity, kShadows})
        for (const std::string_view one : split(words))
            if (sameWord(one, word)) return split(words).front();
    return word;
}

std::span<const ElementSpec> elementSpecs() { return kElements; }

std::string_view canonicalWord(const AttributeSpec& row, std::string_view word) {
    for (const std::string_view group : split(row.words)) {
        const std::string_view canonical = group.substr(0, group.find('|'));
        for (const std::string_view spelling : split(group, "|"))
            if (sameWord(spelling, word)) return canonical;
    }
    return {};
}

}  // namespace farol::scene
