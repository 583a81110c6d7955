#include "grade/report/overrides.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/bounded_json.h"
#include "core/error.h"
#include "core/number.h"
#include "core/text.h"
#include "grade/messages.h"
#include "grade/report/csv.h"
#include "grade/rubric/grader.h"
#include "scene/files/spelling.h"

namespace farol::grade {
namespace {

using nlohmann::ordered_json;

ordered_json entryOf(const std::string& criterion, const std::optional<double>& mark,
                     const std::string& comment) {
    ordered_json entry = ordered_json::object();
    if (!criterion.empty()) entry["criterion"] = criterion;
    if (mark) entry["mark"] = *mark;
    if (!comment.empty()) entry["comment"] = comment;
    return entry;
}

/// Returns an empty grade for an ungraded task, to which a teacher's mark is added.
ordered_json ungraded(const TaskFailure& failure, double most) {
    return {{"state", "graded"},
            {"points", 0.0},
            {"most", most},
            {"passed", false},
            {"refused", true},
            {"visible", false},
            {"present", 0},
            {"penalty", 0},
            {"unexplained", {{"points", 0}, {"share", 0}}},
            {"reason", {{"code", failure.code}, {"message", failure.message}}},
            {"criteria", ordered_json::array()},
            {"findings", ordered_json::array()},
            {"diagnostics", ordered_json::array()},
            {"views", ordered_json::array()}};
}

}  // namespace

bool isStudent(const std::string& who, const std::string& id, const std::string& name,
               const std::string& number) {
    if (who.empty()) return false;
    const std::string folded = scene::spelling::folded(who);
    const auto isSame = [&](const std::string& text) {
        return folded == scene::spelling::folded(text);
    };
    return isSame(id) || isSame(name) ||
           (!number.empty() && (isSame(number) || isSame("Participant " + number)));
}

Overrides::Overrides(const std::string& text, const std::string& file) {
    const CsvTable table(text, file, {"student", "mark", "comment"});
    for (std::size_t i = 0; i < table.count(); ++i) {
        Row row{table.at(i, "student"),
                table.at(i, "task"),
                lowerCase(table.at(i, "criterion")),
                table.at(i, "comment"),
                {},
                table.lineOf(i)};
        std::string mark = table.at(i, "mark");
        std::replace(mark.begin(), mark.end(), ',', '.');  // decimal commas
        if (!mark.empty()) {
            row.mark = parseExact<double>(mark);
            if (!row.mark || !(*row.mark >= 0.0 && *row.mark <= 1e6))
                throw Error(message<"grade.table/mark">("value"_arg = mark), {file, row.line, 0});
        }
        rows_.push_back(std::move(row));
    }
}

std::vector<const Overrides::Row*> Overrides::rowsOf(const SubmissionResult& student) const {
    std::vector<const Row*> rows;
    for (const Row& row : rows_)
        if (isStudent(row.student, student.id, student.name, student.number)) rows.push_back(&row);
    return rows;
}

void Overrides::applyToTask(TaskResult& task, const SubmissionResult& student, double most,
                            double passMark) const {
    std::vector<const Row*> rows = rowsOf(student);
    std::erase_if(rows, [&](const Row* row) {
        const bool isTotal = row->task.empty() && row->criterion.empty();
        return isTotal || (!row->task.empty() && !sameWord(row->task, task.task));
    });
    if (rows.empty()) return;
    const TaskFailure* failure = task.failure();
    ordered_json grade = failure != nullptr ? ungraded(*failure, most)
                                            : parseOrderedJson(task.grade()->json, kGradeJson);
    std::optional<double> whole;
    double points = grade.value("points", 0.0);
    for (const Row* row : rows) {
        grade["overrides"].push_back(entryOf(row->criterion, row->mark, row->comment));
        if (!row->mark) continue;
        if (row->criterion.empty()) {
            whole = std::min(*row->mark, most);
            continue;
        }
        for (ordered_json& criterion : grade["criteria"]) {
            if (lowerCase(criterion.value("measure", "")) != row->criterion) continue;
            const double now = std::min(*row->mark, criterion.value("most", 0.0));
            points += now - criterion.value("points", 0.0);
            criterion["points"] = now;
            if (criterion.value("kind", "") == "manual") {
                criterion["state"] = "marked";
                criterion["reason"] = row->comment;
            }
        }
    }
    points = whole.value_or(std::clamp(points, 0.0, most));
    if (whole) {
        grade["refused"] = false;
        grade["state"] = "graded";
    }
    points = std::round(100.0 * points) / 100.0;
    grade["points"] = points;
    grade["passed"] = !grade.value("refused", false) && points >= most * passMark / 100.0;
    TaskGrade changed = failure != nullptr ? TaskGrade{} : *task.grade();
    changed.json = dumpJson(grade);
    task.result = std::move(changed);
}

void Overrides::applyToTotal(SubmissionResult& student, double passMark) const {
    for (const Row* row : rowsOf(student)) {
        if (!row->task.empty() || !row->criterion.empty()) continue;
        if (row->mark) {
            student.points = std::min(*row->mark, student.most);
            student.graded = true;
            student.passed = student.points >= student.most * passMark / 100.0;
        }
        if (!row->comment.empty()) student.comments.push_back(row->comment);
        student.isOverridden = student.isOverridden || row->mark.has_value();
    }
}

std::vector<int> Overrides::unused(const ClassResult& all) const {
    std::vector<int> lines;
    std::vector<bool> isUsed(rows_.size(), false);
    for (std::size_t i = 0; i < all.count; ++i) {
        const SubmissionResult student = all.at(i);
        for (const Row* row : rowsOf(student))
            isUsed[static_cast<std::size_t>(row - rows_.data())] = true;
    }
    for (std::size_t i = 0; i < rows_.size(); ++i)
        if (!isUsed[i]) lines.push_back(rows_[i].line);
    return lines;
}

}  // namespace farol::grade
