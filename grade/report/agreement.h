#pragma once

#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "grade/report/report.h"
#include "grade/report/statistics.h"

/// How far the program's marks agree with people's.
namespace farol::grade {

/// A row of a teacher's table of marks.
struct PersonMark {
    std::string student;  ///< as in isStudent()
    std::string rater;    ///< empty: the one person
    double mark = 0;      ///< points; the middle where a band is given
    std::optional<Interval> band;
    std::string comment;
    std::string page;  ///< address of the person's own marking: https:// or a relative path
    int line = 0;
};

/// Reads a table with the columns "student" and either "mark" or "low" and "high", and where they
/// are of use "rater", "comment" and "page". Throws Error grade.table.
std::vector<PersonMark> readPersonMarks(const std::string& text, const std::string& file);

/// A submission with marks of both.
struct MarkedTwice {
    std::string id, name;
    double program = 0;                    ///< points
    double people = 0;                     ///< points, mean
    std::vector<const PersonMark*> marks;  ///< of the table that was given
};

struct Agreement {
    std::string title;
    double most = 0;  ///< points of a perfect submission
    std::vector<std::string> raters;
    std::vector<MarkedTwice> submissions;  ///< the largest difference first
    std::size_t unmarked = 0;              ///< graded, without a mark by a person
    std::size_t ungraded = 0;              ///< marked by a person, without one of the program
    std::size_t overridden = 0;            ///< whose points are the teacher's: left out
    std::vector<int> unusedLines;          ///< of rows that name nobody

    std::optional<double> alpha;  ///< the program as one more rater
    std::optional<Interval> alphaInterval;
    std::optional<double> alphaPeople;  ///< of the people alone, where there are two
    std::optional<Interval> alphaPeopleInterval;
    std::optional<double> tauB;                ///< program and mean of the people
    double meanDifference = 0;                 ///< absolute, points
    double bias = 0;                           ///< mean of program - people, points
    std::size_t bands = 0;                     ///< submissions with a band
    std::size_t inBand = 0;                    ///< of them, those whose points lie in it
    static constexpr double kBandSlack = 1.0;  ///< points; beside a band that still counts
};

/// Compares the class's points with the marks, which outlive the result. Throws Error grade.table
/// for a mark above the points of a perfect submission.
Agreement compareMarks(const ClassResult& all, const std::vector<PersonMark>& marks,
                       const std::string& file);

/// Writes agreement.html: the figures, and the submissions with both marks, their difference, and
/// links to report.html and to the person's page.
void writeAgreementPage(std::ostream& out, const Agreement& agreement);
/// Writes agreement.json.
void writeAgreementJson(std::ostream& out, const Agreement& agreement);

}  // namespace farol::grade
