#pragma once

#include <map>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "grade/formats/outcome.h"
#include "grade/report/report.h"

/// Grades in the forms that other programs read: a row of formats() each, from which come the help
/// of --format, `farol schema` and docs/reference/grading-formats.md.
namespace farol::grade {

/// What a format needs from outside of the class.
struct FormatContext {
    std::map<std::string, std::string> environment;  ///< the variables that the row names
    std::string utc;                                 ///< "2026-11-30T10:00:00Z"
};

/// A file that holds a submission, or the class.
struct Format {
    std::string_view name = {};         ///< the word of --format
    std::string_view file = {};         ///< its name in the report's folder
    std::string_view summary = {};      ///< of its reader and content
    std::string_view source = {};       ///< page that defines it; empty: Farol's own
    std::string_view sourceDate = {};   ///< of that page's text, as it was read
    std::string_view required = {};     ///< fields that the page wants
    std::string_view limits = {};       ///< of the platform, by that page
    std::string_view environment = {};  ///< blank-separated variables that must be set
    bool isDefault = false;             ///< written without --format
    /// Exactly one of both. ofOne: one file a submission, in its own folder for a class.
    void (*ofClass)(std::ostream&, const ClassResult&) = nullptr;
    void (*ofOne)(std::ostream&, const Outcome&, const FormatContext&) = nullptr;
};

std::span<const Format> formats();
/// Returns the row of that name, or null.
const Format* findFormat(std::string_view name);

// The rows' functions, one file each.
/// HTML with the images in data: URLs.
void writeGradescope(std::ostream& out, const Outcome& outcome, const FormatContext& context);
/// Leaves out images, the last first, until the text has at most 1,000,000 bytes.
void writePrairieLearn(std::ostream& out, const Outcome& outcome, const FormatContext& context);
void writeSubmitty(std::ostream& out, const Outcome& outcome, const FormatContext& context);
/// Every comment on one line, so that none can begin with "Grade :=>>".
void writeVpl(std::ostream& out, const Outcome& outcome, const FormatContext& context);
void writeClassroom50(std::ostream& out, const Outcome& outcome, const FormatContext& context);
void writeSarif(std::ostream& out, const ClassResult& all);
void writeGithub(std::ostream& out, const ClassResult& all);

/// The same two of a document's diagnostics, for `farol validate`.
void writeSarif(std::ostream& out, const Diagnostics& diagnostics);
void writeGithub(std::ostream& out, const Diagnostics& diagnostics);

// Sentences that several rows use.
/// Returns "the angle has the wrong sign (line 3) (-12.50)".
std::string sentenceOf(const OutcomeFinding& finding);
/// Returns "87.50 of 100.00 points".
std::string pointsOf(double points, double most);
/// Returns why the part is not graded, and what was taken besides the findings.
std::vector<std::string> remarksOf(const OutcomePart& part);
/// Returns the diagnostics but for the one that is the reason of not grading.
std::vector<OutcomeFinding> diagnosticsOf(const OutcomePart& part);
/// Returns a line of text for each comment, criterion, finding and remark.
std::vector<std::string> linesOf(const Outcome& outcome);
/// Returns "task: name"; the name alone where there is one task.
std::string nameIn(const OutcomePart& part, const std::string& name);

}  // namespace farol::grade
