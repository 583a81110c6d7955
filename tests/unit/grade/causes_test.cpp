#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>

#include "core/error.h"
#include "grade/rubric/severity.h"
#include "grade/rubric/work.h"
#include "grade/structure/matching.h"
#include "grade/structure/slips.h"
#include "scene/animation.h"

using namespace farol;
using namespace farol::grade;

namespace {

Slip between(const scene::Transform& mine, const scene::Transform& goal) {
    return slipBetween(mine, goal, false);
}

double sumOf(const std::vector<std::vector<double>>& costs, const std::vector<int>& columns,
             double most) {
    double sum = 0.0;
    for (std::size_t row = 0; row < columns.size(); ++row)
        sum += columns[row] < 0 ? most : costs[row][static_cast<std::size_t>(columns[row])];
    return sum;
}

}  // namespace

TEST_CASE("the slip of a transform is named by what people do") {
    const glm::dvec3 y(0, 1, 0);
    CHECK(between(scene::Rotate{40, y}, scene::Rotate{-40, y}).code == "transform.angle-sign");
    // A turn about the opposite axis is the same mistake.
    CHECK(between(scene::Rotate{40, y}, scene::Rotate{40, -y}).code == "transform.angle-sign");
    CHECK(between(scene::Rotate{0.7854, y}, scene::Rotate{45, y}).code == "transform.radians");
    CHECK(between(scene::Rotate{30, y}, scene::Rotate{30, {1, 0, 0}}).code == "transform.axis");
    CHECK(between(scene::Translate{{1, 2, 3}}, scene::Translate{{1, 2, -3}}).code ==
          "transform.sign");
    CHECK(between(scene::Translate{{1, 2, 3}}, scene::Translate{{1, 3, 2}}).code ==
          "transform.coordinates");
    CHECK(between(scene::Scale{{1, 2, 3}}, scene::Scale{{10, 20, 30}}).code ==
          "transform.magnitude");
    CHECK(between(scene::Scale{{2, 4, 1}}, scene::Scale{{0.5, 0.25, 1}}).code ==
          "transform.inverse");
    CHECK(between(scene::Translate{{1, 2, 3}}, scene::Translate{{1, 2.4, 3}}).code ==
          "transform.value");
    CHECK(between(scene::Spin{4, y}, scene::Spin{-4, y}).code == "animation.direction");
    CHECK(between(scene::Spin{4, y}, scene::Spin{9, y}).code == "animation.time");
    CHECK(between(scene::Rotate{4, y}, scene::Spin{9, y}).code == "animation.missing");
    for (const Slip& one : {between(scene::Rotate{40, y}, scene::Rotate{-40, y}),
                            between(scene::Translate{{1, 2, 3}}, scene::Translate{{1, 2.4, 3}})})
        CHECK(kindOf(one.code).topic == Topic::transforms);
}

TEST_CASE("a matrix is the product of what it is decomposed into") {
    const std::vector<scene::Transform> chain{scene::Translate{{1, -2, 0.5}},
                                              scene::Rotate{35, {0, 0.6, 0.8}},
                                              scene::Scale{{2, 0.5, -1}}};
    const glm::dmat4 whole = scene::matrixAt(chain, 0.0);
    const auto parts = decomposed(whole);
    REQUIRE(parts.has_value());
    const glm::dmat4 again = scene::matrixAt(*parts, 0.0);
    for (int column = 0; column < 4; ++column)
        CHECK(glm::length(whole[column] - again[column]) < 1e-3);
    glm::dmat4 sheared(1.0);
    sheared[1][0] = 0.4;
    CHECK_FALSE(decomposed(sheared).has_value());
}

TEST_CASE("items are assigned at the least sum") {
    const double most = 1.2;
    std::uint32_t state = 7;
    const auto next = [&state] {
        state = state * 1664525U + 1013904223U;
        return static_cast<double>(state >> 8U) / static_cast<double>(1U << 24U) * 1.6;
    };
    for (int round = 0; round < 9; ++round) {
        std::vector<std::vector<double>> costs(
            4, std::vector<double>(static_cast<std::size_t>(2 + round % 3)));
        for (auto& row : costs)
            for (double& cost : row) cost = next();
        // All orders of the columns, with places to stay alone.
        std::vector<int> order(costs.front().size() + costs.size());
        std::iota(order.begin(), order.end(), 0);
        double least = 1e9;
        do {
            std::vector<int> tried;
            for (std::size_t row = 0; row < costs.size(); ++row)
                tried.push_back(order[row] < static_cast<int>(costs.front().size()) ? order[row]
                                                                                    : -1);
            least = std::min(least, sumOf(costs, tried, most));
        } while (std::next_permutation(order.begin(), order.end()));
        CHECK(sumOf(costs, assign(costs, most), most) == Approx(least));
    }
}

TEST_CASE("a cause costs more the more it spoils, once and a half at several places") {
    for (const Kind& kind : kinds()) {
        INFO(kind.code);
        CHECK(kind.least <= kind.most);
        CHECK(kind.most <= 35.0);
        CHECK(costOf(kind, 0.0, 1) == kind.least);
        CHECK(costOf(kind, 1.0, 1) == kind.most);
        CHECK(costOf(kind, 0.2, 1) <= costOf(kind, 0.6, 1));
        const double three = costOf(kind, 0.3, 3);
        CHECK(three >= costOf(kind, 0.3, 1));
        CHECK(three <= 1.5 * costOf(kind, 0.3, 1) + 1e-9);
    }
    CHECK_THROWS(kindOf("transform.unheard-of"));
}

TEST_CASE("what is spoiled is weighed by object") {
    Work work;
    work.weights = {0.75, 0.25};
    work.items = {std::vector<std::uint32_t>(200, 0)};
    for (std::size_t p = 0; p < 100; ++p) work.items[0][p] = p < 50 ? 1 : 2;
    Spoiled none(work), second(work);
    none.add(0, std::vector<float>(200, 0.0F));
    CHECK(none.share() == 0.0);
    std::vector<float> changed(200, 0.0F);
    for (std::size_t p = 50; p < 100; ++p) changed[p] = 1.0F;
    second.add(0, changed);
    CHECK(second.share() == Approx(0.25));
}
