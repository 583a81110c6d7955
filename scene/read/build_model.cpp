#include <array>

#include "core/text.h"
#include "scene/messages.h"
#include "scene/read/scene_builder.h"

namespace farol::scene {
namespace {

std::optional<glm::dvec4> plane(std::string_view text) {
    const auto words = split(text);
    if (words.size() != 4) return std::nullopt;
    glm::dvec4 result{};
    for (int i = 0; i < 4; ++i) {
        const ParsedNumber parsed = parseNumber(words[static_cast<std::size_t>(i)]);
        if (!parsed.problem.empty()) return std::nullopt;
        result[i] = parsed.value;
    }
    return result;
}

/// "8x8": columns and rows, 1..4096 each.
std::optional<Chess> chessOf(std::string_view size) {
    constexpr double kMaxFields = 4096;
    const std::size_t times = size.find_first_of("xX");
    if (times == std::string_view::npos) return std::nullopt;
    const ParsedNumber columns = parseNumber(size.substr(0, times));
    const ParsedNumber rows = parseNumber(size.substr(times + 1));
    const auto good = [](const ParsedNumber& n) {
        return n.problem.empty() && n.value >= 1 && n.value <= kMaxFields &&
               n.value == static_cast<int>(n.value);
    };
    if (!good(columns) || !good(rows)) return std::nullopt;
    Chess chess;
    chess.columns = static_cast<int>(columns.value);
    chess.rows = static_cast<int>(rows.value);
    return chess;
}

}  // namespace

void SceneBuilder::model(pugi::xml_node element, Group& group) {
    const Values given = values(element, "model");
    Model made;
    made.where = at(element);
    made.file = given.text("file");
    made.command = given.text("command");
    made.revolve = given.integer("revolve");
    made.autoLod = given.text("lod") == "auto";
    made.twoSided = given.flag("twoSided");
    made.opacity = static_cast<float>(given.number("opacity", 1.0));
    made.id = given.text("id");
    made.name = given.text("name");
    if (given.text("uv") == "atlas") made.uv = UvLayout::atlas;
    if (given.text("uv") == "layout2017") made.uv = UvLayout::layout2017;
    if (!given.text("texture").empty()) {
        made.texture.emplace().where = given.where("texture");
        setTextureFile(given.text("texture"), given.where("texture"), *made.texture);
    }
    modelChildren(element, made);
    if (made.texture && made.texture->file.empty() && !made.texture->chess) made.texture.reset();
    modelMaterial(given, made);
    if (made.texture && made.texture->mapping == Mapping::mesh && given.text("mapping") == "sphere")
        made.texture->mapping = Mapping::sphere;
    if (made.texture && !made.texture->filter)
        made.texture->filter = kFilterWords.find(given.text("filter"));
    if (made.file.empty() && made.command.empty()) {
        if (!given.damaged)
            findings().error(message<"scene.missing-attribute/model">(), at(element));
        return;
    }
    if (!made.file.empty() && !made.command.empty())
        findings().warn(message<"scene.ineffective/file">(), given.where("file"));
    if (!given.has("rand")) {
        group.models.push_back(std::move(made));
        return;
    }
    Scatter scatter;
    scatter.count = given.integer("rand").value_or(0);
    scatter.radiusMin = given.number("xzMinR", 0.0);
    scatter.radiusMax = given.number("xzMaxR", scatter.radiusMin);
    scatter.yMin = given.number("yMinR", 0.0);
    scatter.yMax = given.number("yMaxR", 0.0);
    warnIfSwapped(given, "xzMinR", "xzMaxR");
    warnIfSwapped(given, "yMinR", "yMaxR");
    scatter.seed = ++session_.scatters;
    Group& ring = group.groups.emplace_back();
    ring.where = made.where;
    ring.scatter = scatter;
    ring.models.push_back(std::move(made));
}

void SceneBuilder::modelChildren(pugi::xml_node element, Model& model) {
    std::set<std::string_view> seen;
    // A <texgen> may stand before the <texture> that it is for.
    const bool textured = model.texture || element.find_child([](pugi::xml_node child) {
        return sameWord(child.name(), "texture");
    });
    children(element, elementSpec("model"), [&](std::string_view canonical, pugi::xml_node child) {
        onlyOnce(canonical, child, seen);
        if (canonical == "texture") texture(child, model);
        if (canonical == "color") colorElement(child, model);
        if (canonical == "texgen") texgen(child, textured, model);
        if (canonical == "generator") generatorElement(child, model);
    });
}

void SceneBuilder::setTextureFile(const std::string& file, const Location& where,
                                  Texture& texture) {
    if (!sameWord(std::string_view(file).substr(0, 6), "chess:")) {
        texture.file = file;
        texture.chess.reset();
        return;
    }
    texture.file.clear();
    texture.chess = chessOf(std::string_view(file).substr(6));
    if (!texture.chess) findings().error(message<"scene.value/chess">("value"_arg = file), where);
}

void SceneBuilder::texture(pugi::xml_node element, Model& model) {
    const Values given = values(element, "texture");
    if (given.text("file").empty()) {
        findings().warn(message<"scene.missing-attribute/ignored">("element"_arg = element.name(),
                                                                   "name"_arg = "file"),
                        at(element));
        return;
    }
    if (!model.texture) model.texture.emplace();
    Texture& made = *model.texture;
    made.where = at(element);
    setTextureFile(given.text("file"), given.where("file"), made);
    if (given.text("mapping") == "sphere") made.mapping = Mapping::sphere;
    if (given.has("filter")) made.filter = kFilterWords.find(given.text("filter"));
    Color color;
    if (made.chess && namedColor(given, "color1", color)) made.chess->first = color.rgb;
    if (made.chess && namedColor(given, "color2", color)) made.chess->second = color.rgb;
    if (!made.chess && given.hasAny("color1 color2"))
        findings().warn(message<"scene.ineffective/chess-colors">(), at(element));
}

void SceneBuilder::texgen(pugi::xml_node element, bool textured, Model& model) {
    const Values given = values(element, "texgen");
    if (!model.texture) {
        if (!textured) {
            findings().warn(message<"scene.ineffective/texgen">(), at(element));
            return;
        }
        model.texture.emplace().where = at(element);
    }
    Texture& made = *model.texture;
    made.mapping = given.text("mode") == "eye" ? Mapping::texgenEye : Mapping::texgenObject;
    for (const std::string_view name : {"s", "t"}) {
        if (!given.has(name)) continue;
        const auto read = plane(given.text(name));
        if (read)
            (name == "s" ? made.planeS : made.planeT) = *read;
        else
            findings().error(
                message<"scene.number/plane">("name"_arg = name, "value"_arg = given.text(name)),
                given.where(name));
    }
}

void SceneBuilder::generatorElement(pugi::xml_node element, Model& model) {
    const Values given = values(element, "generator");
    const auto words = split(given.text("argv"));
    if (words.empty()) {
        findings().warn(message<"scene.missing-attribute/ignored">("element"_arg = element.name(),
                                                                   "name"_arg = "argv"),
                        at(element));
        return;
    }
    std::string line = given.text("argv");
    if (lowerCase(words.front()).substr(0, 9) != "generator") line = "generator " + line;
    // With a file name at the end it equals a generator comment; without, a command.
    const auto all = split(line);
    const bool namesFile = all.size() > 2 && all.back().find('.') != std::string_view::npos &&
                           !parseNumber(all.back()).problem.empty();
    if (namesFile) {
        bool conflict = false;
        takeGeneratorWords(line, scene_.generatorComments, conflict);
        if (model.file.empty() && model.command.empty()) model.file = all.back();
        return;
    }
    if (!model.file.empty() || !model.command.empty()) {
        std::vector<std::string> arguments(all.begin() + 1, all.end());
        if (!model.file.empty() && !arguments.empty())
            scene_.generatorComments.emplace(baseName(model.file), std::move(arguments));
        return;
    }
    for (std::size_t i = 1; i < all.size(); ++i)
        model.command += (i > 1 ? " " : "") + std::string(all[i]);
}

}  // namespace farol::scene
