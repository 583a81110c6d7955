#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "scene/scene_builder.h"
#include "scene/text.h"
#include "scene/words.h"

namespace farol::scene {
namespace {

constexpr std::size_t kLongestTitle = 200;  ///< bytes

}  // namespace

SceneBuilder::SceneBuilder(const Document& document, ReadSession& session)
    : document_(document), session_(session) {}

Values SceneBuilder::values(pugi::xml_node element, const ElementSpec& spec, Unknown unknown) {
    if (spec.children.empty())
        for (const pugi::xml_node child : element.children())
            if (child.type() == pugi::node_element) unknownChild(child, spec);
    return readValues(document_, element, spec, findings(), unknown);
}

Values SceneBuilder::values(pugi::xml_node element, std::string_view canonical, Unknown unknown) {
    return values(element, elementSpec(canonical), unknown);
}

void SceneBuilder::onlyOnce(std::string_view canonical, pugi::xml_node child,
                            std::set<std::string_view>& seen) {
    if (seen.insert(canonical).second) return;
    findings().warn("scene.duplicate-element", at(child),
                    "a second <" + std::string(canonical) + "> in one <" +
                        shown(child.parent().name()) + ">; what it says replaces the first");
}

void SceneBuilder::unknownChild(pugi::xml_node child, const ElementSpec& parent) {
    const std::string_view name = child.name();
    std::string belongs;
    std::vector<std::string> known;
    for (const ElementSpec& one : elementSpecs()) {
        if (findChild(one, name) != nullptr && belongs.empty()) belongs = one.name;
        if (isAmong(parent.children, one.name)) known.emplace_back(one.name);
    }
    const std::string tag = "<" + shown(name) + ">";
    const std::string parentTag = "<" + shown(child.parent().name()) + ">";
    if (!belongs.empty()) {
        findings().warn("scene.misplaced", at(child),
                        tag + " means nothing in " + parentTag +
                            " and is ignored; it belongs in <" + belongs + ">");
        return;
    }
    std::string near = findings().crowded() ? "" : didYouMean(std::string(name), known);
    if (!near.empty()) near = "; did you mean <" + near + ">?";
    findings().warn("scene.unknown-element", at(child),
                    tag + " is unknown in " + parentTag + " and is ignored" + near);
}

Scene SceneBuilder::build() {
    const pugi::xml_node root = document_.root();
    if (!root) return std::move(scene_);  // told by the repair
    scene_.generatorComments = document_.repaired().generatorComments;
    Group group;
    group.where = at(root);
    if (sameWord(root.name(), "xmls") || sameWord(root.name(), "includes")) {
        includes(root, group, true);
    } else if (sameWord(root.name(), "world") || sameWord(root.name(), "scene")) {
        scene_.dialect = detectDialect(document_, findings());
        rootAttributes(root);
        if (isOrdered()) scene_.globalAmbient = glm::vec3(0.2F);
        GroupState state;
        state.isRoot = true;
        // Colours first: a model may name one that is defined below it.
        for (const pugi::xml_node child : root.children())
            if (sameWord(child.name(), "colors") || sameWord(child.name(), "colours"))
                colors(child);
        groupContent(root, elementSpec("world"), group, state);
    } else {
        std::string near = didYouMean(root.name(), {"world", "scene"});
        if (!near.empty()) near = "; did you mean <" + near + ">?";
        findings().error("scene.root", at(root),
                         "the root element is <" + shown(root.name()) +
                             ">; a scene's is <world> or <scene>" + near);
        return std::move(scene_);
    }
    // The root is a group of its own only if it has what a group has.
    const bool isGroup = !group.transforms.empty() || !group.models.empty() || group.scatter;
    if (!isGroup || scene_.dialect == Dialect::course) scene_.lights = std::move(group.lights);
    if (isGroup) {
        if (scene_.dialect == Dialect::course) group.lights.clear();
        scene_.groups.push_back(std::move(group));
    } else {
        scene_.groups = std::move(group.groups);
    }
    return std::move(scene_);
}

bool SceneBuilder::rootElement(std::string_view canonical, pugi::xml_node element) {
    static constexpr std::pair<std::string_view, RootReader> kReaders[] = {
        {"window", &SceneBuilder::window}, {"camera", &SceneBuilder::camera},
        {"skybox", &SceneBuilder::skybox}, {"background", &SceneBuilder::background},
        {"entity", &SceneBuilder::entity}, {"render", &SceneBuilder::render},
        {"title", &SceneBuilder::title},   {"description", &SceneBuilder::description},
    };
    if (canonical == "colors") return true;  // read before the rest
    for (const auto& [name, reader] : kReaders) {
        if (name != canonical) continue;
        if (name != "entity") onlyOnce(name, element, rootSeen_);
        (this->*reader)(element);
        return true;
    }
    return false;
}

void SceneBuilder::rootAttributes(pugi::xml_node root) {
    const Values given = values(root, "world");
    scene_.title = bounded(given.text("title"), kLongestTitle, given.where("title"), "the title");
    if (given.text("dialect") == "course") scene_.dialect = Dialect::course;
    if (given.text("dialect") == "engine2017") scene_.dialect = Dialect::engine2017;
    if (given.text("dialect") == "engine2020") scene_.dialect = Dialect::engine2020;
    if (!given.hasAny("camX camY camZ yaw pitch")) return;
    Camera made;
    made.where = at(root);
    if (isOrdered()) made.fovDeg = 45.0;
    made.eye = given.vector("camX", "camY", "camZ", glm::dvec3(0.0));
    const double yaw = glm::radians(std::fmod(given.number("yaw", 0.0), 360.0));
    // At the poles the view would be parallel to up.
    const double pitch = glm::radians(glm::clamp(given.number("pitch", 0.0), -89.9, 89.9));
    made.target = made.eye + glm::dvec3(std::sin(yaw) * std::cos(pitch), std::sin(pitch),
                                        std::cos(yaw) * std::cos(pitch));
    if (given.damaged) return;
    scene_.camera = made;
    rootSeen_.insert("camera");
}

void SceneBuilder::window(pugi::xml_node element) {
    const Values given = values(element, "window");
    Window made;
    made.width = given.integer("width").value_or(made.width);
    made.height = given.integer("height").value_or(made.height);
    scene_.window = made;
}

void SceneBuilder::camera(pugi::xml_node element) {
    Camera made;
    made.where = at(element);
    bool damaged = false, hasPosition = false;
    Location up = made.where, range = made.where;
    const ElementSpec& spec = elementSpec("camera");
    values(element, spec);
    std::set<std::string_view> seen;
    children(element, spec, [&](std::string_view canonical, pugi::xml_node child) {
        onlyOnce(canonical, child, seen);
        const Values given = values(child, canonical);
        damaged = damaged || given.damaged;
        if (canonical == "position") {
            made.eye = given.vector("x", "y", "z", glm::dvec3(0.0));
            hasPosition = true;
        } else if (canonical == "lookAt") {
            made.target = given.vector("x", "y", "z", glm::dvec3(0.0));
        } else if (canonical == "up") {
            made.up = given.vector("x", "y", "z", glm::dvec3(0.0));
            up = at(child);
        } else {
            tellRadians(given, "fov", "projection");
            made.fovDeg = given.number("fov", made.fovDeg);
            made.near = given.number("near", made.near);
            made.far = given.number("far", made.far);
            range = at(child);
        }
    });
    if (!hasPosition)
        findings().warn("scene.missing-element", at(element),
                        "<camera> has no <position>; 0 0 5 is taken");
    if (!seen.contains("lookAt"))
        findings().info("scene.missing-element", at(element),
                        "<camera> has no <lookAt>; it looks at 0 0 0");
    scene_.camera = made;
    if (!damaged) checkCamera(made, up, range);
}

void SceneBuilder::checkCamera(const Camera& camera, const Location& up, const Location& range) {
    const bool noUp = camera.up == glm::dvec3(0.0);
    if (noUp)
        findings().error("scene.zero-direction", up,
                         "<up> of the camera is zero; give at least one of x, y and z");
    const double size = std::fmax(glm::length(camera.eye), glm::length(camera.target));
    const glm::dvec3 view = camera.target - camera.eye;
    if (glm::length(view) <= 1e-12 * size)
        findings().error("scene.camera", camera.where,
                         "<position> and <lookAt> of the camera are the same point; move one");
    else if (!noUp &&
             glm::length(glm::cross(glm::normalize(view), glm::normalize(camera.up))) <= 1e-9)
        findings().warn(
            "scene.camera", up,
            "<up> of the camera is parallel to its view, so that nothing says what is up "
            "in the picture; the axis farthest from it is taken");
    if (camera.far <= camera.near)
        findings().error("scene.camera", range,
                         "the camera's far (" + formatNumber(camera.far) +
                             ") must be more than its near (" + formatNumber(camera.near) + ")");
}

void SceneBuilder::colors(pugi::xml_node element) {
    const ElementSpec& spec = elementSpec("colors");
    values(element, spec);
    children(element, spec, [&](std::string_view, pugi::xml_node child) {
        const Values given = values(child, "namedColor");
        const std::string& name = given.text("name");
        if (name.empty()) {
            findings().warn("scene.missing-attribute", at(child),
                            "a <color> of <colors> needs a name and is ignored");
            return;
        }
        if (sameWord(name, "rgb")) {
            findings().warn("scene.value", given.where("name"),
                            "the colour \"rgb\" is the turning hue and cannot be defined");
            return;
        }
        const glm::dvec3 read = given.vector("r", "g", "b", glm::dvec3(0.0));
        const bool bytes = std::fmax(read.x, std::fmax(read.y, read.z)) > 1.0;
        if (bytes)
            findings().warn("scene.color-scale", at(child),
                            "a colour over 1: taken as 0 to 255 instead of 0 to 1");
        const Color made{glm::vec3(read / (bytes ? 255.0 : 1.0)), false};
        if (!colors_.insert_or_assign(name, made).second)
            findings().warn("scene.duplicate-element", at(child),
                            "a second colour " + quoted(name) + " replaces the first");
    });
}

void SceneBuilder::skybox(pugi::xml_node element) {
    const Values given = values(element, "skybox");
    if (given.text("texture").empty()) {
        findings().warn("scene.missing-attribute", at(element),
                        "<skybox> names no texture and is ignored");
        return;
    }
    scene_.skybox = Skybox{given.text("texture"), "", given.number("width", 500.0), at(element)};
}

void SceneBuilder::background(pugi::xml_node element) {
    const Values given = values(element, "background");
    scene_.background.where = at(element);
    scene_.background.file = given.text("texture");
    Color color;
    if (namedColor(given, "color", color)) scene_.background.color = color.rgb;
    if (!given.hasAny("texture color"))
        findings().warn("scene.missing-attribute", at(element),
                        "<background> has neither \"texture\" nor \"color\" and is ignored");
}

void SceneBuilder::render(pugi::xml_node element) {
    const Values given = values(element, "render");
    RenderSettings& settings = scene_.settings;
    static constexpr std::string_view kShadings[] = {"points", "wireframe", "solid", "chess",
                                                     "flat",   "gouraud",   "phong"};
    for (std::size_t i = 0; i < std::size(kShadings); ++i)
        if (given.text("shading") == kShadings[i]) settings.shading = static_cast<Shading>(i);
    if (const auto samples = given.integer("aa")) {
        if ((*samples & (*samples - 1)) == 0)
            settings.samples = samples;
        else
            findings().error("scene.range", given.where("aa"),
                             "\"aa\" of <render> must be 1, 2, 4, 8 or 16");
    }
    if (given.has("axes")) settings.axes = given.flag("axes");
    if (given.has("viewer"))
        settings.viewer = given.text("viewer") == "local" ? Viewer::local : Viewer::infinite;
    if (given.has("specular"))
        settings.specular =
            given.text("specular") == "separate" ? Specular::separate : Specular::single;
    if (const std::string& text = given.text("background"); !text.empty()) {
        scene_.background.where = given.where("background");
        if (const auto color = colorText(text))
            scene_.background.color = color->rgb;
        else
            scene_.background.file = text;
    }
    if (!given.has("time")) return;
    std::string range = given.text("time");
    if (const std::size_t dots = range.find(".."); dots != std::string::npos)
        range.replace(dots, 2, " ");
    const auto words = split(range);
    const ParsedNumber begin = parseNumber(words.empty() ? "" : words[0]);
    const ParsedNumber end = parseNumber(words.size() == 2 ? words[1] : "");
    if (begin.problem.empty() && end.problem.empty() && begin.value < end.value)
        settings.timeRangeS = glm::dvec2(begin.value, end.value);
    else
        findings().error("scene.value", given.where("time"),
                         "\"time\" of <render> must be a range of seconds like \"0..10\"");
}

std::string SceneBuilder::bounded(std::string_view text, std::size_t longest, const Location& where,
                                  const std::string& what) {
    text = trimmed(text);
    if (text.size() <= longest) return std::string(text);
    findings().warn("limit.text", where,
                    what + " is cut after " + std::to_string(longest) + " bytes");
    while (longest > 0 && (static_cast<unsigned char>(text[longest]) & 0xC0U) == 0x80U) --longest;
    return std::string(trimmed(text.substr(0, longest)));
}

void SceneBuilder::title(pugi::xml_node element) {
    scene_.title = bounded(element.child_value(), kLongestTitle, at(element),
                           "<" + shown(element.name()) + ">");
}

void SceneBuilder::description(pugi::xml_node element) {
    scene_.description =
        bounded(element.child_value(), 4000, at(element), "<" + shown(element.name()) + ">");
}

}  // namespace farol::scene
