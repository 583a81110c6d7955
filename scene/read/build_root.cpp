#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vector_relational.hpp>

#include "core/did_you_mean.h"
#include "core/text.h"
#include "scene/messages.h"
#include "scene/read/foreign.h"
#include "scene/read/scene_builder.h"

namespace farol::scene {
namespace {

constexpr std::size_t kMaxTitleBytes = 200;  ///< bytes

/// `<file="a.3d"/>`: the first known element that has the attribute, as it is written; else
/// nothing.
std::string holderOf(std::string_view attribute, std::string_view known) {
    for (const std::string_view name : split(known))
        for (const AttributeSpec& row : elementSpec(name).attributes)
            if (sameWord(row.name, attribute))
                return std::string(name) + ' ' + std::string(row.name) + "=\"...\"";
    return "";
}

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
    findings().warn(message<"scene.duplicate-element">("element"_arg = canonical,
                                                       "parent"_arg = child.parent().name()),
                    at(child));
}

void SceneBuilder::unknownChild(pugi::xml_node child, const ElementSpec& parent) {
    const std::string_view name = child.name();
    std::string belongs;
    std::size_t fewest = std::string::npos;
    std::vector<std::string> known;
    for (const ElementSpec& one : elementSpecs()) {
        // Where several elements may hold it, the one that holds little else.
        if (findChild(one, name) != nullptr && one.children.size() < fewest) {
            belongs = one.name;
            fewest = one.children.size();
        }
        if (isAmong(parent.children, one.name)) known.emplace_back(one.name);
    }
    const char* const inside = child.parent().name();
    // A child of the parent that may hold it, or the root where there is no group round it.
    std::size_t fewestInside = std::string::npos;
    for (const ElementSpec& one : elementSpecs())
        if (isAmong(parent.children, one.name) && findChild(one, name) != nullptr &&
            one.children.size() < fewestInside) {
            belongs = one.name;
            fewestInside = one.children.size();
        }
    const pugi::xml_node root = child.root().first_child();
    if (belongs == "group" && child.parent().parent() == root) belongs = root.name();
    if (!belongs.empty()) {
        findings().warn(message<"scene.misplaced">("element"_arg = name, "parent"_arg = inside,
                                                   "expected"_arg = belongs),
                        at(child));
        return;
    }
    std::string suggestion = findings().crowded() ? "" : didYouMean(std::string(name), known);
    if (suggestion.empty()) suggestion = holderOf(name, parent.children);
    const std::string_view common = commonWord(name);
    if (suggestion.empty() && common == "shadows") suggestion = "render shadows=\"map\"";
    if (suggestion.empty() && common == "opacity") {
        suggestion = holderOf(common, parent.name);
        if (suggestion.empty()) suggestion = holderOf("A", parent.children);
    }
    findings().warn(message<"scene.unknown-element">("element"_arg = name, "parent"_arg = inside,
                                                     "suggestion"_arg = uncut(suggestion)),
                    at(child));
}

/// Reports a document of another language; other findings about it would mislead.
void SceneBuilder::refuseForeign(pugi::xml_node root, Message text) {
    if (session_.files.size() == 1)
        findings().replaceBy(std::move(text), at(root));
    else
        findings().error(std::move(text), at(root));
}

Scene SceneBuilder::build() {
    const pugi::xml_node root = document_.root();
    if (!root) return std::move(scene_);  // reported by the repair
    if (const auto foreign = foreignRoot(root)) {
        refuseForeign(root, *foreign);
        return std::move(scene_);
    }
    scene_.where = at(root);
    scene_.generatorComments = document_.repaired().generatorComments;
    Group group;
    group.where = at(root);
    const ElementSpec* part = findChild(elementSpec("world"), root.name());
    if (sameWord(root.name(), "xmls") || sameWord(root.name(), "includes")) {
        includes(root, group, true);
    } else if (part != nullptr && isAmong("group models model", part->name)) {
        findings().warn(message<"scene.root/part">("element"_arg = root.name()), at(root));
        GroupState state;
        groupElement(part->name, root, group, state);
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
        findings().error(
            message<"scene.root">("element"_arg = root.name(),
                                  "part"_arg = part != nullptr ? "around it" : "",
                                  "suggestion"_arg = didYouMean(root.name(), {"world", "scene"})),
            at(root));
        return Scene();
    }
    if (const auto foreign = foreignContent(root, !findings().failed())) {
        refuseForeign(root, *foreign);
        return Scene();
    }
    // The root is a group only if it has the content of a group.
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
    scene_.title = bounded(given.text("title"), kMaxTitleBytes, given.where("title"), "title");
    if (given.text("dialect") == "course") scene_.dialect = Dialect::course;
    if (given.text("dialect") == "engine2017") scene_.dialect = Dialect::engine2017;
    if (given.text("dialect") == "engine2020") scene_.dialect = Dialect::engine2020;
    if (given.text("camera") == "engine") {
        scene_.camera = engineCamera();
        scene_.camera->where = given.where("camera");
        rootSeen_.insert("camera");
        findings().info(message<"scene.camera-start">(), given.where("camera"));
    }
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
            warnIfRadians(given, "fov", "projection");
            made.fovDeg = given.number("fov", made.fovDeg);
            made.near = given.number("near", made.near);
            made.far = given.number("far", made.far);
            range = at(child);
        }
    });
    if (!hasPosition) findings().warn(message<"scene.missing-element/position">(), at(element));
    if (!seen.contains("lookAt"))
        findings().info(message<"scene.missing-element/look-at">(), at(element));
    // Without a camera that can be used, the view frames all models.
    scene_.camera.reset();
    if (!damaged && checkCamera(made, up, range)) scene_.camera = made;
}

/// Returns whether an image can be taken with the camera.
bool SceneBuilder::checkCamera(const Camera& camera, const Location& up, const Location& range) {
    const bool noUp = camera.up == glm::dvec3(0.0);
    if (noUp) findings().error(message<"scene.zero-direction/up">(), up);
    const glm::dvec3 view = camera.target - camera.eye;
    // Within rounding along each axis: far along one, the others still give a direction.
    const glm::dvec3 size = glm::max(glm::abs(camera.eye), glm::abs(camera.target));
    const bool isPoint = glm::all(glm::lessThanEqual(glm::abs(view), 1e-12 * size));
    if (isPoint)
        findings().error(message<"scene.camera/point">(), camera.where);
    else if (!noUp &&
             glm::length(glm::cross(glm::normalize(view), glm::normalize(camera.up))) <= 1e-9)
        findings().warn(message<"scene.camera/up">(), up);
    if (camera.far <= camera.near)
        findings().error(
            message<"scene.camera/range">("far"_arg = camera.far, "near"_arg = camera.near), range);
    return !noUp && !isPoint && camera.far > camera.near;
}

void SceneBuilder::colors(pugi::xml_node element) {
    const ElementSpec& spec = elementSpec("colors");
    values(element, spec);
    children(element, spec, [&](std::string_view, pugi::xml_node child) {
        const Values given = values(child, "namedColor");
        const std::string& name = given.text("name");
        if (name.empty()) {
            findings().warn(message<"scene.missing-attribute/ignored">("element"_arg = child.name(),
                                                                       "name"_arg = "name"),
                            at(child));
            return;
        }
        if (sameWord(name, "rgb")) {
            findings().warn(message<"scene.value/rgb">(), given.where("name"));
            return;
        }
        const glm::dvec3 read = given.vector("r", "g", "b", glm::dvec3(0.0));
        const bool bytes = std::fmax(read.x, std::fmax(read.y, read.z)) > 1.0;
        if (bytes) findings().warn(message<"scene.color-scale/bytes">(), at(child));
        const Color made{glm::vec3(read / (bytes ? 255.0 : 1.0)), false};
        opacities_.erase(name);
        if (const auto a = given.number("a")) opacities_[name] = opacityOf(*a);
        if (!colors_.insert_or_assign(name, made).second)
            findings().warn(message<"scene.duplicate-element/color">("name"_arg = name), at(child));
    });
}

void SceneBuilder::skybox(pugi::xml_node element) {
    const Values given = values(element, "skybox");
    if (given.text("texture").empty()) {
        findings().warn(message<"scene.missing-attribute/ignored">("element"_arg = element.name(),
                                                                   "name"_arg = "texture"),
                        at(element));
        return;
    }
    scene_.skybox = Skybox{given.text("texture"), "", given.number("width", 500.0), at(element)};
}

void SceneBuilder::background(pugi::xml_node element) {
    const Values given = values(element, "background");
    scene_.background.where = at(element);
    scene_.background.file = given.text("texture");
    Color color;
    if (namedColor(given, "color", color) || straightColor(given, color))
        scene_.background.color = color.rgb;
    if (!given.hasAny("texture color R G B"))
        findings().warn(message<"scene.missing-attribute/background">(), at(element));
}

void SceneBuilder::render(pugi::xml_node element) {
    const Values given = values(element, "render");
    RenderSettings& settings = scene_.settings;
    settings.shading = kShadingWords.find(given.text("shading"));
    if (const auto samples = given.integer("aa")) {
        if ((*samples & (*samples - 1)) == 0)
            settings.samples = samples;
        else
            findings().error(message<"scene.range/samples">("value"_arg = *samples),
                             given.where("aa"));
    }
    if (given.has("axes")) settings.axes = given.flag("axes");
    settings.viewer = kViewerWords.find(given.text("viewer"));
    settings.specular = kSpecularWords.find(given.text("specular"));
    settings.transparency = kTransparencyWords.find(given.text("transparency"));
    if (settings.transparency) scene_.transparencyWhere = given.where("transparency");
    settings.shadows = kShadowsWords.find(given.text("shadows"));
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
        findings().error(message<"scene.value/time">("value"_arg = given.text("time")),
                         given.where("time"));
}

std::string SceneBuilder::bounded(std::string_view text, std::size_t longest, const Location& where,
                                  std::string_view element) {
    text = trimmed(text);
    if (text.size() <= longest) return std::string(text);
    findings().warn(message<"limit.text">("element"_arg = element, "max"_arg = longest), where);
    while (longest > 0 && (static_cast<unsigned char>(text[longest]) & 0xC0U) == 0x80U) --longest;
    return std::string(trimmed(text.substr(0, longest)));
}

void SceneBuilder::title(pugi::xml_node element) {
    scene_.title = bounded(element.child_value(), kMaxTitleBytes, at(element), "title");
}

void SceneBuilder::description(pugi::xml_node element) {
    scene_.description = bounded(element.child_value(), 4000, at(element), "description");
}

}  // namespace farol::scene
