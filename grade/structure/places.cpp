#include "grade/structure/places.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "grade/structure/candidates.h"

namespace farol::grade {
namespace {

constexpr std::size_t kMaxRounds = 60;
constexpr std::size_t kMaxTried = 24;          // items that candidates are made for, a round
constexpr std::size_t kMaxSteps = 40'000'000;  // matrices and corners, in all
constexpr double kEffort = 0.3;                // objects that a likely change must bring

class Search {
  public:
    Search(const SearchContext& context, Outline& mine, Matching& matching)
        : context_(context), mine_(mine), matching_(matching) {
        // Above the reference's and the document's ids, which repairs refer to.
        mine_.nextLink = std::max(mine_.nextLink, 10'000);
    }

    std::vector<Fix> run() {
        for (std::size_t round = 0; round < kMaxRounds && steps_ < kMaxSteps; ++round) {
            look();
            if (wrong() == 0) break;
            if (!takeBest()) break;
        }
        look();
        dropUseless();
        placeRest();
        return std::move(found_);
    }

  private:
    void look() {
        side_ = sideOf(mine_, context_.timesS);
        matching_ = matchItems(context_.theirSide, side_, context_.forms, context_.pictures,
                               context_.sceneSize);
        pairs_.clear();
        for (std::size_t i = 0; i < matching_.mineOf.size(); ++i) {
            if (matching_.mineOf[i] < 0) continue;
            Pair pair;
            pair.theirs = static_cast<int>(i);
            pair.mine = matching_.mineOf[i];
            const auto& theirs = context_.theirs.items[i];
            const auto& mine = mine_.items[static_cast<std::size_t>(pair.mine)];
            const Likeness& form = context_.forms.compare(theirs, mine);
            pair.symmetry = symmetryOf(theirs);
            // Another form may still be at the reference's place.
            pair.mineFromTheirs = form.isOneForm() ? form.mineFromTheirs : glm::dmat4(1.0);
            for (const Poses& poses : context_.theirSide.poses)
                pair.targets.push_back(poses[static_cast<std::size_t>(theirs.node)]);
            // Another size that no transform compensates: its place is right.
            if (pair.mineFromTheirs != glm::dmat4(1.0) && !stands(pair, side_.poses, mine_)) {
                Pair own = pair;
                own.mineFromTheirs = glm::dmat4(1.0);
                if (stands(own, side_.poses, mine_)) pair = own;
            }
            pairs_.push_back(std::move(pair));
        }
        mark(side_.poses, pairs_);
    }

    void mark(const std::vector<Poses>& poses, std::vector<Pair>& pairs) const {
        for (Pair& pair : pairs) pair.isRight = stands(pair, poses, mine_);
    }

    bool stands(const Pair& pair, const std::vector<Poses>& poses, const Outline& outline) const {
        const auto& theirs = context_.theirs.items[static_cast<std::size_t>(pair.theirs)];
        const auto node =
            static_cast<std::size_t>(outline.items[static_cast<std::size_t>(pair.mine)].node);
        for (std::size_t t = 0; t < poses.size(); ++t)
            if (!isSamePlace(pair.targets[t], poses[t][node] * pair.mineFromTheirs,
                             boundsOf(*theirs.mesh), pair.symmetry, context_.sceneSize))
                return false;
        return true;
    }

    std::size_t wrong() const {
        return static_cast<std::size_t>(std::count_if(
            pairs_.begin(), pairs_.end(), [](const Pair& pair) { return !pair.isRight; }));
    }

    /// The number of items that stand wrong once the edits are made.
    std::size_t wrongAfter(const std::vector<Edit>& edits) {
        Outline changed;
        changed.nodes = mine_.nodes;
        changed.items.resize(mine_.items.size());
        for (std::size_t j = 0; j < mine_.items.size(); ++j)
            changed.items[j].node = mine_.items[j].node;
        for (const Edit& edit : edits) applyTo(changed, edit);
        std::vector<Poses> poses;
        for (const double time : context_.timesS) poses.push_back(posesOf(changed, time));
        steps_ += (changed.nodes.size() + 2 * pairs_.size()) * poses.size();
        std::size_t count = 0;
        for (const Pair& pair : pairs_) count += stands(pair, poses, changed) ? 0 : 1;
        return count;
    }

    bool takeBest() {
        const CandidateFinder finder(context_.theirs, mine_, side_.poses, context_.timesS,
                                     context_.sceneSize);
        const std::size_t before = wrong();
        double most = 1e-9;
        std::optional<Candidate> best;
        bool hangsOnly = context_.isUnclosed;  // first: they explain most of such a document
        const auto weigh = [&](const Candidate& candidate) {
            if (steps_ >= kMaxSteps) return;
            const Edit::Kind kind = candidate.edits.front().kind;
            if (hangsOnly && (candidate.edits.size() > 1 ||
                              (kind != Edit::Kind::hang && kind != Edit::Kind::hangItem)))
                return;
            const double gain = static_cast<double>(before) -
                                static_cast<double>(wrongAfter(candidate.edits)) -
                                kEffort * candidate.effort;
            if (gain <= most) return;
            most = gain;
            best = candidate;
        };
        std::size_t tried = 0;
        const auto tryAll = [&] {
            tried = 0;
            for (const Pair& pair : pairs_) {
                if (pair.isRight || tried++ >= kMaxTried) continue;
                steps_ += 2'000;
                for (const Candidate& candidate : finder.find(pair)) weigh(candidate);
            }
        };
        if (hangsOnly) tryAll();
        hangsOnly = false;
        if (!best) tryAll();
        if (!best) {
            tried = 0;
            for (const Pair& pair : pairs_) {
                if (pair.isRight || tried++ >= kMaxTried / 2) continue;
                steps_ += 200'000;
                for (const Candidate& candidate : finder.findTwo(pair)) weigh(candidate);
                if (best) break;
            }
        }
        if (!best) return false;
        for (Edit& edit : best->edits) take(edit);
        return true;
    }

    void take(Edit& edit) {
        for (Link& link : edit.links) link.id = mine_.nextLink++;
        Fix fix;
        fix.code = edit.slip.code;
        fix.words = edit.slip.words();
        fix.kind = edit.slip.code + " " + edit.slip.kind;
        const bool isItem = edit.kind == Edit::Kind::hangItem;
        fix.who = isItem ? nameOfItem(mine_, edit.item) : nameOfNodeAlone(mine_, edit.node);
        fix.where = placeOf(edit);
        fix.apply = [edit](Outline& outline) { applyTo(outline, edit); };
        // It concerns everything below.
        for (const Pair& pair : pairs_)
            if (isItem ? pair.mine == edit.item
                       : mine_.isBelow(mine_.items[static_cast<std::size_t>(pair.mine)].node,
                                       edit.node))
                fix.items.push_back(pair.theirs);
        applyTo(mine_, edit);
        found_.push_back(std::move(fix));
        edits_.push_back(edit);
    }

    Location placeOf(const Edit& edit) const {
        if (edit.kind == Edit::Kind::hangItem)
            return mine_.items[static_cast<std::size_t>(edit.item)].model.where;
        const auto& node = mine_.nodes[static_cast<std::size_t>(edit.node)];
        if (edit.kind == Edit::Kind::hang) return node.where;
        const int at = mine_.placeOf(edit.node, edit.link);
        if (at >= 0) return node.links[static_cast<std::size_t>(at)].where;
        return node.links.empty() ? node.where : node.links.back().where;
    }

    /// Removes edits that later edits made superfluous.
    void dropUseless() {
        const std::size_t now = wrong();
        for (std::size_t k = 0; k < edits_.size() && edits_.size() > 1; ++k) {
            if (edits_[k].kind == Edit::Kind::hangItem && edits_[k].parent < 0) continue;
            Outline tried = original_;
            for (std::size_t other = 0; other < edits_.size(); ++other)
                if (other != k) applyTo(tried, edits_[other]);
            std::vector<Poses> poses;
            for (const double time : context_.timesS) poses.push_back(posesOf(tried, time));
            std::size_t count = 0;
            for (const Pair& pair : pairs_) count += stands(pair, poses, tried) ? 0 : 1;
            if (count > now) continue;
            tried.nextLink = mine_.nextLink;
            mine_ = std::move(tried);
            edits_.erase(edits_.begin() + static_cast<std::ptrdiff_t>(k));
            found_.erase(found_.begin() + static_cast<std::ptrdiff_t>(k));
            k = static_cast<std::size_t>(-1);
            look();
        }
    }

    /// Moves items that nothing explains to their places, by the reference's transforms.
    void placeRest() {
        const CandidateFinder finder(context_.theirs, mine_, side_.poses, context_.timesS,
                                     context_.sceneSize);
        for (const Pair& pair : std::vector<Pair>(pairs_)) {
            if (pair.isRight) continue;
            Candidate whole = finder.replace(pair);
            for (Edit& edit : whole.edits) take(edit);
            found_.back().items = {pair.theirs};
        }
        look();
    }

    const SearchContext& context_;
    Outline& mine_;
    const Outline original_ = mine_;
    Matching& matching_;
    Side side_;
    std::vector<Pair> pairs_;
    std::vector<Fix> found_;
    std::vector<Edit> edits_;
    std::size_t steps_ = 0;
};

}  // namespace

std::vector<Fix> explainPlaces(const SearchContext& context, Outline& mine, Matching& matching) {
    return Search(context, mine, matching).run();
}

}  // namespace farol::grade
