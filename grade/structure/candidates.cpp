#include "grade/structure/candidates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "core/text.h"
#include "grade/structure/alignment.h"
#include "grade/structure/fix.h"
#include "grade/structure/messages.h"
#include "scene/animation.h"

namespace farol::grade {
namespace {

constexpr std::size_t kMaxDepth = 40;  // deeper chains are placed as a whole

bool canInvert(const glm::dmat4& m) {
    const double d = glm::determinant(m);
    return std::isfinite(d) && std::abs(d) > 1e-18;
}

/// Returns the values of common mistakes in one transform.
std::vector<scene::Transform> variantsOf(const scene::Transform& given) {
    std::vector<scene::Transform> out;
    const auto ofVector = [&](const glm::dvec3& v, const auto& made) {
        for (int bits = 1; bits < 8; ++bits) {
            glm::dvec3 other = v;
            bool any = false;
            for (int axis = 0; axis < 3; ++axis)
                if ((bits & (1 << axis)) != 0) {
                    any = any || v[axis] == 0.0;
                    other[axis] = -other[axis];
                }
            if (!any) out.push_back(made(other));
        }
        for (const auto& order : {std::array{1, 0, 2}, {0, 2, 1}, {2, 1, 0}}) {
            const glm::dvec3 other(v[order[0]], v[order[1]], v[order[2]]);
            if (other != v) out.push_back(made(other));
        }
    };
    if (const auto* t = std::get_if<scene::Translate>(&given))
        ofVector(t->offset, [](const glm::dvec3& v) { return scene::Translate{v}; });
    if (const auto* s = std::get_if<scene::Scale>(&given))
        ofVector(s->factors, [](const glm::dvec3& v) { return scene::Scale{v}; });
    if (const auto* r = std::get_if<scene::Rotate>(&given)) {
        out.push_back(scene::Rotate{-r->angleDeg, r->axis});
        if (std::abs(r->angleDeg) < 7.0)
            out.push_back(scene::Rotate{r->angleDeg * 180.0 / std::numbers::pi, r->axis});
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 other(0.0);
            other[axis] = 1.0;
            if (glm::length(glm::cross(other, r->axis)) > 1e-6)
                out.push_back(scene::Rotate{r->angleDeg, other});
        }
    }
    return out;
}

}  // namespace

void applyTo(Outline& outline, const Edit& edit) {
    const auto node = static_cast<std::size_t>(edit.node);
    std::vector<Link>& links = outline.nodes[node].links;
    const int at = outline.placeOf(edit.node, edit.link);
    switch (edit.kind) {
        case Edit::Kind::set:
            if (at >= 0) links[static_cast<std::size_t>(at)].transform = edit.slip.right;
            break;
        case Edit::Kind::remove:
            if (at >= 0) links.erase(links.begin() + at);
            break;
        case Edit::Kind::insert:
            links.insert(at >= 0 ? links.begin() + at : links.end(), edit.links.begin(),
                         edit.links.end());
            break;
        case Edit::Kind::order: {
            // Links that other edits took or added keep their neighbours.
            std::vector<std::size_t> places;
            std::vector<Link> ordered;
            for (const int id : edit.order)
                if (const int place = outline.placeOf(edit.node, id); place >= 0) {
                    places.push_back(static_cast<std::size_t>(place));
                    ordered.push_back(links[static_cast<std::size_t>(place)]);
                }
            std::sort(places.begin(), places.end());
            for (std::size_t i = 0; i < places.size(); ++i) links[places[i]] = ordered[i];
            break;
        }
        case Edit::Kind::hang:
            if (!outline.isBelow(edit.parent, edit.node)) outline.nodes[node].parent = edit.parent;
            break;
        case Edit::Kind::hangItem:
            if (edit.parent < 0) {  // to a new group
                Outline::Node alone;
                alone.parent = 0;
                alone.links = edit.links;
                outline.items[static_cast<std::size_t>(edit.item)].node =
                    static_cast<int>(outline.nodes.size());
                outline.nodes.push_back(std::move(alone));
                break;
            }
            outline.items[static_cast<std::size_t>(edit.item)].node = edit.parent;
            break;
        case Edit::Kind::place:
            links = edit.links;
            break;
    }
}

std::vector<CandidateFinder::Step> CandidateFinder::stepsOf(int node) const {
    std::vector<Step> steps;
    for (const int one : mine_.pathTo(node))
        for (const Link& link : mine_.nodes[static_cast<std::size_t>(one)].links)
            steps.push_back({one, &link});
    return steps;
}

CandidateFinder::Matrices CandidateFinder::productOf(const std::vector<Step>& steps,
                                                     std::size_t from, std::size_t to) const {
    Matrices out(timesS_.size(), glm::dmat4(1.0));
    for (std::size_t t = 0; t < out.size(); ++t)
        for (std::size_t i = from; i < to; ++i)
            out[t] = out[t] * scene::matrixAt(steps[i].link->transform, timesS_[t]);
    return out;
}

bool CandidateFinder::reaches(const Pair& pair, const Matrices& world) const {
    const render::Box bounds = boundsOf(*theirs_.items[static_cast<std::size_t>(pair.theirs)].mesh);
    for (std::size_t t = 0; t < world.size(); ++t)
        if (!isSamePlace(pair.targets[t], world[t] * pair.mineFromTheirs, bounds, pair.symmetry,
                         size_))
            return false;
    return true;
}

/// Applies edits to the nodes on the item's way alone.
bool CandidateFinder::reachesBy(const Pair& pair, const std::vector<Edit>& edits) const {
    Outline part;
    std::map<int, int> index;
    const auto& item = mine_.items[static_cast<std::size_t>(pair.mine)];
    for (const int node : mine_.pathTo(item.node)) {
        index[node] = static_cast<int>(part.nodes.size());
        Outline::Node copy;
        copy.parent = static_cast<int>(part.nodes.size()) - 1;
        copy.links = mine_.nodes[static_cast<std::size_t>(node)].links;
        part.nodes.push_back(std::move(copy));
    }
    for (Edit edit : edits) {
        const auto found = index.find(edit.node);
        if (found == index.end()) continue;
        edit.node = found->second;
        applyTo(part, edit);
    }
    Matrices world(timesS_.size(), glm::dmat4(1.0));
    for (std::size_t t = 0; t < world.size(); ++t)
        for (const Outline::Node& node : part.nodes)
            world[t] = world[t] * matrixOf(node.links, timesS_[t]);
    return reaches(pair, world);
}

/// Returns the target matrices of the item's node, with its orientation where symmetry allows it.
std::vector<glm::dmat4> CandidateFinder::goalOf(const Pair& pair, const Matrices& world) const {
    std::vector<glm::dmat4> out;
    const glm::dmat4 theirsFromMine = glm::inverse(pair.mineFromTheirs);
    for (std::size_t t = 0; t < pair.targets.size(); ++t)
        out.push_back(alignedTo(pair.targets[t], world[t] * pair.mineFromTheirs, pair.symmetry) *
                      theirsFromMine);
    return out;
}

bool CandidateFinder::isWritten(const Pair& pair, const scene::Transform& transform) const {
    const int node = theirs_.items[static_cast<std::size_t>(pair.theirs)].node;
    for (const Link* link : chainOf(theirs_, node))
        if (isSameTransform(link->transform, transform)) return true;
    return false;
}

std::vector<Candidate> CandidateFinder::find(const Pair& pair) const {
    std::vector<Candidate> out;
    const auto& item = mine_.items[static_cast<std::size_t>(pair.mine)];
    if (stepsOf(item.node).size() > kMaxDepth) return out;
    addAlignment(pair, out);
    addNumbers(pair, out);
    addInsertions(pair, out);
    addOrders(pair, out);
    addParents(pair, out);
    addPlaces(pair, out);
    return out;
}

void CandidateFinder::addNumbers(const Pair& pair, std::vector<Candidate>& out) const {
    const int node = mine_.items[static_cast<std::size_t>(pair.mine)].node;
    const std::vector<Step> steps = stepsOf(node);
    const Matrices world = productOf(steps, 0, steps.size());
    const std::vector<glm::dmat4> goal = goalOf(pair, world);
    for (std::size_t k = 0; k < steps.size(); ++k) {
        const Matrices before = productOf(steps, 0, k),
                       after = productOf(steps, k + 1, steps.size());
        const scene::Transform& mine = steps[k].link->transform;
        Edit edit;
        edit.node = steps[k].node;
        edit.link = steps[k].link->id;
        // Left out.
        Matrices without(world.size());
        for (std::size_t t = 0; t < world.size(); ++t) without[t] = before[t] * after[t];
        if (reaches(pair, without)) {
            edit.kind = Edit::Kind::remove;
            edit.slip = slipOfExtra(mine, 1.15);
            out.push_back({{edit}, edit.slip.effort});
        }
        edit.kind = Edit::Kind::set;
        if (!canInvert(before[0]) || !canInvert(after[0])) continue;
        const glm::dmat4 needed = glm::inverse(before[0]) * goal[0] * glm::inverse(after[0]);
        for (const std::size_t kind : {std::size_t{0}, std::size_t{2}, std::size_t{4}}) {
            const auto value = asTransform(needed, kind);
            if (!value || isSameTransform(mine, *value)) continue;
            if (kind != mine.index() && !isWritten(pair, *value)) continue;
            edit.slip = slipBetween(mine, *value, false);
            if (isWritten(pair, edit.slip.right)) edit.slip.effort -= 0.3;
            if (reachesBy(pair, {edit})) {
                out.push_back({{edit}, edit.slip.effort});
                continue;
            }
            edit.slip.right = *value;  // its estimate was not exact enough
            if (reachesBy(pair, {edit})) out.push_back({{edit}, edit.slip.effort + 0.2});
        }
    }
}

Edit CandidateFinder::insertion(const std::vector<Step>& steps, std::size_t at, int node,
                                const scene::Transform& transform) const {
    Edit edit;
    edit.kind = Edit::Kind::insert;
    edit.node = node;
    for (std::size_t k = at; k < steps.size() && edit.link == 0; ++k)
        if (steps[k].node == node) edit.link = steps[k].link->id;
    Link link;
    link.transform = transform;
    link.id = 1'000'000 + static_cast<int>(100 * at) + node;  // beyond those of documents
    edit.links = {link};
    edit.slip = slipOfMissing(transform, 1.3);
    return edit;
}

void CandidateFinder::addInsertions(const Pair& pair, std::vector<Candidate>& out) const {
    const int own = mine_.items[static_cast<std::size_t>(pair.mine)].node;
    const std::vector<int> path = mine_.pathTo(own);
    const std::vector<Step> steps = stepsOf(own);
    const Matrices world = productOf(steps, 0, steps.size());
    const std::vector<glm::dmat4> goal = goalOf(pair, world);
    for (std::size_t k = 0; k <= steps.size(); ++k) {
        const Matrices before = productOf(steps, 0, k), after = productOf(steps, k, steps.size());
        if (!canInvert(before[0]) || !canInvert(after[0])) continue;
        const glm::dmat4 needed = glm::inverse(before[0]) * goal[0] * glm::inverse(after[0]);
        for (const std::size_t kind : {std::size_t{0}, std::size_t{2}, std::size_t{4}}) {
            const auto value = asTransform(needed, kind);
            if (!value) continue;
            const bool isKnown = isWritten(pair, *value);
            // It may belong to each of the groups that meet here; node 0 is the whole scene.
            for (const int node : path) {
                const bool endsBefore = std::all_of(
                    steps.begin() + static_cast<std::ptrdiff_t>(k), steps.end(),
                    [&](const Step& s) { return s.node == node || !mine_.isBelow(node, s.node); });
                const bool startsAfter = std::all_of(
                    steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(k),
                    [&](const Step& s) { return s.node == node || mine_.isBelow(node, s.node); });
                if (!endsBefore || !startsAfter) continue;
                Edit edit = insertion(steps, k, node, *value);
                if (isKnown) edit.slip.effort -= 0.3;
                if (node == 0) edit.slip = slipOfWhole(*value);
                if (reachesBy(pair, {edit})) out.push_back({{edit}, edit.slip.effort});
            }
        }
    }
}

void CandidateFinder::addOrders(const Pair& pair, std::vector<Candidate>& out) const {
    for (const int node : mine_.pathTo(mine_.items[static_cast<std::size_t>(pair.mine)].node)) {
        const std::vector<Link>& links = mine_.nodes[static_cast<std::size_t>(node)].links;
        if (links.size() < 2 || links.size() > 5) continue;
        std::vector<std::size_t> order(links.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        while (std::next_permutation(order.begin(), order.end())) {
            Edit edit;
            edit.kind = Edit::Kind::order;
            edit.node = node;
            std::vector<std::size_t> moved;
            for (std::size_t i = 0; i < order.size(); ++i) {
                edit.order.push_back(links[order[i]].id);
                if (order[i] != i) moved.push_back(i);
            }
            edit.link = links[moved.front()].id;
            if (moved.size() == 2)
                edit.slip = slipOfOrder(links[moved.front()].transform,
                                        links[moved.back()].transform, 0.95);
            else
                edit.slip = {"transform.order",
                             []() -> CauseWords {
                                 return {causeMessage<"part.finding/order">(), {}};
                             },
                             "order",
                             1.1,
                             {}};
            if (reachesBy(pair, {edit})) out.push_back({{edit}, edit.slip.effort});
        }
    }
}

void CandidateFinder::addParents(const Pair& pair, std::vector<Candidate>& out) const {
    const auto& item = mine_.items[static_cast<std::size_t>(pair.mine)];
    const std::vector<int> path = mine_.pathTo(item.node);
    const std::size_t times = timesS_.size();
    for (std::size_t p = 1; p <= path.size(); ++p) {
        // Moves path[p] and its descendants to another parent; p == size: the item alone.
        const bool isItem = p == path.size();
        const int moved = isItem ? -1 : path[p];
        Matrices below(times, glm::dmat4(1.0));
        for (std::size_t t = 0; t < times; ++t)
            for (std::size_t q = p; q < path.size(); ++q)
                below[t] = below[t] * matrixOf(mine_.nodes[static_cast<std::size_t>(path[q])].links,
                                               timesS_[t]);
        for (std::size_t h = 0; h < mine_.nodes.size(); ++h) {
            const int parent = static_cast<int>(h);
            if (mine_.nodes[h].isGone || parent == path[p - 1] ||
                (!isItem && mine_.isBelow(parent, moved)))
                continue;
            Matrices world(times);
            for (std::size_t t = 0; t < times; ++t) world[t] = poses_[t][h] * below[t];
            if (!reaches(pair, world)) continue;
            Edit edit;
            edit.kind = isItem ? Edit::Kind::hangItem : Edit::Kind::hang;
            edit.node = isItem ? item.node : moved;
            edit.item = pair.mine;
            edit.parent = parent;
            edit.slip = {"group.parent",
                         [from = nameOfNode(mine_, path[p - 1]),
                          to = nameOfNode(mine_, parent)]() -> CauseWords {
                             return {causeMessage<"part.finding/parent">("value"_arg = from,
                                                                         "expected"_arg = to),
                                     {}};
                         },
                         "parent " + std::to_string(path[p - 1]) + " " + std::to_string(parent),
                         isItem ? 1.15 : 1.05,
                         {}};
            out.push_back({{edit}, edit.slip.effort});
        }
    }
}

void CandidateFinder::addPlaces(const Pair& pair, std::vector<Candidate>& out) const {
    const auto& item = mine_.items[static_cast<std::size_t>(pair.mine)];
    const std::vector<int> path = mine_.pathTo(item.node);
    const Matrices world = productOf(stepsOf(item.node), 0, stepsOf(item.node).size());
    const std::vector<glm::dmat4> goal = goalOf(pair, world);
    for (std::size_t p = 0; p < path.size(); ++p) {
        glm::dmat4 above(1.0), below(1.0);
        for (std::size_t q = 0; q < path.size(); ++q) {
            const glm::dmat4 local =
                matrixOf(mine_.nodes[static_cast<std::size_t>(path[q])].links, timesS_[0]);
            if (q < p) above = above * local;
            if (q > p) below = below * local;
        }
        if (!canInvert(above) || !canInvert(below)) continue;
        const auto parts = decomposed(glm::inverse(above) * goal[0] * glm::inverse(below));
        if (!parts) continue;
        Edit edit;
        edit.kind = Edit::Kind::place;
        edit.node = path[p];
        const auto& links = mine_.nodes[static_cast<std::size_t>(path[p])].links;
        for (const scene::Transform& part : *parts) {
            Link link;
            link.transform = part;
            link.id = 2'000'000 + 10 * path[p] + static_cast<int>(edit.links.size());
            if (!links.empty()) link.where = links.front().where;
            edit.links.push_back(link);
        }
        edit.slip = slipOfPlace(path[p] == 0, *parts, path[p] == 0 ? 1.5 : 2.3);
        if (reachesBy(pair, {edit})) out.push_back({{edit}, edit.slip.effort});
    }
}

void CandidateFinder::addAlignment(const Pair& pair, std::vector<Candidate>& out) const {
    std::vector<Edit> edits = alignChains(theirs_, pair.theirs, mine_, pair.mine);
    constexpr std::size_t kMaxEdits = 8;
    if (edits.empty() || edits.size() > kMaxEdits || !reachesBy(pair, edits)) return;
    // Of the differing edits, the cheapest subset that reaches the target.
    const std::size_t all = std::size_t{1} << edits.size();
    double least = 1e9;
    std::vector<Edit> best;
    for (std::size_t bits = 1; bits < all; ++bits) {
        std::vector<Edit> some;
        double effort = 0.0;
        for (std::size_t i = 0; i < edits.size(); ++i)
            if ((bits & (std::size_t{1} << i)) != 0) {
                some.push_back(edits[i]);
                effort += edits[i].slip.effort;
            }
        if (effort >= least || !reachesBy(pair, some)) continue;
        least = effort;
        best = some;
    }
    if (!best.empty()) out.push_back({best, least});
}

std::vector<Candidate> CandidateFinder::findTwo(const Pair& pair) const {
    std::vector<Candidate> out;
    const int own = mine_.items[static_cast<std::size_t>(pair.mine)].node;
    const std::vector<Step> steps = stepsOf(own);
    constexpr std::size_t kMaxOfTwo = 14;
    if (steps.size() > kMaxOfTwo) return out;
    const Matrices world = productOf(steps, 0, steps.size());
    const std::vector<glm::dmat4> goal = goalOf(pair, world);
    for (std::size_t first = 0; first < steps.size(); ++first)
        for (const scene::Transform& other : variantsOf(steps[first].link->transform)) {
            Link changed = *steps[first].link;
            changed.transform = other;
            std::vector<Step> altered = steps;
            altered[first].link = &changed;
            for (std::size_t k = 0; k < steps.size(); ++k) {
                if (k == first) continue;
                const Matrices before = productOf(altered, 0, k),
                               after = productOf(altered, k + 1, altered.size());
                if (!canInvert(before[0]) || !canInvert(after[0])) continue;
                const scene::Transform& mine = steps[k].link->transform;
                const auto value = asTransform(
                    glm::inverse(before[0]) * goal[0] * glm::inverse(after[0]), mine.index());
                if (!value) continue;
                Edit one, two;
                one.node = steps[first].node;
                one.link = steps[first].link->id;
                one.slip = slipBetween(steps[first].link->transform, other, false);
                two.node = steps[k].node;
                two.link = steps[k].link->id;
                two.slip = slipBetween(mine, *value, false);
                for (Edit* edit : {&one, &two})
                    if (isWritten(pair, edit->slip.right)) edit->slip.effort -= 0.3;
                if (reachesBy(pair, {one, two}))
                    out.push_back({{one, two}, one.slip.effort + two.slip.effort});
            }
        }
    return out;
}

Candidate CandidateFinder::replace(const Pair& pair) const {
    Candidate out;
    const auto& theirs = theirs_.items[static_cast<std::size_t>(pair.theirs)];
    const auto& item = mine_.items[static_cast<std::size_t>(pair.mine)];
    // The item leaves its group: a group of the reference's transforms stands in the world.
    Edit edit;
    edit.kind = Edit::Kind::hangItem;
    edit.node = item.node;
    edit.item = pair.mine;
    edit.parent = -1;
    for (const Link* link : chainOf(theirs_, theirs.node)) edit.links.push_back(*link);
    for (Link& link : edit.links) link.id += 3'000'000;
    edit.slip = slipOfPlace(false, {}, 2.6);
    out.edits = {edit};
    out.effort = edit.slip.effort;
    return out;
}

}  // namespace farol::grade
