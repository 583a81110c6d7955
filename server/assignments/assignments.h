#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/assignments/assignment.h"

namespace farol::server {

/// A student and the code that the teacher gives to that student.
struct StudentCode {
    std::string student, code;
};

/// The last submission of a student.
struct KeptSubmission {
    std::string student, fileName;
    store::Time at;
    std::size_t size = 0;  ///< bytes
    std::string bytes;
};

/// The assignments of a service, their codes, tries and submissions, in records that services may
/// share. Thread-safe. Calls throw Busy as RecordStore does.
class Assignments {
  public:
    /// `records` outlives it.
    explicit Assignments(store::RecordStore& records) : records_(records) {}

    /// Returns false where it replaced one. Throws Error assignment.full beyond kMaxAssignments.
    bool put(const Assignment& assignment);
    std::optional<Assignment> find(const std::string& id);
    /// Removes it with its codes, tries and submissions; false where there was none.
    bool remove(const std::string& id);
    /// The ids in their order.
    std::vector<std::string> list();

    /// Returns the codes of students, one each: those that they have, or new ones; with `renews`
    /// new ones for all, and the old ones end. Throws Error assignment.full beyond kMaxStudents.
    std::vector<StudentCode> issue(const std::string& id, const std::vector<std::string>& students,
                                   bool renews);
    /// All codes, by student.
    std::vector<StudentCode> codes(const std::string& id);
    /// Returns the student of a code, in a time that does not depend on it; nothing for a wrong
    /// one.
    std::optional<std::string> studentOf(const std::string& id, const std::string& code);

    /// Counts a try of a student across all services that share the records.
    store::Tries take(const Assignment& assignment, const std::string& student);

    /// Keeps a student's last submission for the assignment's retention; nothing at 0 days.
    void keep(const Assignment& assignment, const KeptSubmission& submission);
    /// All of them without their bytes, by student.
    std::vector<KeptSubmission> submissions(const std::string& id);
    std::optional<KeptSubmission> submissionOf(const std::string& id, const std::string& student);

    /// Removes what has reached its end; returns the number of records.
    std::size_t expire() { return records_.expire(); }

    static constexpr std::size_t kMaxAssignments = 500, kMaxStudents = 5'000;
    static constexpr std::size_t kMaxStudentBytes = 100;  ///< of a name

  private:
    store::RecordStore& records_;
};

}  // namespace farol::server
