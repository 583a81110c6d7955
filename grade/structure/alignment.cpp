#include "grade/structure/alignment.h"

#include <algorithm>
#include <map>

namespace farol::grade {
namespace {

constexpr std::size_t kMaxLinks = 32;

struct At {
    int node;
    const Link* link;
};

std::vector<At> chainAt(const Outline& outline, int item) {
    std::vector<At> chain;
    const int node = outline.items[static_cast<std::size_t>(item)].node;
    for (const int one : outline.pathTo(node))
        for (const Link& link : outline.nodes[static_cast<std::size_t>(one)].links)
            chain.push_back({one, &link});
    return chain;
}

enum class Move { keep, set, remove, insert, exchange };

class Aligner {
  public:
    Aligner(const Outline& theirs, int theirItem, const Outline& mine, int myItem)
        : theirs_(theirs),
          mine_(mine),
          goal_(chainAt(theirs, theirItem)),
          own_(chainAt(mine, myItem)) {
        const int theirNode = theirs.items[static_cast<std::size_t>(theirItem)].node;
        const int myNode = mine.items[static_cast<std::size_t>(myItem)].node;
        // Groups correspond from the item upwards, unless their links differ.
        const std::vector<int> a = theirs.pathTo(theirNode), b = mine.pathTo(myNode);
        for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
            nodes_[a[a.size() - 1 - i]] = b[b.size() - 1 - i];
        last_ = myNode;
    }

    std::vector<Edit> run() {
        if (goal_.size() > kMaxLinks || own_.size() > kMaxLinks) return {};
        fill();
        return trace();
    }

  private:
    double distance(std::size_t i, std::size_t j) const {
        const scene::Transform &a = goal_[i].link->transform, &b = own_[j].link->transform;
        if (isSameTransform(a, b)) return 0.0;
        return a.index() == b.index() ? 0.8 : 1.7;
    }

    bool isExchange(std::size_t i, std::size_t j) const {
        return own_[j - 1].node == own_[j].node &&
               isSameTransform(goal_[i - 1].link->transform, own_[j].link->transform) &&
               isSameTransform(goal_[i].link->transform, own_[j - 1].link->transform);
    }

    void fill() {
        const std::size_t rows = goal_.size() + 1, columns = own_.size() + 1;
        costs_.assign(rows, std::vector<double>(columns, 0.0));
        moves_.assign(rows, std::vector<Move>(columns, Move::keep));
        for (std::size_t i = 0; i < rows; ++i)
            for (std::size_t j = 0; j < columns; ++j) {
                if (i == 0 && j == 0) continue;
                double least = 1e18;
                const auto take = [&](double cost, Move move) {
                    if (cost >= least) return;
                    least = cost;
                    moves_[i][j] = move;
                };
                if (i > 0 && j > 0) {
                    const double apart = distance(i - 1, j - 1);
                    take(costs_[i - 1][j - 1] + apart, apart == 0.0 ? Move::keep : Move::set);
                }
                if (i > 1 && j > 1 && isExchange(i - 1, j - 1))
                    take(costs_[i - 2][j - 2] + 0.95, Move::exchange);
                if (i > 0) take(costs_[i - 1][j] + 1.05, Move::insert);
                if (j > 0) take(costs_[i][j - 1] + 1.0, Move::remove);
                costs_[i][j] = least;
            }
    }

    std::vector<Edit> trace() {
        std::vector<Edit> out;
        std::vector<std::pair<std::size_t, std::size_t>> inserted;
        std::size_t i = goal_.size(), j = own_.size();
        while (i > 0 || j > 0) switch (moves_[i][j]) {
                case Move::keep:
                    nodes_[goal_[--i].node] = own_[--j].node;
                    break;
                case Move::set: {
                    --i;
                    --j;
                    Edit edit;
                    edit.node = own_[j].node;
                    edit.link = own_[j].link->id;
                    edit.slip =
                        slipBetween(own_[j].link->transform, goal_[i].link->transform, true);
                    out.push_back(edit);
                    break;
                }
                case Move::exchange: {
                    i -= 2;
                    j -= 2;
                    Edit edit;
                    edit.kind = Edit::Kind::order;
                    edit.node = own_[j].node;
                    for (const Link& link : mine_.nodes[static_cast<std::size_t>(edit.node)].links)
                        edit.order.push_back(link.id);
                    const auto at =
                        std::find(edit.order.begin(), edit.order.end(), own_[j].link->id);
                    std::swap(*at, *(at + 1));
                    edit.link = own_[j].link->id;
                    edit.slip =
                        slipOfOrder(own_[j].link->transform, own_[j + 1].link->transform, 0.9);
                    out.push_back(edit);
                    break;
                }
                case Move::insert:
                    inserted.emplace_back(--i, j);
                    break;
                case Move::remove: {
                    --j;
                    Edit edit;
                    edit.kind = Edit::Kind::remove;
                    edit.node = own_[j].node;
                    edit.link = own_[j].link->id;
                    edit.slip = slipOfExtra(own_[j].link->transform, 1.1);
                    out.push_back(edit);
                    break;
                }
            }
        for (const auto& [goal, place] : inserted) out.push_back(insertion(goal, place));
        std::reverse(out.begin(), out.end());
        return out;
    }

    Edit insertion(std::size_t goal, std::size_t place) const {
        const scene::Transform& wanted = goal_[goal].link->transform;
        Edit edit;
        edit.kind = Edit::Kind::insert;
        edit.node = nodeFor(goal_[goal].node, place);
        for (std::size_t k = place; k < own_.size() && edit.link == 0; ++k)
            if (own_[k].node == edit.node) edit.link = own_[k].link->id;
        Link link;
        link.transform = wanted;
        link.id = 1'500'000 + static_cast<int>(goal);
        edit.links = {link};
        edit.slip = slipOfMissing(wanted, 0.95);
        return edit;
    }

    /// The group that a new link between two of the chain belongs to.
    int nodeFor(int theirNode, std::size_t place) const {
        const auto found = nodes_.find(theirNode);
        const int wanted = found == nodes_.end() ? last_ : found->second;
        // It has to lie between the groups of its neighbours.
        if (place > 0 && !mine_.isBelow(wanted, own_[place - 1].node)) return own_[place - 1].node;
        if (place < own_.size() && !mine_.isBelow(own_[place].node, wanted))
            return own_[place].node;
        return wanted;
    }

    const Outline &theirs_, &mine_;
    std::vector<At> goal_, own_;
    std::map<int, int> nodes_;
    int last_ = 0;
    std::vector<std::vector<double>> costs_;
    std::vector<std::vector<Move>> moves_;
};

}  // namespace

std::vector<Edit> alignChains(const Outline& theirs, int theirItem, const Outline& mine,
                              int myItem) {
    return Aligner(theirs, theirItem, mine, myItem).run();
}

}  // namespace farol::grade
