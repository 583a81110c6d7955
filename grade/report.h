#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

/// A class's results as files: a page to read, a table for the grade book, JUnit for CI services,
/// JSON for everything else. They hold what the submissions hold and nothing of the run: the same
/// class gives the same bytes.
namespace farol::grade {

/// One task of one submission.
struct TaskResult {
    std::string task;                   ///< its name; empty where there is one task only
    std::string json;                   ///< of the grade (toJson); empty: not graded
    std::string failure;                ///< why it was not graded, in one sentence
    std::string code;                   ///< of the failure: "grade.no-scene"
    std::vector<std::string> pictures;  ///< JPEG, two a view: GradeReply::pictures
};

struct SubmissionResult {
    std::string id;      ///< the folder's or file's name, unique
    std::string name;    ///< the student's, where the name of the folder tells it
    std::string number;  ///< Moodle's identifier without "Participant", else empty
    double points = 0, most = 0;
    bool passed = false;
    std::vector<TaskResult> tasks;
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
};

void writeHtml(std::ostream& out, const ClassResult& all);
/// Moodle's offline grading worksheet and some columns more. A field that a spreadsheet would take
/// for a formula starts with an apostrophe.
void writeCsv(std::ostream& out, const ClassResult& all);
void writeJunit(std::ostream& out, const ClassResult& all);
void writeJson(std::ostream& out, const ClassResult& all);

}  // namespace farol::grade
