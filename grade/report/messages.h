#pragma once

#include "core/message.h"

namespace farol::grade {

/// The fixed words of reports. view.js has the English ones of "part.page", too: the web page shows
/// it without a catalogue.
inline constexpr MessageRow kReportMessages[] = {
    {"part.page/all-equal", "The pictures are equal"},
    {"part.page/and-more", "{list} and {count} more", {"3, 5", "4"}},
    {"part.page/as-reference", "as the reference"},
    {"part.page/causes", "Causes"},
    {"part.page/choose",
     "Choose a submission: click it, or use the arrow keys; / goes to the filter"},
    {"part.page/class-alike", "Runs of four tags written alike: {count}", {"7"}},
    {"part.page/class-both", "{first} and {second}[, {task}]", {"Ana", "Rui", "house"}},
    {"part.page/class-comments", "The same comments ({count})", {"2"}},
    {"part.page/class-example", "Example"},
    {"part.page/class-mistake", "Mistake"},
    {"part.page/class-mistakes", "Most frequent mistakes of the class"},
    {"part.page/class-none", "None"},
    {"part.page/class-objects", "The same objects at the same other places ({count})", {"2"}},
    {"part.page/class-places", "Places"},
    {"part.page/class-points", "Points lost, mean"},
    {"part.page/class-same", "The same mistakes with the same numbers ({count})", {"2"}},
    {"part.page/class-sheet", "Contact sheet"},
    {"part.page/class-similar", "Similar submissions"},
    {"part.page/class-similar-about",
     "Pairs that share things which neither the reference nor most of the class has, the most "
     "first. A list to look into, not a verdict"},
    {"part.page/class-students", "Students"},
    {"part.page/class-summary",
     "{count} submissions, {graded} graded, {passed} passed; mean {mean}",
     {"5", "4", "3", "61.50"}},
    {"part.page/costs-nothing", "costs nothing"},
    {"part.page/coverage", "objects elsewhere {share} %", {"12"}},
    {"part.page/depth", "other depth {share} %", {"12"}},
    {"part.page/details", "Details"},
    {"part.page/diagnostics", "Diagnostics"},
    {"part.page/diagnostics-cost", "Diagnostics cost {points} points", {"3"}},
    {"part.page/difference", "difference"},
    {"part.page/difference-caption", "difference: black none, white most"},
    {"part.page/differs", "Differs: {share} %", {"12"}},
    {"part.page/earns-nothing", "earns nothing"},
    {"part.page/equal", "equal"},
    {"part.page/error", "error"},
    {"part.page/failed", "failed"},
    {"part.page/filter", "Filter"},
    {"part.page/filter-hint", "name, finding, passed, failed"},
    {"part.page/finding", "First finding"},
    {"part.page/flip", "FLIP mean {mean}, 95th percentile {percentile}", {"0.1", "0.4"}},
    {"part.page/info", "info"},
    {"part.page/line", "line {line}", {"3"}},
    {"part.page/lines", "lines {lines}", {"3, 5"}},
    {"part.page/median", "median {median} of {most} points", {"61", "100"}},
    {"part.page/no-match", "No submission matches"},
    {"part.page/no-submissions", "no submissions"},
    {"part.page/normals", "other normals {share} %", {"12"}},
    {"part.page/not-graded", "not graded"},
    {"part.page/not-graded-reason", "Not graded: {reason}", {"the document is empty"}},
    {"part.page/not-seen", "costs nothing: it cannot be seen"},
    {"part.page/nothing-differs", "Nothing was found that differs"},
    {"part.page/one-submission", "1 submission"},
    {"part.page/passed", "passed"},
    {"part.page/passed-count", "{count} passed", {"3"}},
    {"part.page/pictures", "Pictures"},
    {"part.page/points", "Points"},
    {"part.page/points-of", "{points} of {most} points", {"61", "100"}},
    {"part.page/reference", "reference"},
    {"part.page/result", "Result"},
    {"part.page/share-shown", "Share of the submission that is shown"},
    {"part.page/similarity", "The image shows {share} % of the reference", {"61"}},
    {"part.page/submission", "submission"},
    {"part.page/submission-head", "Submission"},
    {"part.page/submissions", "Submissions"},
    {"part.page/submissions-count", "{count} submissions", {"5"}},
    {"part.page/title", "Grades: {title}", {"House"}},
    {"part.page/unexplained",
     "Unexplained: the pictures still differ when all of this is corrected (−{points})",
     {"2.5"}},
    {"part.page/unread-count", "{count} could not be graded", {"1"}},
    {"part.page/warning", "warning"},
};

/// A message of this folder's table.
template <FixedString kId, FixedString... kNames>
Message reportMessage(const NamedArgument<kNames>&... arguments) {
    return makeMessage<kId, kReportMessages>(arguments...);
}

}  // namespace farol::grade
