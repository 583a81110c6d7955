#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "grade/report/student_answer.h"
#include "grade/rubric/rubric.h"
#include "grade/rubric/subject.h"
#include "server/request/multipart.h"
#include "server/store/record_store.h"

namespace farol::server {

/// A task that students check their scenes against, without seeing its reference.
struct Assignment {
    std::string id;  ///< isAssignmentId
    std::string title;
    store::Time opens{};                      ///< the epoch: open from the start
    store::Time closes = store::Time::max();  ///< never
    grade::StudentView view{.shows = {"requirements", "document"}};
    bool lendsFiles = false;  ///< the reference's files to submissions that lack them
    /// Of one student: in an hour, and in all.
    int triesPerHour = grade::kDefaultTriesPerHour, tries = grade::kDefaultTries;
    int retentionDays = 0;                 ///< how long the last submission is kept; 0: not at all
    std::string rubric;                    ///< JSON, as sent; empty: the default
    std::string referenceName, reference;  ///< of the part "reference"; empty: none

    /// Throws Error as grade::readRubric does.
    grade::Rubric rules() const;
    /// The reference as a grader takes it; none where there is none.
    grade::Subject subject() const;
};

/// Returns whether a text is 1 to 40 of a-z, 0-9 and "-".
bool isAssignmentId(const std::string& id);

/// RFC 3339 in UTC: "2026-12-01T23:59:00Z".
std::string timeText(store::Time time);
/// Nothing for a text that is no such time of 1970 to 2200.
std::optional<store::Time> timeOfText(const std::string& text);

/// Reads the parts "assignment" (JSON), "rubric" and "reference". Throws Error http.multipart,
/// rubric.*, assignment.json, assignment.time, grade.no-reference, grade.needless-reference.
Assignment readAssignment(const std::string& id, std::vector<Part> parts);

/// The settings as a student sees them: title, times, what is shown, tries.
nlohmann::json describe(const Assignment& assignment);
/// All but the bytes of the reference, for the teacher.
nlohmann::json describeWhole(const Assignment& assignment);

/// The record of an assignment.
std::string encodeAssignment(const Assignment& assignment);
/// Nothing for bytes that are no such record.
std::optional<Assignment> decodeAssignment(const std::string& id, const std::string& record);

}  // namespace farol::server
