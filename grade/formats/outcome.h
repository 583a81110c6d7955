#pragma once

#include <string>
#include <vector>

#include "core/error.h"
#include "grade/report/report.h"

namespace farol::grade {

/// A cause or a diagnostic at its place, for the formats of other programs.
struct OutcomeFinding {
    std::string code;
    std::string message;  ///< one sentence in UTF-8 without line breaks
    Severity severity = Severity::warning;
    /// `file` is the document's path where TaskResult has one, else its name; line 0: no place.
    Location where;
    double points = 0;  ///< that it costs
};

/// A criterion or a requirement of a task.
struct OutcomeItem {
    std::string id;    ///< "transforms"
    std::string name;  ///< that, or the requirement's text
    double points = 0, most = 0;
    std::string reason;  ///< the points explained in one sentence; may be empty
    std::vector<OutcomeFinding> findings;
};

struct OutcomeImage {
    std::string label;  ///< "submission, view 1"
    std::string jpeg;
};

/// A task of a submission.
struct OutcomePart {
    std::string task;  ///< empty where there is one only
    bool isGraded = false;
    std::string reason;                       ///< why it is not graded
    double points = 0, most = 0;              ///< of the task's rubric
    std::vector<OutcomeItem> items;           ///< in the order of the rubric
    std::vector<OutcomeFinding> diagnostics;  ///< of the document; and causes without a criterion
    double penalty = 0;                       ///< points taken for diagnostics and repairs
    double unexplained = 0;                   ///< points taken for what no cause explains
    /// Renders of the submission and the differences, never the reference alone.
    std::vector<OutcomeImage> images;
};

/// What the formats say about a submission.
struct Outcome {
    std::string id, name, title;
    double points = 0, most = 0;
    bool isGraded = false, isPassed = false;
    std::vector<std::string> comments;  ///< the teacher's
    std::vector<OutcomePart> parts;
};

/// Reads submission `index` of the class.
Outcome outcomeOf(const ClassResult& all, std::size_t index);

/// Returns the text in UTF-8 on one line: line breaks and control characters become blanks, so that
/// a name in a scene cannot begin a new line.
std::string onOneLine(const std::string& text);

}  // namespace farol::grade
