#include "grade/structure/dressing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/text.h"
#include "grade/structure/dress_mesh.h"
#include "grade/structure/messages.h"
#include "grade/structure/slips.h"

namespace farol::grade {
namespace {

using scene::Material;
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

class Dresser {
  public:
    Dresser(const SearchContext& context, const Outline& mine, const Matching& matching, bool lit)
        : context_(context),
          matching_(matching),
          isLit_(lit),
          isAlphaDrawn_(context.theirs.rest.settings.transparency != scene::Transparency::off),
          out_{mine, {}} {}

    std::vector<Fix> run() {
        MeshDresser meshes(context_, out_);
        for (std::size_t i = 0; i < matching_.mineOf.size(); ++i) {
            if (matching_.mineOf[i] < 0) continue;
            const auto theirs = static_cast<int>(i);
            meshes.compare(theirs, matching_.mineOf[i]);
            compareTextures(theirs, matching_.mineOf[i]);
            compareMaterials(theirs, matching_.mineOf[i]);
            compareOpacities(theirs, matching_.mineOf[i]);
        }
        return std::move(out_.fixes);
    }

  private:
    const Outline::Item& theirs(int i) const { return itemAt(context_.theirs, i); }
    const Outline::Item& mine(int j) const { return itemAt(out_.mine, j); }

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
            return out_.add(i, j, "texture.missing",
                            {causeMessage<"part.finding/texture-missing">(),
                             causeMessage<"part.values/expected">("expected"_arg = nameOf(*a))},
                            "", mine(j).model.where, apply);
        if (mine(j).lacksTexture)
            return out_.add(i, j, "texture.file-missing",
                            {causeMessage<"part.finding/texture-file">("file"_arg = b->file), {}},
                            b->file, b->where, apply);
        if (!a)
            return out_.add(i, j, "texture.extra",
                            {causeMessage<"part.finding/texture-extra">(), isNow()}, "", b->where,
                            apply);
        const TextureMatch match = context_.pictures.compare(*a, *b);
        switch (match.turn) {
            case Turn::none:
                break;
            case Turn::upsideDown:
                return out_.add(i, j, "texture.upside-down",
                                {causeMessage<"part.finding/texture-upside-down">(), isNow()},
                                "picture", b->where, apply);
            case Turn::mirrored:
                return out_.add(i, j, "texture.mirrored",
                                {causeMessage<"part.finding/texture-mirrored">(), isNow()},
                                "picture", b->where, apply);
            case Turn::both:
                return out_.add(i, j, "texture.turned",
                                {causeMessage<"part.finding/texture-turned">(), isNow()}, "picture",
                                b->where, apply);
            case Turn::other:
                return out_.add(i, j, "texture.wrong",
                                {causeMessage<"part.finding/texture">(),
                                 causeMessage<"part.values/two">("value"_arg = nameOf(*b),
                                                                 "expected"_arg = nameOf(*a))},
                                file, b->where, apply);
        }
        if (!match.isAlphaSame && isAlphaDrawn_)
            out_.add(i, j, "texture.alpha",
                     {!match.hasAlpha       ? causeMessage<"part.finding/texture-alpha-missing">()
                      : !match.expectsAlpha ? causeMessage<"part.finding/texture-alpha-extra">()
                                            : causeMessage<"part.finding/texture-alpha">(),
                      isNow()},
                     file, b->where, apply);
        const auto filterOf = [](const Texture& texture) {
            return texture.filter.value_or(scene::Filter::mipmap);
        };
        if (filterOf(*a) != filterOf(*b)) {
            const std::string is(scene::kFilterWords[filterOf(*b)]),
                expected(scene::kFilterWords[filterOf(*a)]);
            out_.add(i, j, "texture.filter",
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
            out_.add(i, j, "texture.mapping", {causeMessage<"part.finding/mapping">(), {}}, "",
                     b->where, apply);
    }

    /// That of the material times the model's own.
    void compareOpacities(int i, int j) {
        if (!isAlphaDrawn_ || mine(j).lacksMesh) return;
        const float expected = opacityOf(theirs(i)), actual = opacityOf(mine(j));
        if (std::abs(expected - actual) < kSameLevel) return;
        out_.add(i, j, "material.opacity",
                 {actual == 1.0F      ? causeMessage<"part.finding/opacity-missing">()
                  : expected == 1.0F  ? causeMessage<"part.finding/opacity-extra">()
                  : actual > expected ? causeMessage<"part.finding/opacity-large">()
                                      : causeMessage<"part.finding/opacity-small">(),
                  twoValues(static_cast<double>(actual), static_cast<double>(expected))},
                 shortNumber(static_cast<double>(actual)), mine(j).model.where,
                 [j, material = theirs(i).material.opacity,
                  model = theirs(i).model.opacity](Outline& o) {
                     itemAt(o, j).material.opacity = material;
                     itemAt(o, j).model.opacity = model;
                 });
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
            out_.add(i, j, "material.scale",
                     {causeMessage<"part.finding/color-range">(), small.values()}, "", where,
                     taking(small.at, false));
        if (!missing.at.empty())
            out_.add(i, j, "material.missing",
                     {causeMessage<"part.finding/material-missing">("channels"_arg =
                                                                        listOf(missing.names)),
                      missing.values()},
                     joined(missing.names, " "), where, taking(missing.at, specularMissing));
        if (!other.at.empty())
            out_.add(
                i, j, "material.color",
                {other.at.size() > 1
                     ? causeMessage<"part.finding/colors">("channels"_arg = listOf(other.names))
                     : causeMessage<"part.finding/color">("channel"_arg = other.names.front()),
                 other.values()},
                joined(other.is, " ") + joined(other.expected, " "), where,
                taking(other.at, false));
        const bool shines = isLit_ && !isBlack(a.specular) && !specularMissing;
        if (shines && std::abs(a.shininess - b.shininess) > 0.01F)
            out_.add(
                i, j, "material.shininess",
                {b.shininess > a.shininess ? causeMessage<"part.finding/shininess-large">()
                                           : causeMessage<"part.finding/shininess-small">(),
                 twoValues(static_cast<double>(b.shininess), static_cast<double>(a.shininess))},
                shortNumber(static_cast<double>(b.shininess)), where, taking({}, true));
    }

    const SearchContext& context_;
    const Matching& matching_;
    bool isLit_;
    bool isAlphaDrawn_;  ///< in the reference
    DressFixes out_;
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

}  // namespace farol::grade
