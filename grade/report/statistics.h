#pragma once

#include <cstdint>
#include <optional>
#include <vector>

/// Measures of how far raters agree.
namespace farol::grade {

/// Ratings of units by raters: one list a unit, one entry a rating, whoever gave it.
using RatedUnits = std::vector<std::vector<double>>;

/// Returns Krippendorff's alpha for interval data: 1 - D_o / D_e, where the distance of two ratings
/// is the square of their difference (K. Krippendorff, "Computing Krippendorff's
/// Alpha-Reliability", 2011, sections C and E). Units with fewer than two ratings do not count. At
/// most 1; 0 is chance, and less is worse than chance. Nothing where no unit counts or all ratings
/// are equal: D_e is 0.
std::optional<double> krippendorffAlpha(const RatedUnits& units);

struct Interval {
    double low = 0, high = 0;
};

/// Returns the 2.5 % and 97.5 % percentiles of alpha over `draws` classes of as many units, drawn
/// with replacement (B. Efron, R. J. Tibshirani, "An Introduction to the Bootstrap", 1993, section
/// 13.3). The seed is fixed: the same ratings give the same interval. Nothing where alpha is
/// undefined for the class or for half of the draws.
std::optional<Interval> bootstrapAlpha(const RatedUnits& units, int draws = 2'000,
                                       std::uint64_t seed = 20'260'101);

/// Returns Kendall's tau-b, -1..1 (M. G. Kendall, "The treatment of ties in ranking problems",
/// Biometrika 33, 1945). Precondition: as many values on both sides. Nothing where a side has no
/// two different values. Time grows with the square of the number of values.
std::optional<double> kendallTauB(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace farol::grade
