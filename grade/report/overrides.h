#pragma once

#include <optional>
#include <string>
#include <vector>

#include "grade/report/report.h"

namespace farol::grade {

/// Returns whether a name in a teacher's table means the student: the submission's name, the
/// student's name, or Moodle's identifier with or without "Participant", in any case.
bool isStudent(const std::string& who, const std::string& id, const std::string& name,
               const std::string& number);

/// A teacher's marks and comments, which stand over the program's.
class Overrides {
  public:
    Overrides() = default;
    /// Reads a table with the columns "student", "mark", "comment" and, where they are needed,
    /// "task" and "criterion". Without a criterion the mark is the task's; without a task too, the
    /// submission's. Throws Error grade.table: also a mark that is no number of 0 or more.
    Overrides(const std::string& text, const std::string& file);

    /// Changes the points of the criteria and tasks that rows name, and keeps the rows with the
    /// grade ("overrides"). A mark makes an ungraded task graded. Limits points to those of the
    /// criterion, the task or the submission.
    void applyToTask(TaskResult& task, const SubmissionResult& student, double most,
                     double passMark) const;
    /// The same for rows without a task, once the submission's points are summed up.
    void applyToTotal(SubmissionResult& student, double passMark) const;

    /// The lines of the rows that mean none of these students.
    std::vector<int> unused(const ClassResult& all) const;

  private:
    struct Row {
        std::string student, task, criterion, comment;
        std::optional<double> mark;
        int line = 0;
    };
    std::vector<const Row*> rowsOf(const SubmissionResult& student) const;
    std::vector<Row> rows_;
};

}  // namespace farol::grade
