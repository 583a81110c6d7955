#pragma once

#include <map>
#include <string>
#include <vector>

#include "cli/submissions.h"

namespace farol::cli {

/// Replaces students' names in reports. A key file maps pseudonyms to students: a table with the
/// columns Pseudonym, Submission, Full name and Identifier. A later run keeps its rows.
class Pseudonyms {
  public:
    /// Reads the key file where there is one, adds the submissions that it lacks, and writes it.
    /// New names are numbered in the order of a digest of the submission, which is no order of
    /// names. Throws Error grade.table, OutputError.
    Pseudonyms(const std::string& keyFile, const std::vector<Submission>& submissions);
    /// Returns "Student 017". Precondition: one of the submissions.
    const std::string& of(const Submission& submission) const;

  private:
    std::map<std::string, std::string> byId_;
};

/// Returns the text without the student: replaces the submission's name (with and without its
/// ending) and the student's name, and removes the identifier from Moodle's name of the folder.
std::string withoutName(std::string text, const Submission& submission,
                        const std::string& pseudonym);

}  // namespace farol::cli
