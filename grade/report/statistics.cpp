#include "grade/report/statistics.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace farol::grade {
namespace {

/// Returns the sum of (a - b)^2 over all ordered pairs of different entries.
double squaredDifferences(double count, double sum, double sumOfSquares) {
    return 2.0 * (count * sumOfSquares - sum * sum);
}

/// What a unit adds to alpha, relative to the mean of all ratings.
struct UnitSums {
    double count = 0, sum = 0, sumOfSquares = 0;
    double observed = 0;  ///< squared differences within it, over count - 1
};

std::vector<UnitSums> sumsOf(const RatedUnits& units) {
    double sum = 0.0, count = 0.0;
    for (const std::vector<double>& unit : units)
        for (const double rating : unit) {
            sum += rating;
            count += 1.0;
        }
    const double mean = count > 0.0 ? sum / count : 0.0;
    std::vector<UnitSums> all;
    for (const std::vector<double>& unit : units) {
        if (unit.size() < 2) continue;
        UnitSums one;
        one.count = static_cast<double>(unit.size());
        for (const double rating : unit) {
            one.sum += rating - mean;
            one.sumOfSquares += (rating - mean) * (rating - mean);
        }
        one.observed = std::max(0.0, squaredDifferences(one.count, one.sum, one.sumOfSquares)) /
                       (one.count - 1.0);
        all.push_back(one);
    }
    return all;
}

template <typename Choose>
std::optional<double> alphaOf(const std::vector<UnitSums>& units, const Choose& choose) {
    UnitSums all;
    for (std::size_t i = 0; i < units.size(); ++i) {
        const UnitSums& unit = units[choose(i)];
        all.count += unit.count;
        all.sum += unit.sum;
        all.sumOfSquares += unit.sumOfSquares;
        all.observed += unit.observed;
    }
    if (all.count < 2.0) return std::nullopt;
    const double observed = all.observed / all.count;
    const double expected =
        squaredDifferences(all.count, all.sum, all.sumOfSquares) / (all.count * (all.count - 1.0));
    // Equal ratings leave rounding alone.
    constexpr double kRounding = 1e-12;
    if (!(expected > kRounding * std::max(1.0, all.sumOfSquares))) return std::nullopt;
    return 1.0 - observed / expected;
}

double percentile(const std::vector<double>& sorted, double share) {
    const double at = share * static_cast<double>(sorted.size() - 1);
    const auto low = static_cast<std::size_t>(at);
    const std::size_t high = std::min(low + 1, sorted.size() - 1);
    return std::lerp(sorted[low], sorted[high], at - static_cast<double>(low));
}

}  // namespace

std::optional<double> krippendorffAlpha(const RatedUnits& units) {
    return alphaOf(sumsOf(units), [](std::size_t i) { return i; });
}

std::optional<Interval> bootstrapAlpha(const RatedUnits& units, int draws, std::uint64_t seed) {
    const std::vector<UnitSums> sums = sumsOf(units);
    if (!alphaOf(sums, [](std::size_t i) { return i; })) return std::nullopt;
    // The standard fixes this generator's numbers; its distributions differ between libraries.
    std::mt19937_64 random(seed);
    std::vector<double> alphas;
    for (int draw = 0; draw < draws; ++draw) {
        const auto alpha = alphaOf(sums, [&](std::size_t) { return random() % sums.size(); });
        if (alpha) alphas.push_back(*alpha);
    }
    if (2 * alphas.size() < static_cast<std::size_t>(std::max(1, draws))) return std::nullopt;
    std::sort(alphas.begin(), alphas.end());
    return Interval{percentile(alphas, 0.025), percentile(alphas, 0.975)};
}

std::optional<double> kendallTauB(const std::vector<double>& a, const std::vector<double>& b) {
    const auto sign = [](double difference) { return (difference > 0) - (difference < 0); };
    std::int64_t score = 0, untiedA = 0, untiedB = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = i + 1; j < a.size(); ++j) {
            const int first = sign(a[i] - a[j]), second = sign(b[i] - b[j]);
            score += first * second;
            untiedA += first != 0 ? 1 : 0;
            untiedB += second != 0 ? 1 : 0;
        }
    if (untiedA == 0 || untiedB == 0) return std::nullopt;
    return static_cast<double>(score) /
           std::sqrt(static_cast<double>(untiedA) * static_cast<double>(untiedB));
}

}  // namespace farol::grade
