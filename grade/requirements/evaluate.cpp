#include "grade/requirements/evaluate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/text.h"
#include "grade/requirements/lights.h"
#include "grade/requirements/mesh_files.h"
#include "grade/requirements/messages.h"
#include "grade/requirements/select.h"
#include "grade/rubric/excerpt.h"
#include "grade/rubric/views.h"
#include "render/plan/camera.h"
#include "render/plan/instances.h"
#include "render/plan/plan.h"

namespace farol::grade {
namespace {

constexpr std::size_t kShownMisses = 6;

/// Counted matches, and why the others do not count.
struct Counted {
    std::vector<RequiredThing> matches, misses;
    int found = 0;
};

std::vector<Shot> shotsOf(const Rubric& rubric, const render::Prepared& prepared,
                          render::MeshLibrary& meshes) {
    const std::vector<double> timesS = chooseTimes(rubric, prepared.scene);
    const render::InstanceList list =
        render::collect(prepared.scene, timesS.front(), false, *prepared.assets, meshes);
    std::vector<Shot> all = planShots(rubric, prepared.scene, list.bounds, timesS, false);
    std::vector<Shot> own;
    for (const Shot& shot : all)
        if (shot.own) own.push_back(shot);
    return own.empty() ? all : own;
}

std::vector<glm::dvec3> eyesOf(const render::Prepared& prepared, const std::vector<double>& timesS,
                               render::MeshLibrary& meshes) {
    std::vector<glm::dvec3> eyes;
    for (const double timeS : timesS) {
        const render::InstanceList list =
            render::collect(prepared.scene, timeS, false, *prepared.assets, meshes);
        eyes.push_back(render::chooseCamera(prepared.scene, {}, list.bounds, 1.0).eye);
    }
    return eyes;
}

/// The places, in a sequence, of its longest part that does not fall.
std::vector<bool> longestRising(const std::vector<double>& values) {
    const std::size_t count = values.size();
    std::vector<std::size_t> length(count, 1), before(count, count);
    std::size_t best = count;
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = 0; j < i; ++j)
            if (values[j] <= values[i] * (1.0 + 1e-6) + 1e-9 && length[j] + 1 > length[i]) {
                length[i] = length[j] + 1;
                before[i] = j;
            }
        if (best == count || length[i] > length[best]) best = i;
    }
    std::vector<bool> isIn(count, false);
    for (std::size_t i = best; i < count; i = before[i]) isIn[i] = true;
    return isIn;
}

}  // namespace

struct Requirements::State {
    State(const Rubric& rubric, render::Renderer& renderer, render::MeshLibrary& meshes,
          std::shared_ptr<const render::Prepared> of, const render::Job& job)
        : rules(rubric),
          prepared(std::move(of)),
          document(job.xml),
          name(job.name),
          inventory(*prepared, meshes),
          motion(inventory),
          seen(renderer, prepared, inventory, shotsOf(rubric, *prepared, meshes)),
          solids(inventory, seen.timesS(), eyesOf(*prepared, seen.timesS(), meshes)),
          selector({inventory, motion, solids, seen}) {}

    RequiredThing thingAt(Message who, const Location& where, Message reason) const {
        const bool isHere = where.line > 0 && where.file == name;
        return {std::move(who), where, isHere ? excerptOf(document, where.line) : "",
                std::move(reason)};
    }
    RequiredThing thing(std::size_t object) const {
        return thingAt(inventory.nameOf(object), inventory.objects()[object].model->where, {});
    }
    RequiredThing miss(const NearMiss& near) const {
        return thingAt(inventory.nameOf(near.object), near.fault.where, near.fault.reason);
    }

    /// Objects of the wrong kind are not shown beside one of the right kind; those that meet an
    /// earlier requirement come last, since they are meant for that.
    std::vector<RequiredThing> missesOf(std::vector<NearMiss> near) const {
        std::stable_sort(near.begin(), near.end(), [&](const NearMiss& a, const NearMiss& b) {
            return std::pair(!a.isOfKind, used.count(a.object)) <
                   std::pair(!b.isOfKind, used.count(b.object));
        });
        std::vector<RequiredThing> out;
        const bool hasKind = !near.empty() && near.front().isOfKind;
        for (const NearMiss& one : near)
            if (out.size() < kShownMisses && (one.isOfKind || !hasKind)) out.push_back(miss(one));
        return out;
    }

    double valueOf(OrderKey key, std::size_t object, const Selector& select) {
        switch (key) {
            case OrderKey::document:
                return static_cast<double>(object);
            case OrderKey::radius:
                return inventory.radius(object, seen.timesS().front());
            case OrderKey::depth:
                return inventory.nodes()[static_cast<std::size_t>(inventory.objects()[object].node)]
                    .depth;
            case OrderKey::orbit:
            case OrderKey::period:
                break;
        }
        const Orbit orbit = selector.orbitAbout(object, select.turnsAbout).value_or(Orbit{});
        return key == OrderKey::orbit ? orbit.radius : orbit.periodS;
    }

    /// Takes out what is out of order.
    void keepOrdered(const Order& order, const Selector& select, std::vector<std::size_t>& matches,
                     std::vector<RequiredThing>& misses) {
        std::stable_sort(matches.begin(), matches.end(), [&](std::size_t a, std::size_t b) {
            return valueOf(order.by, a, select) < valueOf(order.by, b, select);
        });
        std::vector<double> values;
        for (const std::size_t object : matches)
            values.push_back(valueOf(order.rising, object, select));
        const std::vector<bool> isIn = longestRising(values);
        std::vector<std::size_t> kept;
        double before = 0.0;
        for (std::size_t i = 0; i < matches.size(); ++i) {
            if (isIn[i]) {
                kept.push_back(matches[i]);
                before = values[i];
                continue;
            }
            RequiredThing miss = thing(matches[i]);
            miss.reason = requirementMessage<"part.miss/order">(
                "rising"_arg = kOrderWords[order.rising], "value"_arg = shortNumber(values[i]),
                "before"_arg = shortNumber(before));
            misses.push_back(std::move(miss));
        }
        matches = std::move(kept);
    }

    /// Takes out what has an equal image or mesh before it.
    void keepDistinct(Distinct distinct, std::vector<std::size_t>& matches,
                      std::vector<RequiredThing>& misses) {
        if (distinct == Distinct::objects) return;
        const bool isImage = distinct == Distinct::textures;
        std::map<std::string, std::size_t> first;
        std::vector<std::size_t> kept;
        for (const std::size_t object : matches) {
            const std::string key = isImage ? inventory.imageOf(object)
                                            : std::to_string(inventory.objects()[object].mesh->id);
            const auto [known, isNew] = first.emplace(key, object);
            if (isNew) {
                kept.push_back(object);
                continue;
            }
            RequiredThing miss = thing(object);
            const auto who = "who"_arg = inventory.nameOf(known->second);
            miss.reason = isImage ? requirementMessage<"part.miss/equal-image">(who)
                                  : requirementMessage<"part.miss/equal-mesh">(who);
            misses.push_back(std::move(miss));
        }
        matches = std::move(kept);
    }

    Counted countObjects(const Requirement& rule) {
        Selection selection = selector.select(*rule.select, rule.each);
        selector.define(rule.id, selection.matches);
        Counted out;
        out.misses = missesOf(selection.near);
        used.insert(selection.matches.begin(), selection.matches.end());
        keepDistinct(rule.distinct, selection.matches, out.misses);
        if (rule.order) keepOrdered(*rule.order, *rule.select, selection.matches, out.misses);
        out.found = static_cast<int>(selection.matches.size());
        for (std::size_t i = 0; i < std::min(kShownThings, selection.matches.size()); ++i)
            out.matches.push_back(thing(selection.matches[i]));
        return out;
    }

    Counted countLights(const Requirement& rule) {
        Counted out;
        for (const FoundLight& light : findLights(*rule.light, selector)) {
            if (light.reason.empty()) ++out.found;
            std::vector<RequiredThing>& list = light.reason.empty() ? out.matches : out.misses;
            if (list.size() < (light.reason.empty() ? kShownThings : kShownMisses))
                list.push_back(thingAt(light.who, light.where, light.reason));
        }
        return out;
    }

    void define() {
        for (const Definition& one : rules.definitions)
            selector.define(one.id, selector.select(one.select, "").matches);
    }

    RequirementGrade judge(const Requirement& rule) {
        Counted counted;
        if (rule.select) counted = countObjects(rule);
        if (rule.light) counted = countLights(rule);
        if (rule.mesh)
            counted.found =
                countFiles(*rule.mesh, inventory.assets(), counted.matches, counted.misses);
        RequirementGrade out =
            gradeOf(rule, counted.found, static_cast<int>(selector.objectsOf(rule.each).size()));
        out.matches = std::move(counted.matches);
        if (out.met != Met::yes) out.misses = std::move(counted.misses);
        return out;
    }

    ExplainedObject explained(std::size_t object, const Selector& select) {
        ExplainedObject out;
        out.thing = thing(object);
        out.shape = inventory.shapeOf(object);
        if (!inventory.imageOf(object).empty())
            out.image = inventory.objects()[object].model->texture->path;
        out.depth =
            inventory.nodes()[static_cast<std::size_t>(inventory.objects()[object].node)].depth;
        out.radius = inventory.radius(object, seen.timesS().front());
        out.moves = motion.moves(object);
        out.pixels = seen.pixelsOf(object);
        if (!select.turnsAbout.empty())
            if (const auto orbit = selector.orbitAbout(object, select.turnsAbout)) {
                out.orbitRadius = orbit->radius;
                out.periodS = orbit->periodS;
            }
        return out;
    }

    ExplainedSelector explain(const std::string& id, const Selector& select,
                              const std::string& among) {
        const Selection selection = selector.select(select, among);
        selector.define(id, selection.matches);
        ExplainedSelector out;
        out.id = id;
        out.count = selection.matches.size();
        for (std::size_t i = 0; i < std::min(kShownThings, selection.matches.size()); ++i)
            out.objects.push_back(explained(selection.matches[i], select));
        out.misses = missesOf(selection.near);
        return out;
    }

    const Rubric& rules;
    std::shared_ptr<const render::Prepared> prepared;
    std::string document, name;
    Inventory inventory;
    Motion motion;
    SeenFacts seen;
    Solids solids;
    ObjectSelector selector;
    std::set<std::size_t> used;  ///< objects that meet a requirement
};

RequirementGrade gradeOf(const Requirement& rule, int found, int base) {
    RequirementGrade out;
    out.id = rule.id;
    out.text = rule.text;
    out.most = rule.points;
    out.found = found;
    out.needed = rule.each.empty() ? rule.count : base;
    const bool hasTooMany = rule.each.empty() && rule.atMost && found > *rule.atMost;
    double share = out.needed > 0 ? std::min(1.0, static_cast<double>(found) / out.needed) : 0.0;
    if (hasTooMany) share *= static_cast<double>(*rule.atMost) / found;
    const bool isMet = share >= 1.0;
    out.met = isMet ? Met::yes : rule.partial && share > 0.0 ? Met::partly : Met::no;
    if (out.met != Met::no) out.points = std::round(100.0 * rule.points * share) / 100.0;
    const auto count = "count"_arg = found;
    const auto needed = "needed"_arg = out.needed;
    if (out.needed == 0)
        out.reason = requirementMessage<"part.unmet/each-none">("id"_arg = rule.each);
    else if (hasTooMany)
        out.reason = requirementMessage<"part.unmet/many">(count, "most"_arg = *rule.atMost);
    else if (!rule.each.empty())
        out.reason = requirementMessage<"part.met/each">(count, needed);
    else if (isMet)
        out.reason = requirementMessage<"part.met/all">(count);
    else if (found == 0)
        out.reason = requirementMessage<"part.unmet/none">();
    else
        out.reason = requirementMessage<"part.unmet/some">(count, needed);
    return out;
}

Requirements::Requirements(const Rubric& rubric, render::Renderer& renderer,
                           render::MeshLibrary& meshes,
                           std::shared_ptr<const render::Prepared> prepared, const render::Job& job)
    : state_(std::make_unique<State>(rubric, renderer, meshes, std::move(prepared), job)) {}
Requirements::~Requirements() = default;

std::vector<RequirementGrade> Requirements::grade() {
    state_->define();
    std::vector<RequirementGrade> out;
    for (const Requirement& rule : state_->rules.requirements) out.push_back(state_->judge(rule));
    return out;
}

std::vector<ExplainedSelector> Requirements::explain() {
    std::vector<ExplainedSelector> out;
    for (const Definition& one : state_->rules.definitions) {
        out.push_back(state_->explain(one.id, one.select, ""));
        out.back().isDefinition = true;
    }
    for (const Requirement& rule : state_->rules.requirements)
        if (rule.select) out.push_back(state_->explain(rule.id, *rule.select, rule.each));
    return out;
}

const std::vector<double>& Requirements::timesS() const { return state_->seen.timesS(); }

std::vector<RequirementGrade> gradeFiles(const Rubric& rubric, const scene::Assets& files) {
    std::vector<RequirementGrade> out;
    for (const Requirement& rule : rubric.requirements) {
        std::vector<RequiredThing> matches, misses;
        const int found = rule.mesh ? countFiles(*rule.mesh, files, matches, misses) : 0;
        out.push_back(gradeOf(rule, found, 0));
        out.back().matches = std::move(matches);
        if (out.back().met != Met::yes) out.back().misses = std::move(misses);
    }
    return out;
}

}  // namespace farol::grade
