#include "grade/structure/diagnosis.h"

#include <algorithm>
#include <map>
#include <set>

#include "core/text.h"
#include "generator/entry.h"
#include "grade/structure/dressing.h"
#include "grade/structure/lights.h"
#include "grade/structure/messages.h"
#include "grade/structure/places.h"

namespace farol::grade {
namespace {

/// Where items stand together in a tree of nodes: the highest node of which every item is one of
/// `chosen`, for each of them.
class Subtrees {
  public:
    Subtrees(const Outline& outline, const std::vector<bool>& isChosen)
        : outline_(outline), isChosen_(isChosen), hasOther_(outline.nodes.size(), false) {
        for (std::size_t i = 0; i < outline.items.size(); ++i) {
            if (isChosen[i] || outline.items[i].isGone) continue;
            for (const int node : outline.pathTo(outline.items[i].node))
                hasOther_[static_cast<std::size_t>(node)] = true;
        }
        hasOther_[0] = true;  // the world is no group
    }

    /// The chosen items, by the highest group of theirs; those alone in a mixed group by -1 - item.
    std::map<int, std::vector<int>> groups() const {
        std::map<int, std::vector<int>> out;
        for (std::size_t i = 0; i < outline_.items.size(); ++i) {
            if (!isChosen_[i]) continue;
            int top = -1 - static_cast<int>(i);
            for (const int node : outline_.pathTo(outline_.items[i].node))
                if (!hasOther_[static_cast<std::size_t>(node)]) {
                    top = node;
                    break;
                }
            out[top].push_back(static_cast<int>(i));
        }
        return out;
    }

  private:
    const Outline& outline_;
    const std::vector<bool>& isChosen_;
    std::vector<bool> hasOther_;
};

/// Names an item of the reference that the submission lacks, by its name or by its mesh.
Message nameOfMissing(const Outline& theirs, int item) {
    const Outline::Item& one = theirs.items[static_cast<std::size_t>(item)];
    const auto named = [](const std::string& name) {
        return causeMessage<"part.who/model">("name"_arg = name);
    };
    if (!one.model.name.empty()) return named(one.model.name);
    const std::string& own = theirs.nodes[static_cast<std::size_t>(one.node)].name;
    if (!own.empty()) return named(own);
    for (int node = one.node; node > 0; node = theirs.nodes[static_cast<std::size_t>(node)].parent)
        if (const std::string& name = theirs.nodes[static_cast<std::size_t>(node)].name;
            !name.empty())
            return causeMessage<"part.who/model-of">("mesh"_arg = meshNameOf(one.model),
                                                     "group"_arg = name);
    return causeMessage<"part.who/mesh">("mesh"_arg = meshNameOf(one.model));
}

std::vector<Fix> explainMissing(const Outline& theirs, const Matching& matching) {
    std::vector<bool> isMissing(theirs.items.size());
    for (std::size_t i = 0; i < isMissing.size(); ++i) isMissing[i] = matching.mineOf[i] < 0;
    std::vector<Fix> out;
    const auto groups = Subtrees(theirs, isMissing).groups();
    for (const auto& [top, items] : groups) {
        Fix fix;
        const bool isGroup = items.size() > 1;
        fix.code = isGroup ? "group.missing" : "model.missing";
        fix.who = nameOfMissing(theirs, items.front());
        if (isGroup && top > 0 && !theirs.nodes[static_cast<std::size_t>(top)].name.empty())
            fix.who = nameOfNodeAlone(theirs, top);
        fix.words = {isGroup
                         ? causeMessage<"part.predicate/missing-models">("count"_arg = items.size())
                         : causeMessage<"part.predicate/missing">(),
                     {}};
        fix.kind = fix.code + std::to_string(top);
        fix.items = items;
        struct Whole {
            Outline::Item item;
            std::vector<Link> links;
        };
        std::vector<Whole> added;
        for (const int item : items) {
            Whole whole{theirs.items[static_cast<std::size_t>(item)], {}};
            whole.item.model = modelOfReference(whole.item);
            whole.item.number = 0;
            for (const Link* link : chainOf(theirs, whole.item.node)) whole.links.push_back(*link);
            added.push_back(std::move(whole));
        }
        fix.apply = [added](Outline& outline) {
            for (const Whole& one : added) {
                Outline::Node node;
                node.parent = 0;
                node.links = one.links;
                for (Link& link : node.links) link.id = outline.nextLink++;
                Outline::Item item = one.item;
                item.node = static_cast<int>(outline.nodes.size());
                outline.nodes.push_back(std::move(node));
                outline.items.push_back(std::move(item));
            }
        };
        out.push_back(std::move(fix));
    }
    return out;
}

class ExtraFinder {
  public:
    ExtraFinder(const SearchContext& context, const Outline& mine, const Matching& matching)
        : context_(context),
          mine_(mine),
          matching_(matching),
          side_(sideOf(mine, context.timesS)) {}

    std::vector<Fix> run() {
        const auto groups = Subtrees(mine_, matching_.isExtra).groups();
        for (const auto& [top, items] : groups) {
            Fix fix;
            const bool isDoubled =
                std::all_of(items.begin(), items.end(), [&](int item) { return isTwice(item); });
            const bool isGroup = items.size() > 1;
            fix.code = isDoubled ? "model.doubled" : isGroup ? "group.extra" : "model.extra";
            fix.who =
                isGroup && top > 0 ? nameOfNodeAlone(mine_, top) : nameOfItem(mine_, items.front());
            fix.words = {isDoubled ? causeMessage<"part.predicate/doubled">()
                                   : causeMessage<"part.predicate/extra">(),
                         {}};
            fix.kind = fix.code + std::to_string(top);
            fix.where = isGroup && top > 0
                            ? mine_.nodes[static_cast<std::size_t>(top)].where
                            : mine_.items[static_cast<std::size_t>(items.front())].model.where;
            fix.apply = [items = items](Outline& outline) {
                for (const int item : items)
                    outline.items[static_cast<std::size_t>(item)].isGone = true;
            };
            out_.push_back(std::move(fix));
        }
        return std::move(out_);
    }

  private:
    /// Whether another of the submission's items has the form and the place of this one.
    bool isTwice(int extra) const {
        const Outline::Item& item = mine_.items[static_cast<std::size_t>(extra)];
        for (const int other : matching_.mineOf) {
            if (other < 0) continue;
            const Outline::Item& one = mine_.items[static_cast<std::size_t>(other)];
            if (one.mesh->id != item.mesh->id) continue;
            bool same = true;
            for (const Poses& poses : side_.poses)
                same =
                    same && isSamePlace(poses[static_cast<std::size_t>(one.node)],
                                        poses[static_cast<std::size_t>(item.node)],
                                        boundsOf(*one.mesh), symmetryOf(one), context_.sceneSize);
            if (same) return true;
        }
        return false;
    }

    const SearchContext& context_;
    const Outline& mine_;
    const Matching& matching_;
    Side side_;
    std::vector<Fix> out_;
};

/// At how many places a slip is one misunderstanding rather than several slips.
std::size_t sameFrom(const std::string& code) {
    static const std::set<std::string> kUnderstood{"transform.radians", "transform.order",
                                                   "transform.magnitude", "group.parent"};
    if (code.starts_with("transform.") || code.starts_with("animation."))
        return kUnderstood.count(code) != 0 ? 2 : 3;
    return 2;
}

std::vector<Cause> causesOf(std::vector<Fix> fixes) {
    std::map<std::string, std::size_t> count;
    for (const Fix& fix : fixes) ++count[fix.kind];
    std::map<std::string, std::size_t> placeOf;
    std::vector<Cause> causes;
    for (Fix& fix : fixes) {
        const bool isOne = count[fix.kind] >= sameFrom(fix.code);
        const auto known = placeOf.find(fix.kind);
        if (isOne && known != placeOf.end()) {
            causes[known->second].fixes.push_back(std::move(fix));
            continue;
        }
        if (isOne) placeOf[fix.kind] = causes.size();
        causes.push_back({fix.code, {}});
        causes.back().fixes.push_back(std::move(fix));
    }
    std::stable_sort(causes.begin(), causes.end(), [](const Cause& a, const Cause& b) {
        const auto lineOf = [](const Cause& cause) {
            const int line = cause.fixes.front().where.line;
            return line > 0 ? line : 1'000'000'000;
        };
        return lineOf(a) < lineOf(b);
    });
    return causes;
}

void append(std::vector<Fix>& to, std::vector<Fix> more) {
    to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// Colours that the reader took as 0..1, with a warning: other engines show them nearly black.
void showAsWritten(Outline& outline, const Diagnostics& diagnostics) {
    struct Part {
        const char* name;
        scene::Color scene::Material::*at;
    };
    const Part parts[] = {{"diffuse", &scene::Material::diffuse},
                          {"ambient", &scene::Material::ambient},
                          {"specular", &scene::Material::specular},
                          {"emissive", &scene::Material::emissive}};
    std::set<std::pair<std::size_t, const char*>> scaled;
    bool any = false;
    for (const Diagnostic& one : diagnostics) {
        if (one.id != "scene.color-scale") continue;
        any = true;
        std::size_t holder = outline.items.size();  // the last model that begins before it
        for (std::size_t i = 0; i < outline.items.size(); ++i) {
            const Location& begin = outline.items[i].model.where;
            if (begin.file == one.where.file &&
                std::pair(begin.line, begin.column) <= std::pair(one.where.line, one.where.column))
                holder = i;
        }
        if (holder == outline.items.size()) continue;
        for (const Part& part : parts)
            for (const MessageArgument& argument : one.arguments)
                if (argument.name == "element" && argument.text == part.name)
                    scaled.emplace(holder, part.name);
    }
    if (!any) return;
    for (std::size_t i = 0; i < outline.items.size(); ++i)
        for (const Part& part : parts) {
            // Repeated warnings are cut off; 0..255 gives whole levels.
            scene::Color& color = outline.items[i].material.*part.at;
            const glm::vec3 levels = color.rgb * 255.0F;
            const glm::vec3 off = glm::abs(levels - glm::round(levels));
            const bool isWhole = std::max({off.x, off.y, off.z}) < 0.02F;
            if (!color.cycles && (scaled.count({i, part.name}) != 0 || !isWhole))
                color.rgb /= 255.0F;
        }
}

bool isUnclosed(const Diagnostics& diagnostics) {
    return std::any_of(diagnostics.begin(), diagnostics.end(), [](const Diagnostic& one) {
        return one.severity == Severity::error && one.code == "xml.unclosed";
    });
}

bool faces(const Outline::Item& item, const char* code) {
    return std::any_of(item.mesh->findings.begin(), item.mesh->findings.end(),
                       [&](const Diagnostic& one) { return one.code == code; });
}

}  // namespace

Outline Diagnosis::mendedBut(int cause) const {
    Outline out = submitted;
    out.nextLink = std::max(out.nextLink, 4'000'000);  // beyond the search's own
    // Fixes were found one on the other: places first.
    std::vector<const Fix*> all;
    for (const Fix& fix : harmless) all.push_back(&fix);
    for (std::size_t c = 0; c < causes.size(); ++c)
        if (static_cast<int>(c) != cause)
            for (const Fix& fix : causes[c].fixes) all.push_back(&fix);
    std::stable_sort(all.begin(), all.end(),
                     [](const Fix* a, const Fix* b) { return a->order < b->order; });
    for (const Fix* fix : all) fix->apply(out);
    return out;
}

ReferenceScene::ReferenceScene(std::shared_ptr<const render::Prepared> given,
                               render::MeshLibrary& library)
    : prepared(std::move(given)), outline(outlineOf(*prepared, library)), meshes(prepared->assets) {
    render::Box box;
    const Poses poses = posesOf(outline, 0.0);
    for (const Outline::Item& item : outline.items) {
        const render::Box own = boundsOf(*item.mesh);
        if (own.empty()) continue;
        for (int i = 0; i < 8; ++i)
            box.add(glm::dvec3(poses[static_cast<std::size_t>(item.node)] *
                               glm::dvec4(own.corner(i), 1.0)));
    }
    if (!box.empty()) sceneSize = std::max(1e-9, glm::length(box.max - box.min));
    isLit = !outline.lamps.empty();
}

std::vector<double> comparedTimes(const std::vector<double>& timesS, bool moves) {
    std::vector<double> out = timesS.empty() ? std::vector<double>{0.0} : timesS;
    if (moves) {
        out.push_back(out.back() + 0.83);
        out.push_back(out.front() + 2.9);
    }
    return out;
}

Diagnosis diagnose(ReferenceScene& reference, const render::Prepared& submission,
                   const std::vector<double>& timesS, render::MeshLibrary& library) {
    Diagnosis out;
    out.sceneSize = reference.sceneSize;
    out.submitted = outlineOf(submission, library);
    for (Outline::Item& item : out.submitted.items) item.isReversed = faces(item, "mesh.inward");
    showAsWritten(out.submitted, submission.diagnostics);
    const std::vector<double> times =
        comparedTimes(timesS, reference.prepared->animated || submission.animated);
    const Side theirs = sideOf(reference.outline, times);
    Forms forms(reference.meshes);
    Pictures pictures(*reference.prepared->assets, *submission.assets);
    const SearchContext context{reference.outline,
                                theirs,
                                times,
                                forms,
                                pictures,
                                reference.sceneSize,
                                isUnclosed(submission.diagnostics)};
    const bool isLit = reference.isLit || !out.submitted.lamps.empty();
    Outline mine = out.submitted;
    std::vector<Fix> fixes = explainPlaces(context, mine, out.matching);
    append(fixes, explainDress(context, mine, out.matching, isLit));
    out.harmless = otherDivisions(context, mine, out.matching);
    append(fixes, ExtraFinder(context, mine, out.matching).run());
    append(fixes, explainLights(context, mine));
    append(fixes, explainCamera(context, mine));
    append(fixes, explainSettings(context, mine, isLit));
    append(fixes, explainMissing(reference.outline, out.matching));
    for (std::size_t k = 0; k < fixes.size(); ++k) fixes[k].order = static_cast<int>(k);
    for (Fix& fix : out.harmless) fix.order = static_cast<int>(fixes.size());
    for (std::size_t i = 0; i < out.matching.mineOf.size(); ++i)
        if (out.matching.mineOf[i] < 0) out.missing.push_back(static_cast<int>(i));
    out.causes = causesOf(std::move(fixes));
    return out;
}

}  // namespace farol::grade
