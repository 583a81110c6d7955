#pragma once

#include <string>
#include <vector>

#include "cli/submissions.h"
#include "grade/report/report.h"
#include "grade/rubric/rubric.h"

namespace farol::cli {

/// Returns the rubric of each task: of a file, of a folder that has TASK.json, or rubric.json for
/// those that have none; the default where there is neither, or `path` is empty. Throws Error
/// rubric.*, asset.*.
std::vector<grade::Rubric> readRubrics(const std::string& path,
                                       const std::vector<GradeTask>& tasks);

/// Returns the text of a table: of `path`, which must exist, else of `usual`, which may be missing.
/// Sets `path` to the file that was read, empty if none was. Throws Error asset.*.
std::string readTable(std::string& path, const std::string& usual);

/// Writes a zip with a page for each student, or each member of a group, under the name that Moodle
/// gave to the submission, so that Moodle takes it back as feedback files. Throws OutputError.
void writeFeedback(const std::string& path, const grade::ClassResult& all);

}  // namespace farol::cli
