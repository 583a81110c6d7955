#include <algorithm>

#include "grade/structure/dressing.h"
#include "grade/structure/messages.h"
#include "grade/structure/slips.h"

namespace farol::grade {
namespace {

bool isDrawnOpaque(const scene::Scene& scene) {
    return scene.settings.transparency == scene::Transparency::off;
}

/// Whether the reference shows anything through its models.
bool isSeeThrough(const SearchContext& context) {
    const auto& items = context.theirs.items;
    return std::any_of(items.begin(), items.end(), [&](const Outline::Item& item) {
        return opacityOf(item) < 1.0F ||
               (item.model.texture && context.pictures.hasAlpha(*item.model.texture));
    });
}

}  // namespace

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
            Location{},
            [shading = theirs.settings.shading](Outline& o) { o.rest.settings.shading = shading; });
    if (isDrawnOpaque(theirs) != isDrawnOpaque(ours) && isSeeThrough(context))
        say("transparency.mode",
            isDrawnOpaque(ours) ? causeMessage<"part.finding/transparency-off">()
                                : causeMessage<"part.finding/transparency-on">(),
            ours.settings.transparency ? ours.transparencyWhere : ours.where,
            [transparency = theirs.settings.transparency](Outline& o) {
                o.rest.settings.transparency = transparency;
            });
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
