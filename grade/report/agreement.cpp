#include "grade/report/agreement.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>
#include <utility>

#include "core/bounded_json.h"
#include "core/error.h"
#include "core/number.h"
#include "core/text.h"
#include "grade/messages.h"
#include "grade/report/csv.h"
#include "grade/report/overrides.h"
#include "grade/rubric/grader.h"
#include "scene/files/spelling.h"

namespace farol::grade {
namespace {

constexpr double kMaxMark = 1e6;

double numberOf(std::string text, const Location& where) {
    std::replace(text.begin(), text.end(), ',', '.');  // decimal commas
    const auto value = parseExact<double>(text);
    if (!value || !(*value >= 0.0 && *value <= kMaxMark))
        throw Error(message<"grade.table/mark">("value"_arg = text), where);
    return *value;
}

/// A link that runs no script: a web address, or a relative path.
bool isSafePage(const std::string& page) {
    return page.starts_with("https://") || page.starts_with("http://") ||
           (page.find(':') == std::string::npos && !page.starts_with("//"));
}

/// Whether a teacher's mark stands in the place of the program's.
bool hasMarkByHand(const SubmissionResult& one) {
    return one.isOverridden ||
           std::any_of(one.tasks.begin(), one.tasks.end(), [](const TaskResult& task) {
               return task.grade() != nullptr &&
                      parseJson(task.grade()->json, kGradeJson).contains("overrides");
           });
}

std::vector<const PersonMark*> marksOf(const SubmissionResult& one,
                                       const std::vector<PersonMark>& marks,
                                       std::vector<bool>& isUsed) {
    std::vector<const PersonMark*> own;
    for (std::size_t i = 0; i < marks.size(); ++i)
        if (isStudent(marks[i].student, one.id, one.name, one.number)) {
            own.push_back(&marks[i]);
            isUsed[i] = true;
        }
    return own;
}

void measure(Agreement& agreement) {
    RatedUnits people, both;
    std::vector<double> programs, means;
    for (const MarkedTwice& one : agreement.submissions) {
        std::vector<double> unit;
        for (const PersonMark* mark : one.marks) unit.push_back(mark->mark);
        people.push_back(unit);
        unit.push_back(one.program);
        both.push_back(std::move(unit));
        programs.push_back(one.program);
        means.push_back(one.people);
        agreement.bias += one.program - one.people;
        agreement.meanDifference += std::abs(one.program - one.people);
        for (const PersonMark* mark : one.marks) {
            if (!mark->band) continue;
            ++agreement.bands;
            agreement.inBand += one.program >= mark->band->low - Agreement::kBandSlack &&
                                        one.program <= mark->band->high + Agreement::kBandSlack
                                    ? 1
                                    : 0;
        }
    }
    const double count = std::max<double>(1.0, static_cast<double>(agreement.submissions.size()));
    agreement.bias /= count;
    agreement.meanDifference /= count;
    agreement.alpha = krippendorffAlpha(both);
    agreement.alphaInterval = bootstrapAlpha(both);
    if (agreement.raters.size() > 1) {
        agreement.alphaPeople = krippendorffAlpha(people);
        agreement.alphaPeopleInterval = bootstrapAlpha(people);
    }
    agreement.tauB = kendallTauB(programs, means);
}

}  // namespace

std::vector<PersonMark> readPersonMarks(const std::string& text, const std::string& file) {
    const CsvTable table(text, file, {"student"});
    std::vector<PersonMark> marks;
    std::set<std::pair<std::string, std::string>> known;  // rater, student
    for (std::size_t i = 0; i < table.count(); ++i) {
        PersonMark one;
        one.line = table.lineOf(i);
        const Location where{file, one.line, 0};
        one.student = table.at(i, "student");
        one.rater = table.at(i, "rater");
        one.comment = table.at(i, "comment");
        one.page = table.at(i, "page");
        if (!isSafePage(one.page))
            throw Error(message<"grade.table/page">("value"_arg = one.page), where);
        const std::string mark = table.at(i, "mark");
        const std::string low = table.at(i, "low"), high = table.at(i, "high");
        if (!low.empty() || !high.empty()) {
            one.band = Interval{numberOf(low, where), numberOf(high, where)};
            if (one.band->low > one.band->high)
                throw Error(message<"grade.table/band">("low"_arg = low, "high"_arg = high), where);
            one.mark = std::midpoint(one.band->low, one.band->high);
        } else if (mark.empty()) {
            continue;  // a row of the grade book without a mark
        }
        if (!mark.empty()) one.mark = numberOf(mark, where);
        if (!known.emplace(one.rater, scene::spelling::folded(one.student)).second)
            throw Error(message<"grade.table/twice">("student"_arg = one.student), where);
        marks.push_back(std::move(one));
    }
    if (marks.empty()) throw Error(message<"grade.table/no-marks">(), {file, 1, 0});
    return marks;
}

Agreement compareMarks(const ClassResult& all, const std::vector<PersonMark>& marks,
                       const std::string& file) {
    Agreement agreement;
    agreement.title = all.title;
    for (const PersonMark& mark : marks)
        if (std::find(agreement.raters.begin(), agreement.raters.end(), mark.rater) ==
            agreement.raters.end())
            agreement.raters.push_back(mark.rater);
    std::vector<bool> isUsed(marks.size(), false);
    for (std::size_t i = 0; i < all.count; ++i) {
        const SubmissionResult one = all.at(i);
        agreement.most = one.most;
        MarkedTwice entry{one.id, one.name, one.points, 0, marksOf(one, marks, isUsed)};
        for (const PersonMark* mark : entry.marks) {
            if (mark->mark > one.most)
                throw Error(
                    message<"grade.table/above">("value"_arg = mark->mark, "most"_arg = one.most),
                    {file, mark->line, 0});
            entry.people += mark->mark / static_cast<double>(entry.marks.size());
        }
        if (hasMarkByHand(one))
            ++agreement.overridden;
        else if (entry.marks.empty())
            agreement.unmarked += one.graded ? 1 : 0;
        else if (!one.graded)
            ++agreement.ungraded;
        else
            agreement.submissions.push_back(std::move(entry));
    }
    for (std::size_t i = 0; i < marks.size(); ++i)
        if (!isUsed[i]) agreement.unusedLines.push_back(marks[i].line);
    std::stable_sort(agreement.submissions.begin(), agreement.submissions.end(),
                     [](const MarkedTwice& a, const MarkedTwice& b) {
                         return std::abs(a.program - a.people) > std::abs(b.program - b.people);
                     });
    measure(agreement);
    return agreement;
}

}  // namespace farol::grade
