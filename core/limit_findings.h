#pragma once

#include "core/error.h"

namespace farol {

/// Findings of one answer: a response of the service, a run of a command.
inline constexpr std::size_t kMaxFindings = 50;

/// Merges equal findings about files (asset.*, image.*, mesh.*) into the first of them with their
/// count. Of more than kMaxFindings keeps errors before warnings before infos, in their order, and
/// replaces the rest by a note with their number.
void limitFindings(Diagnostics& findings);

/// Returns the number of findings with their repetitions.
int countFindings(const Diagnostics& findings);

/// Returns the note "17 more findings are not shown", which counts as the `count` findings.
Diagnostic hiddenNote(int count, const std::string& file);

}  // namespace farol
