#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "grade/report/report.h"

namespace farol::grade {

/// Two similar submissions and their common traits: never a verdict.
struct SimilarPair {
    std::size_t first = 0, second = 0;  ///< of the class
    std::size_t task = 0;
    double score = 0;
    std::vector<std::string> causes, places, comments;  ///< that both have
    std::size_t runs = 0;                               ///< of four tags in a row, that both have
};

/// Ranks pairs of submissions by traits that both have and few others. Ignores traits of the
/// reference, and of more than a quarter of the class (or more than 50): those were handed out.
/// Returns at most `max` pairs, the highest score first.
std::vector<SimilarPair> similarPairs(const ClassResult& all, std::size_t max);

}  // namespace farol::grade
