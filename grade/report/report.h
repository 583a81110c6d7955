#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <variant>
#include <vector>

#include "core/language.h"
#include "grade/report/groups.h"

/// A class's results as files: a page to read, a table for the grade book, JUnit for CI services,
/// JSON for everything else. They depend on the submissions and not on the run: the same
/// class gives the same bytes.
namespace farol::grade {

/// A grade as reports hold it.
struct TaskGrade {
    std::string json;                   ///< toJson(Grade)
    std::vector<std::string> pictures;  ///< JPEG, two a view: the submission and the difference
};

/// Why a task was not graded.
struct TaskFailure {
    std::string code;     ///< "grade.no-scene"
    std::string message;  ///< one sentence
};

/// One task of one submission.
struct TaskResult {
    std::string task;  ///< its name; empty where there is one task only
    std::variant<TaskFailure, TaskGrade> result;
    /// Path of the document as the command line names it; empty where it is in an archive.
    std::string document = {};

    const TaskGrade* grade() const { return std::get_if<TaskGrade>(&result); }
    const TaskFailure* failure() const { return std::get_if<TaskFailure>(&result); }
};

struct SubmissionResult {
    std::string id;      ///< the folder's or file's name, unique
    std::string name;    ///< the student's, if the name of the folder has it
    std::string number;  ///< Moodle's identifier without "Participant", else empty
    double points = 0, most = 0;
    bool passed = false;
    std::vector<TaskResult> tasks;
    bool graded = true;         ///< false: no task has a mark, and neither has the submission
    bool isOverridden = false;  ///< the points are the teacher's
    std::vector<std::string> comments = {};  ///< the teacher's, of the whole
};

/// The class: results are asked for one after the other, so that all need not be in memory.
struct ClassResult {
    std::string title;  ///< of the rubric
    std::size_t count = 0;
    std::function<SubmissionResult(std::size_t)> at;
    std::vector<std::string> tasks;
    /// JPEG of the reference, by task and view.
    std::vector<std::vector<std::string>> references;
    std::string rubric;  ///< JSON
    Groups groups = {};
    Language language = Language::en;  ///< of pages and comments
};

void writeHtml(std::ostream& out, const ClassResult& all);
/// A page about the class: mistakes by how often they were made, a contact sheet, and pairs of
/// submissions that are alike, with both documents.
void writeClassPage(std::ostream& out, const ClassResult& all);
/// Moodle's offline grading worksheet and some columns more. A field that a spreadsheet would take
/// for a formula starts with an apostrophe.
void writeCsv(std::ostream& out, const ClassResult& all);
/// A row a student, a column for each task and each criterion of it; empty where there is no mark.
void writeCriteria(std::ostream& out, const ClassResult& all);
void writeJunit(std::ostream& out, const ClassResult& all);
void writeJson(std::ostream& out, const ClassResult& all);

}  // namespace farol::grade
