#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "grade/report/report.h"

namespace farol::grade {

/// Two submissions that have the same, and what: never a verdict.
struct SimilarPair {
    std::size_t first = 0, second = 0;  ///< of the class
    std::size_t task = 0;
    double score = 0;
    std::vector<std::string> causes, places, comments;  ///< that both have
    std::size_t runs = 0;                               ///< of four tags in a row, that both have
};

/// Ranks pairs of submissions by the traits that both have and few others: what the reference has
/// is no trait, and what more than a quarter of the class has (or more than 50) was handed out.
/// At most `max` pairs, the highest score first.
std::vector<SimilarPair> similarPairs(const ClassResult& all, std::size_t max);

}  // namespace farol::grade
