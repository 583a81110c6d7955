#pragma once

#include <string>
#include <vector>

namespace farol::fuzz {

/// The seed files below folders (or files themselves) with one of the endings, sorted by path and
/// without repeats, no longer than kMaxInput. What is left out is printed. Throws
/// std::runtime_error for a folder that is not there.
std::vector<std::string> readCorpus(const std::vector<std::string>& paths,
                                    const std::vector<std::string>& endings);

/// Writes a finding's input into `folder` under a name made of its content; returns the path.
std::string saveInput(const std::string& folder, const std::string& input);

}  // namespace farol::fuzz
