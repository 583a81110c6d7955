#pragma once

#include <map>
#include <string>
#include <vector>

namespace farol::grade {

/// A student of a group that handed in together.
struct Member {
    std::string name, number;  ///< Moodle's identifier without "Participant"
};

/// The groups of a class: each member gets a row in the grade book.
class Groups {
  public:
    Groups() = default;
    /// Reads a table with the columns "submission", "full name" and "identifier"; a submission may
    /// be named as in isStudent(). Throws Error grade.table.
    Groups(const std::string& text, const std::string& file);
    /// Returns the members of the group that handed in; the student alone where there is none.
    std::vector<Member> membersOf(const std::string& id, const std::string& name,
                                  const std::string& number) const;

  private:
    std::vector<std::pair<std::string, Member>> rows_;
};

}  // namespace farol::grade
