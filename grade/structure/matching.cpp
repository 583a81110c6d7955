#include "grade/structure/matching.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "core/text.h"
#include "grade/structure/slips.h"

namespace farol::grade {
namespace {

constexpr double kStrangers = 1.2;          // from here on two items have nothing in common
constexpr std::size_t kMaxAssigned = 160;   // a side: more are paired greedily
constexpr std::size_t kMaxPairs = 250'000;  // that are weighed against each other
constexpr std::size_t kMaxChain = 24;       // links: longer chains count as unlike

const Outline::Item& at(const Side& side, std::size_t index) { return side.outline->items[index]; }

class Matcher {
  public:
    Matcher(const Side& theirs, const Side& mine, Forms& forms, Pictures& pictures, double size)
        : theirs_(theirs), mine_(mine), forms_(forms), pictures_(pictures), size_(size) {
        out_.mineOf.assign(theirs.outline->items.size(), -1);
        out_.isExtra.resize(mine.outline->items.size());
        for (std::size_t j = 0; j < out_.isExtra.size(); ++j) out_.isExtra[j] = !at(mine, j).isGone;
    }

    Matching run() {
        matchEqual();
        matchRest();
        return std::move(out_);
    }

  private:
    void match(std::size_t theirs, std::size_t mine) {
        out_.mineOf[theirs] = static_cast<int>(mine);
        out_.isExtra[mine] = false;
    }

    glm::dmat4 world(const Side& side, std::size_t item, std::size_t time) const {
        return side.poses[time][static_cast<std::size_t>(at(side, item).node)];
    }

    bool samePlace(std::size_t i, std::size_t j) {
        const Likeness& form = forms_.compare(at(theirs_, i), at(mine_, j));
        if (!form.isOneForm()) return false;
        for (std::size_t t = 0; t < theirs_.poses.size(); ++t)
            if (!isSamePlace(world(theirs_, i, t), world(mine_, j, t) * form.mineFromTheirs,
                             boundsOf(*at(theirs_, i).mesh), symmetryOf(at(theirs_, i)), size_))
                return false;
        return true;
    }

    double dressUnlikeness(std::size_t i, std::size_t j) {
        const Outline::Item &a = at(theirs_, i), &b = at(mine_, j);
        const glm::vec3 apart = glm::abs(a.material.diffuse.rgb - b.material.diffuse.rgb);
        double sum = 0.2 * static_cast<double>(std::min(1.0F, apart.x + apart.y + apart.z));
        const auto &x = a.model.texture, &y = b.model.texture;
        if (x.has_value() != y.has_value())
            sum += 0.1;
        else if (x && pictures_.compare(*x, *y).turn != Turn::none)
            sum += 0.15;
        sum += 0.1 * static_cast<double>(std::abs(opacityOf(a) - opacityOf(b)));
        return sum;
    }

    /// Pieces that are the same in all: most of a good submission.
    void matchEqual() {
        std::vector<std::size_t> order(out_.isExtra.size());
        const auto middle = [&](const Side& side, std::size_t item) {
            return middleOf(side, item);
        };
        std::vector<glm::dvec3> mine(order.size());
        for (std::size_t j = 0; j < order.size(); ++j) {
            order[j] = j;
            mine[j] = middle(mine_, j);
        }
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return std::make_pair(mine[a].x, a) < std::make_pair(mine[b].x, b);
        });
        const double reach = 0.01 * size_;
        for (const bool dressed : {true, false})
            for (std::size_t i = 0; i < out_.mineOf.size(); ++i) {
                if (out_.mineOf[i] >= 0) continue;
                const glm::dvec3 wanted = middle(theirs_, i);
                auto one =
                    std::lower_bound(order.begin(), order.end(), wanted.x - reach,
                                     [&](std::size_t j, double from) { return mine[j].x < from; });
                double least = 1e9;
                std::size_t best = 0;
                for (; one != order.end() && mine[*one].x <= wanted.x + reach; ++one) {
                    if (!out_.isExtra[*one] || glm::length(mine[*one] - wanted) > reach ||
                        !samePlace(i, *one))
                        continue;
                    const double dress = dressUnlikeness(i, *one);
                    if ((dressed && dress > 1e-3) || dress >= least) continue;
                    least = dress;
                    best = *one;
                }
                if (least < 1e9) match(i, best);
            }
    }

    void matchRest() {
        std::vector<std::size_t> left, right;
        for (std::size_t i = 0; i < out_.mineOf.size(); ++i)
            if (out_.mineOf[i] < 0) left.push_back(i);
        for (std::size_t j = 0; j < out_.isExtra.size(); ++j)
            if (out_.isExtra[j]) right.push_back(j);
        if (left.empty() || right.empty()) return;
        if (left.size() * right.size() > kMaxPairs) {
            for (std::size_t k = 0; k < std::min(left.size(), right.size()); ++k)
                match(left[k], right[k]);
            return;
        }
        std::vector<std::vector<double>> costs(left.size(), std::vector<double>(right.size()));
        for (std::size_t a = 0; a < left.size(); ++a)
            for (std::size_t b = 0; b < right.size(); ++b) {
                const double order =
                    std::abs(static_cast<double>(a) / static_cast<double>(left.size()) -
                             static_cast<double>(b) / static_cast<double>(right.size()));
                costs[a][b] = unlikeness(left[a], right[b]) + 0.05 * order;
            }
        if (std::max(left.size(), right.size()) <= kMaxAssigned) {
            const std::vector<int> columns = assign(costs, kStrangers);
            for (std::size_t a = 0; a < left.size(); ++a)
                if (columns[a] >= 0) match(left[a], right[static_cast<std::size_t>(columns[a])]);
            return;
        }
        std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
        for (std::size_t a = 0; a < left.size(); ++a)
            for (std::size_t b = 0; b < right.size(); ++b)
                if (costs[a][b] < kStrangers) pairs.emplace_back(costs[a][b], left[a], right[b]);
        std::sort(pairs.begin(), pairs.end());
        for (const auto& [cost, i, j] : pairs)
            if (out_.mineOf[i] < 0 && out_.isExtra[j]) match(i, j);
    }

    double unlikeness(std::size_t i, std::size_t j) {
        const Outline::Item &a = at(theirs_, i), &b = at(mine_, j);
        double sum = 0.0;
        if (b.lacksMesh) {
            sum += 0.3;  // for any appearance
        } else if (!forms_.compare(a, b).isOneForm()) {
            const auto* const entry = a.model.source.shape.entry;
            const bool kin = entry != nullptr && entry == b.model.source.shape.entry;
            sum += kin ? 0.4 : 0.8;
        }
        sum += std::min(0.5, 2.0 * glm::length(middleOf(theirs_, i) - middleOf(mine_, j)) / size_);
        sum += dressUnlikeness(i, j);
        sum += nameUnlikeness(a, b);
        sum += std::min(0.4, 0.15 * chainDistance(a.node, b.node));
        return sum;
    }

    static std::string nameOf(const Outline& outline, const Outline::Item& item) {
        if (!item.model.name.empty()) return lowerCase(item.model.name);
        for (int node = item.node; node > 0;
             node = outline.nodes[static_cast<std::size_t>(node)].parent) {
            const std::string& name = outline.nodes[static_cast<std::size_t>(node)].name;
            if (!name.empty()) return lowerCase(name);
        }
        return {};
    }

    double nameUnlikeness(const Outline::Item& a, const Outline::Item& b) const {
        const std::string x = nameOf(*theirs_.outline, a), y = nameOf(*mine_.outline, b);
        if (x.empty() || y.empty()) return 0.0;
        return x == y ? -0.3 : 0.1;
    }

    glm::dvec3 middleOf(const Side& side, std::size_t item) const {
        const render::Box box = boundsOf(*at(side, item).mesh);
        const glm::dvec3 middle = box.empty() ? glm::dvec3(0.0) : 0.5 * (box.min + box.max);
        return glm::dvec3(world(side, item, 0) * glm::dvec4(middle, 1.0));
    }

    /// The number of edits between the chains of two nodes (Levenshtein, half for other numbers).
    double chainDistance(int theirs, int mine) {
        const auto known = distances_.find({theirs, mine});
        if (known != distances_.end()) return known->second;
        const auto a = chainOf(*theirs_.outline, theirs), b = chainOf(*mine_.outline, mine);
        double distance = 3.0;
        if (a.size() <= kMaxChain && b.size() <= kMaxChain) {
            std::vector<double> row(b.size() + 1), above(b.size() + 1);
            for (std::size_t j = 0; j <= b.size(); ++j) above[j] = static_cast<double>(j);
            for (std::size_t i = 1; i <= a.size(); ++i) {
                row[0] = static_cast<double>(i);
                for (std::size_t j = 1; j <= b.size(); ++j) {
                    const bool kind = a[i - 1]->transform.index() == b[j - 1]->transform.index();
                    const bool same =
                        kind && isSameTransform(a[i - 1]->transform, b[j - 1]->transform);
                    row[j] = std::min({above[j] + 1.0, row[j - 1] + 1.0,
                                       above[j - 1] + (same   ? 0.0
                                                       : kind ? 0.5
                                                              : 1.5)});
                }
                std::swap(row, above);
            }
            distance = above[b.size()];
        }
        return distances_.emplace(std::make_pair(theirs, mine), distance).first->second;
    }

    const Side &theirs_, &mine_;
    Forms& forms_;
    Pictures& pictures_;
    double size_;
    Matching out_;
    std::map<std::pair<int, int>, double> distances_;
};

}  // namespace

Side sideOf(const Outline& outline, const std::vector<double>& timesS) {
    Side side;
    side.outline = &outline;
    for (const double time : timesS) side.poses.push_back(posesOf(outline, time));
    return side;
}

Matching matchItems(const Side& theirs, const Side& mine, Forms& forms, Pictures& pictures,
                    double sceneSize) {
    return Matcher(theirs, mine, forms, pictures, sceneSize).run();
}

std::vector<const Link*> chainOf(const Outline& outline, int node) {
    std::vector<const Link*> chain;
    for (const int one : outline.pathTo(node))
        for (const Link& link : outline.nodes[static_cast<std::size_t>(one)].links)
            chain.push_back(&link);
    return chain;
}

std::vector<int> assign(const std::vector<std::vector<double>>& costs, double most) {
    const std::size_t rows = costs.size(), given = rows == 0 ? 0 : costs.front().size();
    const std::size_t columns = given + rows;  // each row may stay alone, at the price `most`
    std::vector<double> ofRow(rows + 1, 0.0), ofColumn(columns + 1, 0.0);
    std::vector<std::size_t> rowAt(columns + 1, 0), from(columns + 1, 0);
    const auto cost = [&](std::size_t row, std::size_t column) {
        return column <= given ? std::min(costs[row - 1][column - 1], 2.0 * most) : most;
    };
    for (std::size_t row = 1; row <= rows; ++row) {
        rowAt[0] = row;
        std::size_t column = 0;
        std::vector<double> least(columns + 1, 1e18);
        std::vector<bool> isUsed(columns + 1, false);
        do {
            isUsed[column] = true;
            const std::size_t here = rowAt[column];
            double step = 1e18;
            std::size_t next = 0;
            for (std::size_t j = 1; j <= columns; ++j) {
                if (isUsed[j]) continue;
                const double reduced = cost(here, j) - ofRow[here] - ofColumn[j];
                if (reduced < least[j]) {
                    least[j] = reduced;
                    from[j] = column;
                }
                if (least[j] < step) {
                    step = least[j];
                    next = j;
                }
            }
            for (std::size_t j = 0; j <= columns; ++j)
                if (isUsed[j]) {
                    ofRow[rowAt[j]] += step;
                    ofColumn[j] -= step;
                } else {
                    least[j] -= step;
                }
            column = next;
        } while (rowAt[column] != 0);
        for (; column != 0; column = from[column]) rowAt[column] = rowAt[from[column]];
    }
    std::vector<int> out(rows, -1);
    for (std::size_t j = 1; j <= given; ++j)
        if (rowAt[j] != 0) out[rowAt[j] - 1] = static_cast<int>(j) - 1;
    return out;
}

}  // namespace farol::grade
