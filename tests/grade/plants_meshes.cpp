#include "core/number.h"
#include "core/text.h"
#include "generator/io/mesh_file.h"
#include "generator/registry.h"
#include "plants.h"

namespace farol::test {
namespace {

bool hasLights(const Sheet& s) {
    for (std::size_t i = 0; i < s.size(); ++i)
        if (s.is(i, "light")) return true;
    return false;
}

/// The words of a model's mesh name: "cone", "1", "2", "4", "3".
std::vector<std::string> wordsOf(const Sheet& s, std::size_t model) {
    std::string name = s.word(model, "file");
    if (!name.ends_with(".3d")) return {};
    name.resize(name.size() - 3);
    std::vector<std::string> words{""};
    for (const char c : name)
        if (c == '_')
            words.emplace_back();
        else
            words.back() += c;
    return words;
}
void setWords(Sheet& s, std::size_t model, const std::vector<std::string>& words) {
    s.set(model, "file", joined(words, "_") + ".3d");
}
Share shapeLength(Sheet& s, Work&, Dice& d, int p) {
    const auto done = changeOne(s, d, p, "model", [&](std::size_t l) {
        std::vector<std::string> words = wordsOf(s, l);
        double value = 0.0;
        if (words.size() < 4 || !generator::parseNumber(words[1], value) || words[0] == "box" ||
            words[0] == "plane" || words[0] == "sphere")
            return false;
        words[1] = formatNumber(value * 1.5);
        setWords(s, l, words);
        return true;
    });
    return done ? Share(oneModel(s)) : done;
}
Share otherShape(Sheet& s, Work&, Dice& d, int p) {
    const auto done = changeOne(s, d, p, "model", [&](std::size_t l) {
        const std::vector<std::string> words = wordsOf(s, l);
        if (words.size() < 3) return false;
        if (words[0] == "sphere")
            s.set(l, "file", "box_" + words[1] + "_4.3d");
        else if (words[0] == "cone" && words.size() >= 4)
            s.set(l, "file", "cylinder_" + words[1] + "_" + words[2] + "_20_2.3d");
        else if (words[0] == "cylinder" && words.size() >= 4)
            s.set(l, "file", "cone_" + words[1] + "_" + words[2] + "_20_2.3d");
        else
            return false;
        return true;
    });
    return done ? Share(oneModel(s)) : done;
}

/// Replaces a shape by a separate mesh: written anew, changed.
Share ownMesh(Sheet& s, Work& work, Dice& d, int p, bool textured,
              const std::function<bool(const std::string& shape)>& fits,
              const std::function<void(generator::MeshArrays&)>& change) {
    const auto done = changeOne(s, d, p, "model", [&](std::size_t l) {
        const std::vector<std::string> words = wordsOf(s, l);
        if (words.size() < 3 || !fits(words[0]) || !s.word(l, "lod").empty()) return false;
        bool hasTexture = false;
        for (std::size_t i = l; i <= s.endOf(l); ++i)
            hasTexture = hasTexture || (s.is(i, "texture") && s.word(i, "mapping").empty());
        if (textured && !hasTexture) return false;
        generator::MeshArrays arrays;
        try {
            arrays = generator::generate(generator::parseCall(words), *work.assets).arrays();
        } catch (const Error&) {
            return false;
        }
        change(arrays);
        const std::string name = "own" + std::to_string(p) + ".3d";
        work.files[name] = generator::io::encodeMesh(generator::Mesh(std::move(arrays)),
                                                     generator::io::Format::text3d);
        s.set(l, "file", name);
        return true;
    });
    return done ? Share(oneModel(s)) : done;
}
Share clockwise(Sheet& s, Work& w, Dice& d, int p) {
    return ownMesh(
        s, w, d, p, false, [](const std::string&) { return true; }, turnTriangles);
}
Share vFlipped(Sheet& s, Work& w, Dice& d, int p) {
    return ownMesh(
        s, w, d, p, true, [](const std::string&) { return true; },
        [](generator::MeshArrays& mesh) {
            for (glm::vec2& uv : mesh.uvs) uv.y = 1.0F - uv.y;
        });
}
Share normalsInward(Sheet& s, Work& w, Dice& d, int p) {
    if (!hasLights(s)) return {};
    return ownMesh(
        s, w, d, p, false, [](const std::string& shape) { return shape != "plane"; },
        [](generator::MeshArrays& mesh) {
            for (glm::vec3& normal : mesh.normals) normal = -normal;
        });
}

}  // namespace

std::vector<Plant> meshPlants() {
    return {
        {"length of a shape", {"model.arguments"}, 4, 20, true, false, shapeLength},
        {"another shape", {"model.shape"}, 5, 24, true, false, otherShape},
        {"triangles clockwise", {"model.winding"}, 8, 32, true, false, clockwise},
        {"V flipped", {"texture.upside-down"}, 4, 18, true, false, vFlipped},
        {"normals inward", {"model.normals-inward"}, 4, 18, true, false, normalsInward},
    };
}

}  // namespace farol::test
