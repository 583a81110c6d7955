#include "grade/report/groups.h"

#include "core/text.h"
#include "grade/report/csv.h"
#include "grade/report/overrides.h"

namespace farol::grade {

Groups::Groups(const std::string& text, const std::string& file) {
    const CsvTable table(text, file, {"submission", "full name", "identifier"});
    for (std::size_t i = 0; i < table.count(); ++i) {
        std::string number = table.at(i, "identifier");
        const std::string prefix = "participant ";
        if (lowerCase(number).starts_with(prefix)) number.erase(0, prefix.size());
        rows_.push_back({table.at(i, "submission"), {table.at(i, "full name"), number}});
    }
}

std::vector<Member> Groups::membersOf(const std::string& id, const std::string& name,
                                      const std::string& number) const {
    std::vector<Member> members;
    for (const auto& [submission, member] : rows_)
        if (isStudent(submission, id, name, number)) members.push_back(member);
    if (members.empty()) members.push_back({name, number});
    return members;
}

}  // namespace farol::grade
