#include "server/assignments/assignments.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/digest.h"
#include "server/messages.h"
#include "server/secret.h"

namespace farol::server {

using nlohmann::json;
using store::Time;

namespace {

constexpr const char* kTable = "assignments";
constexpr JsonLimits kRecordJson{.bytes = 4'096, .stringBytes = 1'000};
/// How long tries are remembered after the end of an assignment, and of one without an end after
/// the last try.
constexpr std::chrono::hours kTryMemory{24 * 400};

// Names of students are no record names, and codes must not be found by comparing their first
// letters.
std::string studentKey(const std::string& student) { return contentDigest("student " + student); }
std::string codeKey(const std::string& code) { return contentDigest("code " + code); }

std::string codesOf(const std::string& id) { return "codes." + id; }
std::string studentsOf(const std::string& id) { return "students." + id; }
std::string triesOf(const std::string& id) { return "tries." + id; }
std::string submissionsOf(const std::string& id) { return "submissions." + id; }

std::string encode(const StudentCode& one) {
    return dumpJson(json{{"student", one.student}, {"code", one.code}});
}

std::optional<StudentCode> decodeCode(const std::string& record) {
    try {
        const json value = parseJson(record, kRecordJson);
        return StudentCode{value.at("student").get<std::string>(),
                           value.at("code").get<std::string>()};
    } catch (const std::exception&) {  // a record of another version
        return std::nullopt;
    }
}

std::optional<KeptSubmission> decodeSubmission(const std::string& record) {
    const std::size_t end = record.find('\n');
    if (end == std::string::npos) return std::nullopt;
    try {
        const json head = parseJson(std::string_view(record).substr(0, end), kRecordJson);
        const auto at = timeOfText(head.at("at").get<std::string>());
        if (!at) return std::nullopt;
        return KeptSubmission{head.at("student").get<std::string>(),
                              head.at("file").get<std::string>(), *at, record.size() - end - 1,
                              record.substr(end + 1)};
    } catch (const std::exception&) {  // a record of another version
        return std::nullopt;
    }
}

}  // namespace

bool Assignments::put(const Assignment& assignment) {
    const std::vector<std::string> known = list();
    const bool isKnown = std::find(known.begin(), known.end(), assignment.id) != known.end();
    if (!isKnown && known.size() >= kMaxAssignments)
        throw Error(message<"assignment.full">("max"_arg = kMaxAssignments));
    records_.put(kTable, assignment.id, encodeAssignment(assignment), Time::max());
    return !isKnown;
}

std::optional<Assignment> Assignments::find(const std::string& id) {
    if (!isAssignmentId(id)) return std::nullopt;
    const auto record = records_.get(kTable, id);
    return record ? decodeAssignment(id, *record) : std::nullopt;
}

bool Assignments::remove(const std::string& id) {
    if (!isAssignmentId(id) || !records_.remove(kTable, id)) return false;
    for (const std::string& table : {codesOf(id), studentsOf(id), triesOf(id), submissionsOf(id)})
        records_.clear(table);
    return true;
}

std::vector<std::string> Assignments::list() { return records_.keys(kTable); }

std::vector<StudentCode> Assignments::issue(const std::string& id,
                                            const std::vector<std::string>& students, bool renews) {
    const std::vector<std::string> known = records_.keys(studentsOf(id));
    std::size_t count = known.size();
    for (const std::string& student : students)
        count += std::binary_search(known.begin(), known.end(), studentKey(student)) ? 0 : 1;
    if (count > kMaxStudents)
        throw Error(message<"assignment.full/students">("max"_arg = kMaxStudents));
    std::vector<StudentCode> out;
    for (const std::string& student : students) {
        const auto record = records_.get(studentsOf(id), studentKey(student));
        const auto before = record ? decodeCode(*record) : std::nullopt;
        if (before && !renews) {
            out.push_back(*before);
            continue;
        }
        const StudentCode issued{student, randomSecret()};
        records_.put(codesOf(id), codeKey(issued.code), encode(issued), Time::max());
        records_.put(studentsOf(id), studentKey(student), encode(issued), Time::max());
        if (before) records_.remove(codesOf(id), codeKey(before->code));
        out.push_back(issued);
    }
    return out;
}

std::vector<StudentCode> Assignments::codes(const std::string& id) {
    std::vector<StudentCode> out;
    for (const std::string& key : records_.keys(studentsOf(id)))
        if (const auto record = records_.get(studentsOf(id), key))
            if (auto one = decodeCode(*record)) out.push_back(std::move(*one));
    std::sort(out.begin(), out.end(),
              [](const StudentCode& a, const StudentCode& b) { return a.student < b.student; });
    return out;
}

std::optional<std::string> Assignments::studentOf(const std::string& id, const std::string& code) {
    const auto record = records_.get(codesOf(id), codeKey(code));
    const auto known = record ? decodeCode(*record) : std::nullopt;
    if (!known || !isSameSecret(known->code, code)) return std::nullopt;
    return known->student;
}

store::Tries Assignments::take(const Assignment& assignment, const std::string& student) {
    store::TryLimits limits{assignment.triesPerHour, assignment.tries, store::now() + kTryMemory};
    if (assignment.closes != Time::max()) limits.forgotten = assignment.closes + kTryMemory;
    return records_.take(triesOf(assignment.id), studentKey(student), limits);
}

void Assignments::keep(const Assignment& assignment, const KeptSubmission& submission) {
    if (assignment.retentionDays == 0) return;
    const json head = {{"student", submission.student},
                       {"file", submission.fileName},
                       {"at", timeText(submission.at)}};
    records_.put(submissionsOf(assignment.id), studentKey(submission.student),
                 dumpJson(head) + "\n" + submission.bytes,
                 submission.at + std::chrono::hours(24 * assignment.retentionDays));
}

std::vector<KeptSubmission> Assignments::submissions(const std::string& id) {
    std::vector<KeptSubmission> out;
    for (const std::string& key : records_.keys(submissionsOf(id)))
        if (const auto record = records_.get(submissionsOf(id), key))
            if (auto one = decodeSubmission(*record)) {
                one->bytes = {};
                out.push_back(std::move(*one));
            }
    std::sort(out.begin(), out.end(), [](const KeptSubmission& a, const KeptSubmission& b) {
        return a.student < b.student;
    });
    return out;
}

std::optional<KeptSubmission> Assignments::submissionOf(const std::string& id,
                                                        const std::string& student) {
    const auto record = records_.get(submissionsOf(id), studentKey(student));
    return record ? decodeSubmission(*record) : std::nullopt;
}

}  // namespace farol::server
