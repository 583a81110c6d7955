#pragma once

#include <map>
#include <string>
#include <vector>

#include "cli/submissions.h"

namespace farol::cli {

/// Names that reports show instead of the students'. A key file holds who is who: a table with the
/// columns Pseudonym, Submission, Full name and Identifier. A later run keeps what it holds.
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

/// Returns the text without what names the student: the submission's name, with and without its
/// ending, the student's name, and the identifier where it stands in Moodle's name of the folder.
std::string withoutName(std::string text, const Submission& submission,
                        const std::string& pseudonym);

}  // namespace farol::cli
