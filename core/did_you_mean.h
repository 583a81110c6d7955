#pragma once

#include <string>
#include <vector>

namespace farol {

/// The candidate nearest to `word` (Damerau-Levenshtein, case-insensitive), or "" when none is
/// within a third of the word's length (at least 1, at most 3 edits). Words over 64 bytes get none;
/// of many candidates the first 2000 are compared.
std::string didYouMean(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace farol
