#include "grade/requirements/select.h"

#include <algorithm>
#include <array>

#include "core/text.h"
#include "grade/requirements/messages.h"
#include "grade/rubric/metrics.h"

namespace farol::grade {
namespace {

using Found = std::optional<Fault>;

const scene::Model& modelOf(ObjectSelector& of, std::size_t object) {
    return *of.scene().inventory.objects()[object].model;
}

Fault faultOf(ObjectSelector& of, std::size_t object, Message reason) {
    return {std::move(reason), modelOf(of, object).where};
}

double brightness(const scene::Color& color) {
    return color.cycles ? 1.0 / 3.0 : (color.rgb.r + color.rgb.g + color.rgb.b) / 3.0;
}

/// "sphere", "sphere, torus or box".
Message choiceOf(std::vector<std::string> words) {
    const std::string last = words.back();
    words.pop_back();
    if (words.empty()) return requirementMessage<"part.choice/one">("item"_arg = last);
    return requirementMessage<"part.choice/or">("list"_arg = uncut(joined(words, ", ")),
                                                "last"_arg = last);
}

Found checkShape(ObjectSelector& of, const Selector& select, std::size_t object) {
    if (select.shapes.empty()) return {};
    const std::string& shape = of.scene().inventory.shapeOf(object);
    if (std::find(select.shapes.begin(), select.shapes.end(), shape) != select.shapes.end())
        return {};
    return faultOf(of, object,
                   requirementMessage<"part.miss/shape">("found"_arg = shape,
                                                         "expected"_arg = choiceOf(select.shapes)));
}

Found checkName(ObjectSelector& of, const Selector& select, std::size_t object) {
    if (select.name.empty()) return {};
    const Inventory& inventory = of.scene().inventory;
    const scene::Model& model = modelOf(of, object);
    bool isMatch = isLike(model.name, select.name) || isLike(model.id, select.name) ||
                   isLike(baseName(model.file), select.name);
    for (int at = inventory.objects()[object].node; at >= 0 && !isMatch;
         at = inventory.nodes()[static_cast<std::size_t>(at)].parent)
        isMatch = isLike(inventory.nodes()[static_cast<std::size_t>(at)].group->name, select.name);
    if (isMatch) return {};
    return faultOf(of, object, requirementMessage<"part.miss/name">("pattern"_arg = select.name));
}

Found checkTexture(ObjectSelector& of, const Selector& select, std::size_t object) {
    if (!select.isTextured) return {};
    const bool isTextured = !of.scene().inventory.imageOf(object).empty();
    if (isTextured == *select.isTextured) return {};
    if (isTextured) return faultOf(of, object, requirementMessage<"part.miss/texture-not">());
    const std::optional<scene::Texture>& texture = modelOf(of, object).texture;
    if (!texture || texture->file.empty())
        return faultOf(of, object, requirementMessage<"part.miss/texture">());
    return Fault{requirementMessage<"part.miss/texture-file">("file"_arg = uncut(texture->file)),
                 texture->where.line > 0 ? texture->where : modelOf(of, object).where};
}

Found checkEmissive(ObjectSelector& of, const Selector& select, std::size_t object) {
    if (!select.isEmissive) return {};
    constexpr double kShines = 0.05;
    const bool shines = brightness(of.scene().inventory.materialOf(object).emissive) >= kShines;
    if (shines == *select.isEmissive) return {};
    return faultOf(of, object,
                   shines ? requirementMessage<"part.miss/emissive-not">()
                          : requirementMessage<"part.miss/emissive">());
}

Found checkMoves(ObjectSelector& of, const Selector& select, std::size_t object) {
    if (!select.moves || of.scene().motion.moves(object) == *select.moves) return {};
    return faultOf(of, object,
                   *select.moves ? requirementMessage<"part.miss/moves">()
                                 : requirementMessage<"part.miss/moves-not">());
}

Found checkTurns(ObjectSelector& of, const Selector& select, std::size_t object) {
    if (!select.turns || of.scene().motion.turns(object) == *select.turns) return {};
    return faultOf(of, object,
                   *select.turns ? requirementMessage<"part.miss/turns">()
                                 : requirementMessage<"part.miss/turns-not">());
}

Found checkDepth(ObjectSelector& of, const Selector& select, std::size_t object) {
    if (!select.depth) return {};
    const Inventory& inventory = of.scene().inventory;
    const int depth =
        inventory.nodes()[static_cast<std::size_t>(inventory.objects()[object].node)].depth;
    if (depth >= select.depth->least && depth <= select.depth->most) return {};
    return faultOf(of, object,
                   requirementMessage<"part.miss/depth">("depth"_arg = depth,
                                                         "least"_arg = select.depth->least,
                                                         "most"_arg = select.depth->most));
}

/// Of several curves one that has all is enough; else the innermost's fault is shown.
Found checkCurve(ObjectSelector& of, const Selector& select, std::size_t object) {
    if (!select.curve) return {};
    Found first;
    for (const auto& [curve, where] : of.scene().motion.curvesOf(object)) {
        Found fault;
        const auto count = static_cast<int>(curve->points.size());
        const char* const words[] = {"false", "true"};
        if (count < select.curve->points)
            fault = Fault{requirementMessage<"part.miss/curve-points">(
                              "count"_arg = count, "least"_arg = select.curve->points),
                          where};
        else if (select.curve->align && *select.curve->align != curve->align)
            fault = Fault{requirementMessage<"part.miss/curve-align">(
                              "found"_arg = words[int{curve->align}],
                              "expected"_arg = words[int{*select.curve->align}]),
                          where};
        if (!fault) return {};
        if (!first) first = std::move(fault);
    }
    return first ? first : faultOf(of, object, requirementMessage<"part.miss/curve">());
}

Found checkMaterial(ObjectSelector& of, const Selector& select, std::size_t object) {
    if (!select.material) return {};
    const scene::Material material = of.scene().inventory.materialOf(object);
    const Selector::Look& look = *select.material;
    struct Property {
        const char* name;
        const std::optional<NumberRange>& range;
        double value;
    };
    const Property properties[] = {
        {"diffuse", look.diffuse, brightness(material.diffuse)},
        {"ambient", look.ambient, brightness(material.ambient)},
        {"specular", look.specular, brightness(material.specular)},
        {"emissive", look.emissive, brightness(material.emissive)},
        {"shininess", look.shininess, static_cast<double>(material.shininess)}};
    for (const Property& one : properties)
        if (one.range &&
            (one.value < one.range->least - 1e-6 || one.value > one.range->most + 1e-6))
            return faultOf(of, object,
                           requirementMessage<"part.miss/material">(
                               "property"_arg = one.name, "value"_arg = shortNumber(one.value),
                               "least"_arg = shortNumber(one.range->least),
                               "most"_arg = shortNumber(one.range->most)));
    return {};
}

Found checkNot(ObjectSelector& of, const Selector& select, std::size_t object) {
    if (select.isNot.empty()) return {};
    const auto& others = of.objectsOf(select.isNot);
    if (std::find(others.begin(), others.end(), object) == others.end()) return {};
    return faultOf(of, object, requirementMessage<"part.miss/not">("id"_arg = select.isNot));
}

Found checkOrbit(ObjectSelector& of, const Selector& select, std::size_t object) {
    if (select.turnsAbout.empty() || of.orbitAbout(object, select.turnsAbout)) return {};
    return faultOf(of, object,
                   requirementMessage<"part.miss/turns-about">("id"_arg = select.turnsAbout));
}

template <typename Related>
bool hasRelated(ObjectSelector& of, const std::string& id, Related isRelated) {
    const auto& others = of.objectsOf(id);
    return std::any_of(others.begin(), others.end(), isRelated);
}

Found checkBelow(ObjectSelector& of, const Selector& select, std::size_t object) {
    if (select.below.empty() || hasRelated(of, select.below, [&](std::size_t other) {
            return of.scene().motion.hangsFrom(object, other);
        }))
        return {};
    return faultOf(of, object, requirementMessage<"part.miss/below">("id"_arg = select.below));
}

Found checkAbove(ObjectSelector& of, const Selector& select, std::size_t object) {
    if (select.above.empty() || hasRelated(of, select.above, [&](std::size_t other) {
            return of.scene().motion.hangsFrom(other, object);
        }))
        return {};
    return faultOf(of, object, requirementMessage<"part.miss/above">("id"_arg = select.above));
}

Found checkBuried(ObjectSelector& of, const Selector& select, std::size_t object) {
    if (!select.isBuried) return {};
    const std::optional<std::size_t> around = of.scene().solids.around(object);
    if (around.has_value() == *select.isBuried) return {};
    return faultOf(of, object,
                   around ? requirementMessage<"part.miss/buried">(
                                "who"_arg = of.scene().inventory.nameOf(*around))
                          : requirementMessage<"part.miss/buried-not">());
}

Found checkSeen(ObjectSelector& of, const Selector& select, std::size_t object) {
    if (!select.seen) return {};
    const std::vector<int> pixels = of.scene().seen.pixelsOf(object);
    const auto count = std::count_if(pixels.begin(), pixels.end(),
                                     [&](int one) { return one >= select.seen->pixels; });
    // A scene that stands still has one time, where a rubric leaves the times to it.
    const auto needed =
        std::min<std::ptrdiff_t>(select.seen->times, static_cast<std::ptrdiff_t>(pixels.size()));
    if (count >= needed) return {};
    return faultOf(
        of, object,
        requirementMessage<"part.miss/seen">("least"_arg = select.seen->pixels, "count"_arg = count,
                                             "times"_arg = pixels.size(), "needed"_arg = needed));
}

Found checkMatters(ObjectSelector& of, const Selector& select, std::size_t object) {
    for (const std::string& word : select.matters)
        if (!of.scene().seen.matters(object, *kEffectWords.find(word)))
            return faultOf(of, object,
                           requirementMessage<"part.miss/matters">("effect"_arg = word));
    return {};
}

/// The conditions, those first that say whether an object is meant at all, then by cost.
struct Condition {
    ObjectSelector::Check check;
    bool isOfKind = true;   ///< see NearMiss
    bool isCostly = false;  ///< renders, or looks at all triangles
};
constexpr std::array kConditions{
    Condition{checkShape, false},
    Condition{checkName, false},
    Condition{checkNot, false},
    Condition{checkTexture},
    Condition{checkEmissive},
    Condition{checkMaterial},
    Condition{checkDepth},
    Condition{checkTurns},
    Condition{checkCurve},
    Condition{checkMoves},
    Condition{checkOrbit},
    Condition{checkBelow},
    Condition{checkAbove},
    Condition{checkBuried, true, true},
    Condition{checkSeen, true, true},
    Condition{checkMatters, true, true},
};

}  // namespace

bool isLike(std::string_view name, std::string_view pattern) {
    std::size_t at = 0, in = 0, star = std::string_view::npos, kept = 0;
    while (in < name.size()) {
        if (at < pattern.size() &&
            (pattern[at] == '?' ||
             (pattern[at] != '*' && lowerCase(pattern[at]) == lowerCase(name[in])))) {
            ++at;
            ++in;
        } else if (at < pattern.size() && pattern[at] == '*') {
            star = at++;
            kept = in;
        } else if (star != std::string_view::npos) {
            at = star + 1;
            in = ++kept;
        } else {
            return false;
        }
    }
    while (at < pattern.size() && pattern[at] == '*') ++at;
    return at == pattern.size() && !name.empty();
}

void ObjectSelector::define(const std::string& id, std::vector<std::size_t> objects) {
    defined_[id] = std::move(objects);
}

const std::vector<std::size_t>& ObjectSelector::objectsOf(const std::string& id) const {
    static const std::vector<std::size_t> kNone;
    const auto found = defined_.find(id);
    return found == defined_.end() ? kNone : found->second;
}

std::optional<Orbit> ObjectSelector::orbitAbout(std::size_t object, const std::string& id) {
    for (const std::size_t other : objectsOf(id))
        if (const std::optional<Orbit> orbit = scene_.motion.orbit(object, other)) return orbit;
    return std::nullopt;
}

Selection ObjectSelector::select(const Selector& selector, const std::string& among) {
    std::vector<std::size_t> candidates = objectsOf(among);
    if (among.empty())
        for (std::size_t i = 0; i < scene_.inventory.objects().size(); ++i) candidates.push_back(i);
    Selection out;
    for (const std::size_t object : candidates) {
        std::optional<NearMiss> near;
        int faults = 0;
        for (const Condition& condition : kConditions) {
            if (faults > 1 || (condition.isCostly && faults > 0)) break;
            std::optional<Fault> fault = condition.check(*this, selector, object);
            if (!fault) continue;
            ++faults;
            near = NearMiss{object, std::move(*fault), condition.isOfKind};
        }
        if (faults == 0) out.matches.push_back(object);
        if (faults == 1) out.near.push_back(std::move(*near));
    }
    std::stable_sort(out.near.begin(), out.near.end(), [](const NearMiss& a, const NearMiss& b) {
        return a.isOfKind && !b.isOfKind;
    });
    return out;
}

}  // namespace farol::grade
