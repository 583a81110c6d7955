#include <charconv>
#include <sstream>
#include <stdexcept>

#include "tests/support/ray_caster/shape.h"

namespace farol::reference {
namespace {

double numberOf(const std::string& word) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size())
        throw std::invalid_argument("\"" + word + "\" is no number");
    return value;
}

const std::string& textOf(const std::vector<std::string>& words,
                          const std::map<std::string, std::string>& texts) {
    const auto found = words.size() > 1 ? texts.find(words[1]) : texts.end();
    if (found == texts.end())
        throw std::invalid_argument("the file of \"" + words[0] + "\" was not given");
    return found->second;
}

}  // namespace

std::vector<std::string> wordsOf(const scene::Model& model) {
    if (model.revolve && model.command.empty()) return {"revolution", model.file};
    std::string text = model.command;
    if (text.empty()) {
        text = model.file.substr(model.file.find_last_of('/') + 1);
        text = text.substr(0, text.rfind('.'));
        for (char& c : text)
            if (c == '_') c = ' ';
    }
    std::istringstream in(text);
    std::vector<std::string> words;
    for (std::string word; words.size() < 16 && in >> word;) words.push_back(word);
    if (words.empty()) throw std::invalid_argument("the model names no shape");
    if (words[0] == "teapot") words = {"patch", "teapot.patch"};
    return words;
}

std::unique_ptr<Shape> makeShape(const std::vector<std::string>& words, scene::UvLayout uv,
                                 const std::map<std::string, std::string>& texts) {
    if (uv == scene::UvLayout::layout2017)
        throw std::invalid_argument("the reference has no 2017 texture layout");
    const std::string& name = words.at(0);
    const auto length = [&](std::size_t i) { return numberOf(words.at(i)); };
    const bool atlas = uv == scene::UvLayout::atlas;
    const DiscLayout round = atlas ? DiscLayout::cylinderAtlas : DiscLayout::face;
    if (name == "plane") return makePlane(length(1));
    if (name == "box") {
        // `box X` and `box X DIV` are cubes.
        const bool cube = words.size() < 4;
        return makeBox(cube ? glm::dvec3(length(1)) : glm::dvec3(length(1), length(2), length(3)),
                       uv);
    }
    if (name == "sphere") return makeEllipsoid(glm::dvec3(length(1)));
    if (name == "ellipsoid") return makeEllipsoid({length(1), length(2), length(3)});
    if (name == "dome") return makeDome(length(1));
    if (name == "cylinder") return makeFrustum(length(1), length(1), length(2), round);
    if (name == "cone")
        return makeFrustum(length(1), 0.0, length(2),
                           atlas ? DiscLayout::coneAtlas : DiscLayout::face);
    if (name == "frustum") return makeFrustum(length(1), length(2), length(3), round);
    if (name == "torus") return makeTorus(length(1), length(2));
    if (name == "ring") return makeRing(length(1), length(2));
    if (name == "patch" || name == "bezier") return makePatches(readPatches(textOf(words, texts)));
    if (name == "revolution") return makeRevolution(readProfile(textOf(words, texts)));
    throw std::invalid_argument("the reference knows no shape \"" + name + "\"");
}

std::vector<PatchNet> readPatches(const std::string& text) {
    std::string blanks = text;
    for (char& c : blanks)
        if (c == ',') c = ' ';
    std::istringstream in(blanks);
    std::size_t count = 0, points = 0;
    in >> count;
    std::vector<std::vector<std::size_t>> indices;
    for (std::size_t i = 0; i < count && in; ++i) {
        indices.emplace_back(16);
        for (std::size_t& one : indices.back()) in >> one;
    }
    in >> points;
    std::vector<glm::dvec3> all;
    for (std::size_t i = 0; i < points && in; ++i) {
        glm::dvec3& p = all.emplace_back();
        in >> p.x >> p.y >> p.z;
    }
    if (!in || count == 0) throw std::invalid_argument("not a patch file");
    std::vector<PatchNet> nets;
    for (const std::vector<std::size_t>& patch : indices) {
        PatchNet& net = nets.emplace_back();
        for (const std::size_t one : patch) net.push_back(all.at(one));
    }
    return nets;
}

std::vector<glm::dvec2> readProfile(const std::string& text) {
    std::istringstream in(text);
    std::size_t count = 0;
    for (std::string line; std::getline(in, line) && line.rfind("end_header", 0) != 0;)
        if (line.rfind("element vertex ", 0) == 0) count = std::stoul(line.substr(15));
    std::vector<glm::dvec2> points;
    for (std::size_t i = 0; i < count; ++i) {
        double z = 0.0;
        glm::dvec2 p;
        if (!(in >> p.x >> p.y >> z)) throw std::invalid_argument("not an ascii profile");
        points.push_back(p);
    }
    return points;
}

}  // namespace farol::reference
