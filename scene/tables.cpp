#include "scene/tables.h"

#include <cassert>
#include <string>
#include <vector>

#include "scene/words.h"

namespace farol::scene {
namespace {

constexpr double kTiny = 1e-9;  ///< lengths and times that must not be zero
constexpr std::string_view kShadings =
    "points wireframe|wire|line|lines solid|unlit chess flat gouraud|smooth phong";
constexpr std::string_view kFilters =
    "nearest linear|bilinear mipmap|trilinear|mipmaps anisotropic|anisotropy";

constexpr AttributeSpec kRoot[] = {
    {"dialect", "", Kind::word, 0, 0, "course|2022 engine2017|2017 engine2020|2020"},
    {"title", "", Kind::text},
    {"camX", "cameraX"},
    {"camY", "cameraY"},
    {"camZ", "cameraZ"},
    {"yaw", ""},
    {"pitch", "", Kind::number, -90, 90},
};
constexpr AttributeSpec kWindow[] = {
    {"width", "w", Kind::integer, 1, 4096},
    {"height", "h", Kind::integer, 1, 4096},
    {"title", "", Kind::text},
};
constexpr AttributeSpec kVector[] = {{"x", ""}, {"y", ""}, {"z", ""}};
constexpr AttributeSpec kProjection[] = {
    {"fov", "fovy", Kind::number, 1e-3, 179.999},
    {"near", "znear", Kind::number, kTiny},
    {"far", "zfar", Kind::number, kTiny},
};
constexpr AttributeSpec kLights[] = {{"name", "", Kind::text}};
constexpr AttributeSpec kLight[] = {
    {"type", "", Kind::word, 0, 0, "point|positional directional|direction|sun spot|spotlight"},
    {"posX", "x positionX"},
    {"posY", "y positionY"},
    {"posZ", "z positionZ"},
    {"dirX", "spotDirX directionX"},
    {"dirY", "spotDirY directionY"},
    {"dirZ", "spotDirZ directionZ"},
    {"cutoff", "cut cutoffAngle spotCutoff", Kind::number, 0, 180},
    {"exponent", "exp cutoffExponent spotExponent", Kind::number, 0, 10000},
    {"constant", "attenuationConstant attConstant cons", Kind::number, 0},
    {"linear", "attenuationLinear attLinear lin", Kind::number, 0},
    {"quadratic", "attenuationQuadratic attenuation attQuadratic quad", Kind::number, 0},
    {"alpha", ""},
    {"beta", ""},
    {"space", "", Kind::word, 0, 0, "world camera|eye|view"},
    {"diffR", "diffuseR", Kind::number, 0, 255},
    {"diffG", "diffuseG", Kind::number, 0, 255},
    {"diffB", "diffuseB", Kind::number, 0, 255},
    {"ambtR", "ambR ambientR", Kind::number, 0, 255},
    {"ambtG", "ambG ambientG", Kind::number, 0, 255},
    {"ambtB", "ambB ambientB", Kind::number, 0, 255},
    {"specR", "specularR", Kind::number, 0, 255},
    {"specG", "specularG", Kind::number, 0, 255},
    {"specB", "specularB", Kind::number, 0, 255},
    {"diffuse", "", Kind::text},
    {"ambient", "", Kind::text},
    {"specular", "", Kind::text},
    {"name", "id", Kind::text},
};
constexpr AttributeSpec kGroup[] = {{"name", "id", Kind::text}};
constexpr AttributeSpec kTranslate[] = {
    {"x", ""},
    {"y", ""},
    {"z", ""},
    {"time", "seconds duration", Kind::number, kTiny},
    {"align", "orient aligned", Kind::flag},
};
constexpr AttributeSpec kRotate[] = {
    {"angle", "degrees"}, {"time", "seconds duration"}, {"x", "axisX"}, {"y", "axisY"},
    {"z", "axisZ"},
};
constexpr AttributeSpec kScatter[] = {
    {"count", "rand n", Kind::integer, 0, 100000},
    {"xzMin", "xzMinR", Kind::number, 0},
    {"xzMax", "xzMaxR", Kind::number, 0},
    {"yMin", "yMinR"},
    {"yMax", "yMaxR"},
    {"seed", "", Kind::integer, 0, 1e9},
};
constexpr AttributeSpec kModel[] = {
    {"file", "src", Kind::text},
    {"command", "", Kind::text},
    {"revolve", "", Kind::integer, 3, 4096},
    {"texture", "tex", Kind::text},
    {"uv", "", Kind::word, 0, 0, "face atlas layout2017|2017"},
    {"lod", "", Kind::word, 0, 0, "file auto"},
    {"mapping", "", Kind::word, 0, 0, "mesh sphere"},
    {"filter", "", Kind::word, 0, 0, kFilters},
    {"twoSided", "", Kind::flag},
    {"id", "", Kind::text},
    {"name", "", Kind::text},
    {"diffR", "diffuseR diffX diffuseX R red", Kind::number, 0, 255},
    {"diffG", "diffuseG diffY diffuseY G green", Kind::number, 0, 255},
    {"diffB", "diffuseB diffZ diffuseZ B blue", Kind::number, 0, 255},
    {"ambtR", "ambR ambientR ambX ambientX", Kind::number, 0, 255},
    {"ambtG", "ambG ambientG ambY ambientY", Kind::number, 0, 255},
    {"ambtB", "ambB ambientB ambZ ambientZ", Kind::number, 0, 255},
    {"specR", "specularR specX specularX", Kind::number, 0, 255},
    {"specG", "specularG specY specularY", Kind::number, 0, 255},
    {"specB", "specularB specZ specularZ", Kind::number, 0, 255},
    {"emisR", "emiR emissR emissiveR emissionR emisX emissX emissiveX emissionX", Kind::number, 0,
     255},
    {"emisG", "emiG emissG emissiveG emissionG emisY emissY emissiveY emissionY", Kind::number, 0,
     255},
    {"emisB", "emiB emissB emissiveB emissionB emisZ emissZ emissiveZ emissionZ", Kind::number, 0,
     255},
    {"shininess", "shine shin", Kind::number, 0, 10000},
    {"diffuse", "", Kind::text},
    {"ambient", "", Kind::text},
    {"specular", "", Kind::text},
    {"emission", "emissive", Kind::text},
    {"rand", "", Kind::integer, 0, 100000},
    {"xzMinR", "xzMin", Kind::number, 0},
    {"xzMaxR", "xzMax", Kind::number, 0},
    {"yMinR", "yMin"},
    {"yMaxR", "yMax"},
};
constexpr AttributeSpec kTexture[] = {
    {"file", "src path name", Kind::text},      {"mapping", "", Kind::word, 0, 0, "mesh sphere"},
    {"filter", "", Kind::word, 0, 0, kFilters}, {"color1", "first colour1", Kind::text},
    {"color2", "second colour2", Kind::text},
};
constexpr AttributeSpec kTexgen[] = {
    {"mode", "", Kind::word, 0, 0, "object|object_linear|objectlinear eye|eye_linear|eyelinear"},
    {"s", "", Kind::text},
    {"t", "", Kind::text},
};
constexpr AttributeSpec kColorPart[] = {
    {"R", "red", Kind::number, 0, 255, {}, true},
    {"G", "green", Kind::number, 0, 255, {}, true},
    {"B", "blue", Kind::number, 0, 255, {}, true},
    {"max", "", Kind::word, 0, 0, "255 1"},
    {"cycles", "", Kind::flag},
};
constexpr AttributeSpec kShininess[] = {{"value", "v", Kind::number, 0, 10000}};
constexpr AttributeSpec kNamedColor[] = {
    {"name", "", Kind::text},
    {"r", "red", Kind::number, 0, 255},
    {"g", "green", Kind::number, 0, 255},
    {"b", "blue", Kind::number, 0, 255},
    {"a", "alpha", Kind::number, 0, 255},
};
constexpr AttributeSpec kGenerator[] = {{"argv", "args arguments", Kind::text}};
constexpr AttributeSpec kSkybox[] = {
    {"width", "size", Kind::number, kTiny},
    {"texture", "file", Kind::text},
};
constexpr AttributeSpec kBackground[] = {
    {"texture", "file image", Kind::text},
    {"color", "colour", Kind::text},
};
constexpr AttributeSpec kFile[] = {{"file", "src", Kind::text}};
constexpr AttributeSpec kRender[] = {
    {"shading", "", Kind::word, 0, 0, kShadings},
    {"aa", "samples antialiasing", Kind::integer, 1, 16},
    {"background", "", Kind::text},
    {"axes", "", Kind::flag},
    {"viewer", "", Kind::word, 0, 0, "infinite local"},
    {"specular", "", Kind::word, 0, 0, "single separate"},
    {"time", "", Kind::text},
};

// The root is a group too: older and smaller dialects put everything straight into it.
constexpr std::string_view kInGroup =
    "transform translate rotate scale lights light models model group scatter xmls";
constexpr std::string_view kInRoot =
    "window camera colors skybox background entity render title description "
    "transform translate rotate scale lights light models model group scatter xmls";

constexpr ElementSpec kElements[] = {
    {"world", "scene", kRoot, kInRoot},
    {"xmls", "includes", {}, "xml"},
    {"xml", "include", kFile, ""},
    {"title", "", {}, ""},
    {"description", "", {}, ""},
    {"window", "", kWindow, ""},
    {"camera", "", {}, "position lookAt up projection"},
    {"position", "pos eye", kVector, ""},
    {"lookAt", "look target center centre", kVector, ""},
    {"up", "", kVector, ""},
    {"projection", "perspective", kProjection, ""},
    {"lights", "", kLights, "light"},
    {"light", "", kLight, ""},
    {"group", "", kGroup, kInGroup},
    {"transform", "transforms", {}, "translate rotate scale"},
    {"translate", "translation", kTranslate, "point"},
    {"point", "", kVector, ""},
    {"rotate", "rotation", kRotate, ""},
    {"scale", "", kVector, ""},
    {"scatter", "", kScatter, ""},
    {"models", "", {}, "model"},
    {"model", "", kModel, "texture color texgen generator"},
    {"texture", "", kTexture, ""},
    {"texgen", "", kTexgen, ""},
    {"generator", "", kGenerator, ""},
    {"color", "colour material", {}, "diffuse ambient specular emissive shininess"},
    {"diffuse", "", kColorPart, ""},
    {"ambient", "", kColorPart, ""},
    {"specular", "", kColorPart, ""},
    {"emissive", "emission", kColorPart, ""},
    {"shininess", "", kShininess, ""},
    {"colors", "colours", {}, "namedColor"},
    {"namedColor", "color colour", kNamedColor, ""},
    {"skybox", "", kSkybox, ""},
    {"background", "", kBackground, ""},
    {"entity", "", kFile, ""},
    {"render", "", kRender, ""},
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

const ElementSpec* findChild(const ElementSpec& parent, std::string_view name) {
    // The rows that may stand in each row's element, so that reading does not search them all.
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

std::span<const ElementSpec> elementSpecs() { return kElements; }

std::string_view canonicalWord(const AttributeSpec& row, std::string_view word) {
    for (const std::string_view group : split(row.words)) {
        const std::string_view canonical = group.substr(0, group.find('|'));
        std::string alternatives(group);
        for (char& c : alternatives)
            if (c == '|') c = ' ';
        if (isAmong(alternatives, word)) return canonical;
    }
    return {};
}

}  // namespace farol::scene
