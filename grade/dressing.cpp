#include "grade/dressing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "render/image_file.h"
#include "scene/error.h"
#include "scene/words.h"

namespace farol::grade {
namespace {

using scene::Model;
using scene::Texture;

constexpr double kMost = 0.9;  // of the corners: seams and poles are their own

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

Finding find(const char* code, Topic topic, const std::string& message, const Location& where) {
    return {code, topic, message + inLine(where), where};
}

/// Shapes by name and arguments: what differs, in words; empty where neither is a shape.
std::string shapesDiffer(const Model& theirs, const Model& mine, std::string& code) {
    const auto &wanted = theirs.source.words, &given = mine.source.words;
    if (wanted.empty() || given.empty() || wanted == given) return "";
    code = "model.arguments";
    if (wanted[0] != given[0]) {
        code = "model.shape";
        return "it is a " + given[0] + ", expected a " + wanted[0];
    }
    if (wanted.size() == given.size() && wanted.size() >= 3) {
        std::vector<std::string> swapped = given;
        for (std::size_t i = 1; i + 1 < swapped.size(); ++i) {
            std::swap(swapped[i], swapped[i + 1]);
            if (swapped == wanted) {
                const bool last = i + 2 == swapped.size();
                code = "model.swapped-arguments";
                if (last &&
                    (wanted[0] == "cone" || wanted[0] == "sphere" || wanted[0] == "cylinder"))
                    return "slices and stacks are swapped: " + joined(given) + ", expected " +
                           joined(wanted);
                return "two numbers are swapped: " + joined(given) + ", expected " + joined(wanted);
            }
            std::swap(swapped[i], swapped[i + 1]);
        }
    }
    return "it is " + joined(given) + ", expected " + joined(wanted);
}

/// Asset paths, or nothing where both name the same bytes.
bool sameFile(const scene::Assets& a, const std::string& pathA, const scene::Assets& b,
              const std::string& pathB) {
    return a.read(pathA) == b.read(pathB);
}

enum class Turn { none, upsideDown, mirrored, both, other };

constexpr int kSameLevels = 12;  // of 255: JPEG and other formats of the same picture

/// How `mine` is to be turned to be `theirs`.
Turn turnOf(const render::Image& theirs, const render::Image& mine) {
    if (theirs.width != mine.width || theirs.height != mine.height) return Turn::other;
    const auto meanDifference = [&](bool flipX, bool flipY) {
        double sum = 0.0;
        std::size_t count = 0;
        // A sample of rows and columns says enough.
        const int stepX = std::max(1, mine.width / 128), stepY = std::max(1, mine.height / 128);
        for (int y = 0; y < mine.height; y += stepY)
            for (int x = 0; x < mine.width; x += stepX, ++count) {
                const int fromX = flipX ? mine.width - 1 - x : x;
                const int fromY = flipY ? mine.height - 1 - y : y;
                const auto at = [&](int u, int v) {
                    return 4 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(mine.width) +
                                static_cast<std::size_t>(u));
                };
                for (std::size_t c = 0; c < 3; ++c)
                    sum +=
                        std::abs(theirs.pixels[at(x, y) + c] - mine.pixels[at(fromX, fromY) + c]);
            }
        return sum / (3.0 * static_cast<double>(std::max<std::size_t>(1, count)));
    };
    constexpr std::array<Turn, 4> kTurns{Turn::none, Turn::mirrored, Turn::upsideDown, Turn::both};
    std::size_t best = 0;
    double least = 1e9;
    for (std::size_t i = 0; i < kTurns.size(); ++i) {
        const double found = meanDifference((i & 1) != 0, (i & 2) != 0);
        if (found < least) {
            least = found;
            best = i;
        }
    }
    return least <= kSameLevels ? kTurns[best] : Turn::other;
}

const char* wordOf(scene::Filter filter) {
    constexpr std::array<const char*, 4> kWords{"nearest", "linear", "mipmap", "anisotropic"};
    return kWords[static_cast<std::size_t>(filter)];
}

std::string fileName(const Texture& texture) {
    return texture.chess ? "a chess board" : scene::shown(texture.file);
}

Turn turnOf(const Tree& reference, const Texture& theirs, const Tree& submission,
            const Texture& mine) {
    if (theirs.chess || mine.chess) return theirs.chess == mine.chess ? Turn::none : Turn::other;
    if (sameFile(reference.assets(), theirs.path, submission.assets(), mine.path))
        return Turn::none;
    const auto decoded = [](const Tree& tree, const Texture& texture) {
        return render::decodeImage(tree.assets().read(texture.path).value_or(""), texture.path,
                                   texture.where);
    };
    return turnOf(decoded(reference, theirs), decoded(submission, mine));
}

}  // namespace

Findings compareMeshes(const Piece& reference, const Piece& submission, const Surface& surface) {
    Findings out;
    const Location& where = submission.model->where;
    const std::string name = nameOf(submission) + ": ";
    const auto say = [&](const char* code, Topic topic, const std::string& what) {
        out.push_back(find(code, topic, name + what, where));
    };
    if (reference.model->twoSided != submission.model->twoSided)
        say("model.culling", Topic::models,
            submission.model->twoSided ? "both sides are drawn, expected the front alone"
                                       : "the back is culled, expected both sides");
    if (surface.same()) return out;
    if (!surface.compared || surface.common < kMost) {
        std::string code;
        const std::string what = shapesDiffer(*reference.model, *submission.model, code);
        if (!what.empty())
            say(code.c_str(), Topic::models, what);
        else if (surface.compared)
            say("model.shape", Topic::models,
                "the surface is another one than that of " + meshNameOf(*reference.model));
        return out;
    }
    const bool inward = surface.normalsOpposite > kMost, reversed = surface.windingReversed > kMost;
    if (inward && reversed)
        say("model.inside-out", Topic::models,
            "it is inside out: normals and triangles face inward");
    else if (inward)
        say("model.normals-inward", Topic::models, "normals point inward");
    else if (reversed)
        say("model.winding", Topic::models,
            "triangles are clockwise: the front is culled and the back is seen");
    else if (surface.normalsSame < kMost && surface.normalsUntransposed > kMost)
        say("model.normal-matrix", Topic::models,
            "normals are scaled like positions; they need the inverse transpose (normal matrix)");
    else if (surface.normalsSame < kMost && surface.normalsOfFaces > kMost)
        say("model.flat-normals", Topic::models,
            "it is flat shaded: normals are those of the faces");
    else if (surface.normalsSame < kMost)
        say("model.normals", Topic::models, "normals differ from those of the reference");
    if (surface.uvs && surface.uvSame < kMost && reference.model->texture) {
        if (surface.uvUpsideDown > kMost)
            say("texture.upside-down", Topic::textures,
                "texture upside down: v runs the other way");
        else if (surface.uvMirrored > kMost)
            say("texture.mirrored", Topic::textures, "texture mirrored: u runs the other way");
        else if (surface.uvBoth > kMost)
            say("texture.turned", Topic::textures, "texture turned by half: u and v run backwards");
        else if (surface.uvSwapped > kMost)
            say("texture.swapped-uv", Topic::textures, "u and v of the texture are swapped");
        else
            say("texture.coordinates", Topic::textures, "texture coordinates differ");
    }
    return out;
}

Findings compareTextures(const Tree& reference, const Piece& theirPiece, const Tree& submission,
                         const Piece& myPiece) {
    Findings out;
    const auto &theirs = theirPiece.model->texture, &mine = myPiece.model->texture;
    const std::string name = nameOf(myPiece) + ": ";
    const auto say = [&](const char* code, const std::string& what, const Location& where) {
        out.push_back(find(code, Topic::textures, name + what, where));
    };
    if (!theirs && !mine) return out;
    if (!mine) {
        say("texture.missing", "the texture is missing: expected " + fileName(*theirs),
            myPiece.model->where);
        return out;
    }
    if (!theirs) {
        say("texture.extra", "has a texture (" + fileName(*mine) + "), expected none", mine->where);
        return out;
    }
    switch (turnOf(reference, *theirs, submission, *mine)) {
        case Turn::none:
            break;
        case Turn::upsideDown:
            say("texture.upside-down",
                "texture upside down: the rows of " + fileName(*mine) + " run the other way",
                mine->where);
            break;
        case Turn::mirrored:
            say("texture.mirrored", "texture mirrored: " + fileName(*mine), mine->where);
            break;
        case Turn::both:
            say("texture.turned", "texture turned by half: " + fileName(*mine), mine->where);
            break;
        case Turn::other:
            say("texture.wrong",
                "wrong texture: " + fileName(*mine) + ", expected " + fileName(*theirs),
                mine->where);
    }
    const auto filterOf = [](const Texture& texture) {
        return texture.filter.value_or(scene::Filter::mipmap);
    };
    if (filterOf(*theirs) != filterOf(*mine))
        say("texture.filter",
            filterOf(*theirs) >= scene::Filter::mipmap && filterOf(*mine) < scene::Filter::mipmap
                ? std::string("mipmaps are off: the filter is ") + wordOf(filterOf(*mine)) +
                      ", expected " + wordOf(filterOf(*theirs))
                : std::string("the filter is ") + wordOf(filterOf(*mine)) + ", expected " +
                      wordOf(filterOf(*theirs)),
            mine->where);
    const bool planes =
        mine->mapping == scene::Mapping::texgenEye || mine->mapping == scene::Mapping::texgenObject;
    if (theirs->mapping != mine->mapping ||
        (planes && (theirs->planeS != mine->planeS || theirs->planeT != mine->planeT)))
        say("texture.mapping", "the texture is laid on another way", mine->where);
    return out;
}

Findings compareMaterials(const Piece& reference, const Piece& submission, bool lit) {
    Findings out;
    const scene::Material &theirs = reference.material, &mine = submission.material;
    const Location& where = submission.model->where;
    const std::string name = nameOf(submission) + ": ";
    const auto levels = [](const scene::Color& color) {
        const glm::vec3 rgb = color.rgb * 255.0F;
        return shortNumber(std::round(static_cast<double>(rgb.x) * 100.0) / 100.0) + " " +
               shortNumber(std::round(static_cast<double>(rgb.y) * 100.0) / 100.0) + " " +
               shortNumber(std::round(static_cast<double>(rgb.z) * 100.0) / 100.0);
    };
    const auto off = [](const glm::vec3& a, const glm::vec3& b) {
        const glm::vec3 apart = glm::abs(a - b);
        return std::max({apart.x, apart.y, apart.z});
    };
    constexpr float kSame = 1.0F / 255.0F;
    const auto isBlack = [&](const scene::Color& c) { return off(c.rgb, glm::vec3(0)) < kSame; };
    struct Channel {
        const char* name;
        const scene::Color &theirs, &mine;
        bool seen;
    };
    const std::array<Channel, 4> channels{
        {{"diffuse", theirs.diffuse, mine.diffuse, !(reference.model->texture && !lit)},
         {"ambient", theirs.ambient, mine.ambient, lit},
         {"specular", theirs.specular, mine.specular, lit},
         {"emissive", theirs.emissive, mine.emissive, lit}}};
    std::string small;
    for (const Channel& one : channels) {
        if (!one.seen || (one.theirs.cycles == one.mine.cycles &&
                          (one.theirs.cycles || off(one.theirs.rgb, one.mine.rgb) < kSame)))
            continue;
        const std::string given = levels(one.mine), wanted = levels(one.theirs);
        if (!isBlack(one.theirs) && off(one.mine.rgb * 255.0F, one.theirs.rgb) < 0.02F) {
            small += (small.empty() ? "" : ", ") + std::string(one.name) + " " + given +
                     ", expected " + wanted;
            continue;
        }
        if (isBlack(one.mine) && !isBlack(one.theirs))
            out.push_back(find("material.missing", Topic::materials,
                               name + one.name + " is missing: expected " + wanted, where));
        else
            out.push_back(find("material.color", Topic::materials,
                               name + one.name + " is " + given + ", expected " + wanted, where));
    }
    if (!small.empty())
        out.push_back(find("material.scale", Topic::materials,
                           name + "material colour 0..1 instead of 0..255: " + small, where));
    const bool shines = lit && !isBlack(theirs.specular) && !isBlack(mine.specular);
    if (shines && std::abs(theirs.shininess - mine.shininess) > 0.01F)
        out.push_back(find("material.shininess", Topic::materials,
                           name + "shininess is " +
                               shortNumber(static_cast<double>(mine.shininess)) + ", expected " +
                               shortNumber(static_cast<double>(theirs.shininess)),
                           where));
    return out;
}

}  // namespace farol::grade
