#include "grade/structure/dressing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/text.h"
#include "generator/registry.h"
#include "grade/structure/messages.h"
#include "grade/structure/slips.h"

namespace farol::grade {
namespace {

using scene::Material;
using scene::Model;
using scene::Texture;

constexpr float kSameLevel = 1.0F / 255.0F;

float apartOf(const glm::vec3& a, const glm::vec3& b) {
    const glm::vec3 apart = glm::abs(a - b);
    return std::max({apart.x, apart.y, apart.z});
}

bool isBlack(const scene::Color& color) {
    return !color.cycles && apartOf(color.rgb, glm::vec3(0)) < kSameLevel;
}

/// Colours of a material that differ in one way.
struct Channels {
    std::vector<std::string> names, is, expected;  // "diffuse", "diffuse 255 0 0", ...
    std::vector<scene::Color Material::*> at;

    Message values() const { return twoValues(joined(is, ", "), joined(expected, ", ")); }
};

Outline::Item& itemAt(Outline& outline, int item) {
    return outline.items[static_cast<std::size_t>(item)];
}

/// Replaces the mesh; one of another size goes into a group that scales it back.
void takeMesh(Outline& outline, int item, const Outline::Item& theirs,
              const glm::dmat4& mineFromTheirs) {
    Outline::Item& mine = itemAt(outline, item);
    const Model model = modelOfReference(theirs);
    mine.model.source = model.source;
    mine.model.file = model.file;
    mine.model.command = model.command;
    mine.model.revolve = model.revolve;
    mine.model.uv = model.uv;
    mine.model.autoLod = model.autoLod;
    mine.mesh = theirs.mesh;
    if (mineFromTheirs == glm::dmat4(1.0)) return;
    const auto parts = decomposed(mineFromTheirs);
    if (!parts) return;
    Outline::Node node;
    node.parent = mine.node;
    for (const scene::Transform& part : *parts) {
        Link link;
        link.transform = part;
        link.id = outline.nextLink++;
        node.links.push_back(link);
    }
    mine.node = static_cast<int>(outline.nodes.size());
    outline.nodes.push_back(std::move(node));
}

class Dresser {
  public:
    Dresser(const SearchContext& context, const Outline& mine, const Matching& matching, bool lit)
        : context_(context),
          mine_(mine),
          matching_(matching),
          isLit_(lit),
          poses_(posesOf(mine, context.timesS.front())) {}

    std::vector<Fix> run() {
        for (std::size_t i = 0; i < matching_.mineOf.size(); ++i) {
            if (matching_.mineOf[i] < 0) continue;
            const auto theirs = static_cast<int>(i);
            compareMeshes(theirs, matching_.mineOf[i]);
            compareTextures(theirs, matching_.mineOf[i]);
            compareMaterials(theirs, matching_.mineOf[i]);
        }
        return std::move(out_);
    }

  private:
    const Outline::Item& theirs(int i) const {
        return context_.theirs.items[static_cast<std::size_t>(i)];
    }
    const Outline::Item& mine(int j) const { return mine_.items[static_cast<std::size_t>(j)]; }

    void say(int i, int j, const char* code, CauseWords words, const std::string& kind,
             const Location& where, std::function<void(Outline&)> apply) {
        Fix fix;
        fix.code = code;
        fix.who = nameOfItem(mine_, j);
        fix.words = std::move(words);
        fix.kind = std::string(code) + " " + kind;
        fix.where = where;
        fix.apply = std::move(apply);
        fix.items = {i};
        out_.push_back(std::move(fix));
    }

    /// Whether the item's transforms make up for the other size of its mesh.
    bool standsBy(int i, int j, const Likeness& form) const {
        const glm::dmat4& wanted =
            context_.theirSide.poses.front()[static_cast<std::size_t>(theirs(i).node)];
        const glm::dmat4& world = poses_[static_cast<std::size_t>(mine(j).node)];
        return isSamePlace(wanted, world * form.mineFromTheirs, theirs(i).mesh->bounds,
                           symmetryOf(theirs(i)), context_.sceneSize);
    }

    void compareMeshes(int i, int j) {
        const Outline::Item &a = theirs(i), &b = mine(j);
        if (a.model.twoSided != b.model.twoSided) {
            const bool right = a.model.twoSided;
            say(i, j, "model.culling",
                {right ? causeMessage<"part.finding/culled">()
                       : causeMessage<"part.finding/culled-not">(),
                 {}},
                "", b.model.where, [j, right](Outline& o) { itemAt(o, j).model.twoSided = right; });
        }
        if (b.isReversed)
            say(i, j, "model.winding", {causeMessage<"part.finding/winding">(), {}}, "",
                b.model.where, [j](Outline& o) { itemAt(o, j).isReversed = false; });
        if (b.lacksMesh)
            return say(i, j, "model.file-missing",
                       {causeMessage<"part.finding/mesh-file">("file"_arg = b.model.file), {}},
                       b.model.file, b.model.where, [j, a](Outline& o) {
                           takeMesh(o, j, a, glm::dmat4(1.0));
                           itemAt(o, j).material = a.material;
                           itemAt(o, j).model.texture = modelOfReference(a).texture;
                       });
        const Likeness& form = context_.forms.compare(a, b);
        const bool textured =
            a.model.texture.has_value() && a.model.texture->mapping == scene::Mapping::mesh;
        const bool isMadeUpFor = form.mineFromTheirs == glm::dmat4(1.0) || standsBy(i, j, form);
        if (form.isOneForm() && form.surface.isSame(textured) && isMadeUpFor) {
            compareDivisions(i, j);
            return;
        }
        const Surface& surface = form.surface;
        constexpr double kMinShare = 0.85;  // of the corners: seams and poles are their own
        const glm::dmat4 way =
            form.isOneForm() && isMadeUpFor ? form.mineFromTheirs : glm::dmat4(1.0);
        const auto apply = [j, a, way](Outline& o) { takeMesh(o, j, a, way); };
        const auto tell = [&](const char* code, const Message& finding, const Message& values = {},
                              const std::string& kind = "") {
            say(i, j, code, {finding, values}, kind, b.model.where, apply);
        };
        if (!form.isOneForm()) return tellShape(a, b, tell);
        if (!isMadeUpFor) {
            if (a.model.source.shape.entry != nullptr && b.model.source.shape.entry != nullptr)
                return tellShape(a, b, tell);
            return tell("model.arguments", causeMessage<"part.finding/mesh-size">());
        }
        const bool inward = surface.normalsOpposite > kMinShare,
                   reversed = surface.windingReversed > kMinShare;
        if (inward && reversed)
            return tell("model.inside-out", causeMessage<"part.finding/inside-out">());
        if (reversed) return tell("model.winding", causeMessage<"part.finding/winding">());
        if (inward)
            return tell("model.normals-inward", causeMessage<"part.finding/normals-inward">());
        if (surface.normalsSame < kMinShare && surface.normalsUntransposed > kMinShare)
            return tell("model.normal-matrix", causeMessage<"part.finding/normal-matrix">());
        if (surface.normalsSame < kMinShare && surface.normalsOfFaces > kMinShare)
            return tell("model.flat-normals", causeMessage<"part.finding/flat">());
        if (surface.normalsSame < kMinShare)
            return tell("model.normals", causeMessage<"part.finding/normals">());
        if (!surface.hasUvs || !textured || surface.uvSame > kMinShare) return;
        if (surface.uvUpsideDown > kMinShare)
            return tell("texture.upside-down", causeMessage<"part.finding/uv-upside-down">());
        if (surface.uvMirrored > kMinShare)
            return tell("texture.mirrored", causeMessage<"part.finding/uv-mirrored">());
        if (surface.uvBoth > kMinShare)
            return tell("texture.turned", causeMessage<"part.finding/uv-turned">());
        if (surface.uvSwapped > kMinShare)
            return tell("texture.swapped-uv", causeMessage<"part.finding/uv-swapped">());
        tell("texture.coordinates", causeMessage<"part.finding/texture-coordinates">());
    }

    static Message exchanged(const generator::Argument& first, const generator::Argument& second,
                             const std::string& shape) {
        return causeMessage<"part.finding/exchanged">("first"_arg = lowerCase(first.name),
                                                      "second"_arg = lowerCase(second.name),
                                                      "shape"_arg = shape);
    }

    /// Explains another form; for shapes by their names and arguments.
    template <typename Tell>
    void tellShape(const Outline::Item& a, const Outline::Item& b, const Tell& tell) {
        const scene::ShapeCall &expected = a.model.source.shape, &actual = b.model.source.shape;
        if (expected.entry == nullptr || actual.entry == nullptr)
            return tell("model.shape", causeMessage<"part.finding/surface">());
        const Message values = twoValues(generator::textOf(actual), generator::textOf(expected));
        if (expected.entry != actual.entry)
            return tell("model.shape",
                        causeMessage<"part.finding/shape">("value"_arg = actual.entry->name,
                                                           "expected"_arg = expected.entry->name),
                        values, actual.entry->name + " " + expected.entry->name);
        const std::vector<generator::Argument>& arguments = expected.entry->arguments;
        for (std::size_t k = 0; k + 1 < arguments.size(); ++k) {
            scene::ShapeCall swapped = actual;
            std::swap(swapped.arguments[k], swapped.arguments[k + 1]);
            if (swapped == expected)
                return tell("model.swapped-arguments",
                            exchanged(arguments[k], arguments[k + 1], actual.entry->name), values,
                            std::to_string(k));
        }
        std::vector<std::string> names;
        bool isLarge = false;
        for (std::size_t k = 0; k < arguments.size(); ++k) {
            const double wanted = expected.arguments[k].value, given = actual.arguments[k].value;
            if (std::abs(wanted - given) <= 1e-6 * std::abs(wanted)) continue;
            names.push_back(lowerCase(arguments[k].name));
            isLarge = given > wanted;
        }
        const std::string& shape = actual.entry->name;
        const Message finding =
            names.size() != 1 ? causeMessage<"part.finding/arguments">(
                                    "arguments"_arg = listOf(names), "shape"_arg = shape)
            : isLarge ? causeMessage<"part.finding/argument-large">("argument"_arg = names.front(),
                                                                    "shape"_arg = shape)
                      : causeMessage<"part.finding/argument-small">("argument"_arg = names.front(),
                                                                    "shape"_arg = shape);
        tell("model.arguments", finding, values, joined(names, " "));
    }

    /// The same surface, which a scene's own words divide in another way.
    void compareDivisions(int i, int j) {
        const Outline::Item &a = theirs(i), &b = mine(j);
        const scene::ShapeCall &expected = a.model.source.shape, &actual = b.model.source.shape;
        if (expected.entry == nullptr || expected.entry != actual.entry || expected == actual ||
            a.model.source.kind != b.model.source.kind)
            return;
        const std::vector<generator::Argument>& arguments = expected.entry->arguments;
        const auto apply = [j, a](Outline& o) { takeMesh(o, j, a, glm::dmat4(1.0)); };
        const Message values = twoValues(generator::textOf(actual), generator::textOf(expected));
        bool lengths = false, levels = false;
        for (std::size_t k = 0; k < arguments.size(); ++k) {
            const bool differs = std::abs(expected.arguments[k].value - actual.arguments[k].value) >
                                 1e-6 * std::abs(expected.arguments[k].value);
            (arguments[k].isInteger() ? levels : lengths) |= differs;
        }
        if (lengths || !levels) return;  // made up for by a scale
        for (std::size_t k = 0; k + 1 < arguments.size(); ++k) {
            scene::ShapeCall swapped = actual;
            std::swap(swapped.arguments[k], swapped.arguments[k + 1]);
            if (swapped != expected) continue;
            say(i, j, "model.swapped-arguments",
                {exchanged(arguments[k], arguments[k + 1], actual.entry->name), values},
                std::to_string(k), b.model.where, apply);
            return;
        }
        say(i, j, "model.divisions",
            {causeMessage<"part.finding/divisions">("shape"_arg = actual.entry->name), values}, "",
            b.model.where, apply);
    }

    void compareTextures(int i, int j) {
        const auto &a = theirs(i).model.texture, &b = mine(j).model.texture;
        if ((!a && !b) || mine(j).lacksMesh) return;
        const auto right = modelOfReference(theirs(i)).texture;
        const auto apply = [j, right](Outline& o) { itemAt(o, j).model.texture = right; };
        const auto nameOf = [](const Texture& texture) {
            return texture.chess ? causeMessage<"part.who/chess">()
                                 : causeMessage<"part.who/file">("file"_arg = texture.file);
        };
        const auto isNow = [&] { return causeMessage<"part.values/is">("value"_arg = nameOf(*b)); };
        const std::string file = b && !b->chess ? shown(b->file) : "";
        if (!b)
            return say(i, j, "texture.missing",
                       {causeMessage<"part.finding/texture-missing">(),
                        causeMessage<"part.values/expected">("expected"_arg = nameOf(*a))},
                       "", mine(j).model.where, apply);
        if (mine(j).lacksTexture)
            return say(i, j, "texture.file-missing",
                       {causeMessage<"part.finding/texture-file">("file"_arg = b->file), {}},
                       b->file, b->where, apply);
        if (!a)
            return say(i, j, "texture.extra",
                       {causeMessage<"part.finding/texture-extra">(), isNow()}, "", b->where,
                       apply);
        switch (context_.pictures.compare(*a, *b)) {
            case Turn::none:
                break;
            case Turn::upsideDown:
                return say(i, j, "texture.upside-down",
                           {causeMessage<"part.finding/texture-upside-down">(), isNow()}, "picture",
                           b->where, apply);
            case Turn::mirrored:
                return say(i, j, "texture.mirrored",
                           {causeMessage<"part.finding/texture-mirrored">(), isNow()}, "picture",
                           b->where, apply);
            case Turn::both:
                return say(i, j, "texture.turned",
                           {causeMessage<"part.finding/texture-turned">(), isNow()}, "picture",
                           b->where, apply);
            case Turn::other:
                return say(i, j, "texture.wrong",
                           {causeMessage<"part.finding/texture">(),
                            causeMessage<"part.values/two">("value"_arg = nameOf(*b),
                                                            "expected"_arg = nameOf(*a))},
                           file, b->where, apply);
        }
        const auto filterOf = [](const Texture& texture) {
            return texture.filter.value_or(scene::Filter::mipmap);
        };
        if (filterOf(*a) != filterOf(*b)) {
            const std::string is(scene::kFilterWords[filterOf(*b)]),
                expected(scene::kFilterWords[filterOf(*a)]);
            say(i, j, "texture.filter",
                {filterOf(*a) >= scene::Filter::mipmap && filterOf(*b) < scene::Filter::mipmap
                     ? causeMessage<"part.finding/mipmaps">()
                     : causeMessage<"part.finding/filter">(),
                 twoValues(is, expected)},
                is, b->where, [j, filter = a->filter](Outline& o) {
                    itemAt(o, j).model.texture->filter = filter;
                });
        }
        const bool planes =
            b->mapping == scene::Mapping::texgenEye || b->mapping == scene::Mapping::texgenObject;
        if (a->mapping != b->mapping ||
            (planes && (a->planeS != b->planeS || a->planeT != b->planeT)))
            say(i, j, "texture.mapping", {causeMessage<"part.finding/mapping">(), {}}, "", b->where,
                apply);
    }

    void compareMaterials(int i, int j) {
        if (mine(j).lacksMesh) return;
        const Material &a = theirs(i).material, &b = mine(j).material;
        const Location& where = mine(j).model.where;
        struct Channel {
            const char* name;
            scene::Color Material::*at;
            bool isSeen;
        };
        const std::array<Channel, 4> channels{
            {{"diffuse", &Material::diffuse, !(theirs(i).model.texture && !isLit_)},
             {"ambient", &Material::ambient, isLit_},
             {"specular", &Material::specular, isLit_},
             {"emissive", &Material::emissive, isLit_}}};
        Channels small, missing, other;
        for (const Channel& one : channels) {
            const scene::Color &wanted = a.*one.at, &given = b.*one.at;
            if (!one.isSeen || (wanted.cycles == given.cycles &&
                                (wanted.cycles || apartOf(wanted.rgb, given.rgb) < kSameLevel)))
                continue;
            Channels& of = !isBlack(wanted) && apartOf(given.rgb * 255.0F, wanted.rgb) < 0.06F
                               ? small
                           : isBlack(given) && !isBlack(wanted) ? missing
                                                                : other;
            of.names.emplace_back(one.name);
            of.is.push_back(of.names.back() + " " + levels(given));
            of.expected.push_back(of.names.back() + " " + levels(wanted));
            of.at.push_back(one.at);
        }
        const auto taking = [j, a](const std::vector<scene::Color Material::*>& list,
                                   bool shininess) {
            return [j, a, list, shininess](Outline& o) {
                for (const auto& at : list) itemAt(o, j).material.*at = a.*at;
                if (shininess) itemAt(o, j).material.shininess = a.shininess;
            };
        };
        const bool specularMissing = std::find(missing.at.begin(), missing.at.end(),
                                               &Material::specular) != missing.at.end();
        if (!small.at.empty())
            say(i, j, "material.scale",
                {causeMessage<"part.finding/color-range">(), small.values()}, "", where,
                taking(small.at, false));
        if (!missing.at.empty())
            say(i, j, "material.missing",
                {causeMessage<"part.finding/material-missing">("channels"_arg =
                                                                   listOf(missing.names)),
                 missing.values()},
                joined(missing.names, " "), where, taking(missing.at, specularMissing));
        if (!other.at.empty())
            say(i, j, "material.color",
                {other.at.size() > 1
                     ? causeMessage<"part.finding/colors">("channels"_arg = listOf(other.names))
                     : causeMessage<"part.finding/color">("channel"_arg = other.names.front()),
                 other.values()},
                joined(other.is, " ") + joined(other.expected, " "), where,
                taking(other.at, false));
        const bool shines = isLit_ && !isBlack(a.specular) && !specularMissing;
        if (shines && std::abs(a.shininess - b.shininess) > 0.01F)
            say(i, j, "material.shininess",
                {b.shininess > a.shininess ? causeMessage<"part.finding/shininess-large">()
                                           : causeMessage<"part.finding/shininess-small">(),
                 twoValues(static_cast<double>(b.shininess), static_cast<double>(a.shininess))},
                shortNumber(static_cast<double>(b.shininess)), where, taking({}, true));
    }

    const SearchContext& context_;
    const Outline& mine_;
    const Matching& matching_;
    bool isLit_;
    Poses poses_;
    std::vector<Fix> out_;
};

}  // namespace

scene::Model modelOfReference(const Outline::Item& theirs) {
    scene::Model model = theirs.model;
    if (!model.source.path.empty()) model.source.path = kReferenceFolder + model.source.path;
    if (!model.source.shape.file.empty())
        model.source.shape.file = kReferenceFolder + model.source.shape.file;
    if (model.texture && !model.texture->path.empty())
        model.texture->path = kReferenceFolder + model.texture->path;
    model.where = {};
    return model;
}

std::vector<Fix> explainDress(const SearchContext& context, const Outline& mine,
                              const Matching& matching, bool isLit) {
    return Dresser(context, mine, matching, isLit).run();
}

std::vector<Fix> otherDivisions(const SearchContext& context, const Outline& mine,
                                const Matching& matching) {
    std::vector<Fix> out;
    const Poses poses = posesOf(mine, context.timesS.front());
    for (std::size_t i = 0; i < matching.mineOf.size(); ++i) {
        const int j = matching.mineOf[i];
        if (j < 0) continue;
        const Outline::Item &a = context.theirs.items[i],
                            &b = mine.items[static_cast<std::size_t>(j)];
        const Likeness& form = context.forms.compare(a, b);
        const bool textured = a.model.texture.has_value();
        if (a.mesh->id == b.mesh->id || b.model.source.kind == scene::ModelSource::Kind::shape ||
            !form.isOneForm() || !form.surface.isSame(textured))
            continue;
        // A mesh of another size is a cause, unless a transform compensates it.
        if (form.mineFromTheirs != glm::dmat4(1.0) &&
            !isSamePlace(context.theirSide.poses.front()[static_cast<std::size_t>(a.node)],
                         poses[static_cast<std::size_t>(b.node)] * form.mineFromTheirs,
                         a.mesh->bounds, symmetryOf(a), context.sceneSize))
            continue;
        Fix fix;
        fix.apply = [j, a, way = form.mineFromTheirs](Outline& o) {
            if (!itemAt(o, j).isReversed) takeMesh(o, j, a, way);
        };
        out.push_back(std::move(fix));
    }
    return out;
}

std::vector<Fix> explainSettings(const SearchContext& context, const Outline& mine, bool isLit) {
    std::vector<Fix> out;
    const auto say = [&](const char* code, const Message& finding, const Location& where,
                         std::function<void(Outline&)> apply) {
        Fix fix;
        fix.code = code;
        fix.who = causeMessage<"part.who/scene">();
        fix.words = {finding, {}};
        fix.kind = code;
        fix.where = where;
        fix.apply = std::move(apply);
        for (std::size_t i = 0; i < context.theirs.items.size(); ++i)
            fix.items.push_back(static_cast<int>(i));
        out.push_back(std::move(fix));
    };
    const scene::Scene &theirs = context.theirs.rest, &ours = mine.rest;
    const auto usual = scene::Shading::phong;
    const auto wanted = theirs.settings.shading.value_or(usual),
               given = ours.settings.shading.value_or(usual);
    if (wanted != given && isLit)
        say(given == scene::Shading::flat ? "shading.flat" : "shading.mode",
            given == scene::Shading::flat ? causeMessage<"part.finding/shading-flat">()
                                          : causeMessage<"part.finding/shading">(),
            {},
            [shading = theirs.settings.shading](Outline& o) { o.rest.settings.shading = shading; });
    if (theirs.skybox.has_value() != ours.skybox.has_value() ||
        (theirs.skybox && !context.pictures.isSameFile(theirs.skybox->path, ours.skybox->path))) {
        auto right = theirs.skybox;
        if (right) right->path = kReferenceFolder + right->path;
        say("background.skybox",
            ours.skybox ? causeMessage<"part.finding/skybox">()
                        : causeMessage<"part.finding/skybox-missing">(),
            ours.skybox ? ours.skybox->where : Location{},
            [right](Outline& o) { o.rest.skybox = right; });
    }
    const auto &back = theirs.background, &myBack = ours.background;
    if (back.color != myBack.color || back.path.empty() != myBack.path.empty() ||
        (!back.path.empty() && !context.pictures.isSameFile(back.path, myBack.path))) {
        scene::Background right = back;
        if (!right.path.empty()) right.path = kReferenceFolder + right.path;
        say("background.other", causeMessage<"part.finding/background">(), myBack.where,
            [right](Outline& o) { o.rest.background = right; });
    }
    return out;
}

}  // namespace farol::grade
