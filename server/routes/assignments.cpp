// Assignments, for the teacher: settings, codes of students, submissions.
#include "server/assignments/assignments.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/text.h"
#include "server/messages.h"
#include "server/request/media.h"
#include "server/request/parameters.h"
#include "server/request/token.h"
#include "server/request/upload.h"
#include "server/routes/answers.h"
#include "server/routes/assignment.h"
#include "worker/tasks/grade.h"

namespace farol::server {

using nlohmann::json;

Assignment assignmentOf(Context& context, const Call& call) {
    if (auto found = context.assignments.find(call.parameter)) return std::move(*found);
    throw Error(message<"http.not-found/assignment">("name"_arg = call.parameter));
}

namespace {

/// Of a list of all students of a course, with long names.
constexpr JsonLimits kStudentsJson{.bytes = std::size_t{1} << 20U};
constexpr const char* kStudentsFile = "students.json";

json toJson(const std::vector<StudentCode>& codes) {
    json out = json::array();
    for (const StudentCode& one : codes)
        out.push_back({{"student", one.student}, {"code", one.code}});
    return {{"codes", std::move(out)}};
}

struct StudentsRequest {
    std::vector<std::string> students;
    bool renews = false;
};

StudentsRequest readStudents(const std::string& body) {
    json value;
    try {
        value = parseJson(body, kStudentsJson);
    } catch (const JsonError& fault) {
        throw Error(message<"assignment.json">("reason"_arg = uncut(fault.what())),
                    {kStudentsFile, 0, 0});
    }
    const auto refuse = [] {
        throw Error(message<"assignment.students/list">("max"_arg = Assignments::kMaxStudents),
                    {kStudentsFile, 0, 0}, "students");
    };
    if (!value.is_object() || !value.contains("students") || !value["students"].is_array() ||
        value["students"].empty() || value["students"].size() > Assignments::kMaxStudents)
        refuse();
    StudentsRequest out;
    for (const json& name : value["students"]) {
        if (!name.is_string()) refuse();
        out.students.push_back(name.get<std::string>());
        const std::string& text = out.students.back();
        const bool isPlain = std::none_of(
            text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; });
        if (text.empty() || text.size() > Assignments::kMaxStudentBytes || !isPlain)
            throw Error(message<"assignment.students">("count"_arg = text.size(),
                                                       "max"_arg = Assignments::kMaxStudentBytes),
                        {kStudentsFile, 0, 0}, "students");
    }
    out.renews = value.value("renew", json(false)) == json(true);
    return out;
}

}  // namespace

http::Response listAssignments(Context& context, const Call& call) {
    refuseParameters(call);
    json all = json::array();
    for (const std::string& id : context.assignments.list())
        if (const auto assignment = context.assignments.find(id))
            all.push_back(describe(*assignment));
    return freshJson({{"assignments", std::move(all)}});
}

http::Response getAssignment(Context& context, const Call& call) {
    refuseParameters(call);
    const Assignment assignment = assignmentOf(context, call);
    if (!bearerOf(call.request)) return freshJson(describe(assignment));
    requireTeacher(call.request, context.options.token);
    return freshJson(describeWhole(assignment));
}

http::Response putAssignment(Context& context, const Call& call) {
    refuseParameters(call);
    if (!isAssignmentId(call.parameter))
        throw Error(message<"assignment.id">("value"_arg = call.parameter), {}, "id");
    const Assignment assignment = readAssignment(
        call.parameter, readParts(call.request, call.body, context.options.maxBodyBytes));
    // A reference that cannot be drawn is not kept.
    if (!assignment.reference.empty())
        context.backend.run<worker::ReferenceTask>(
            {assignment.subject(), worker::packRubric(assignment.rules())});
    const bool isNew = context.assignments.put(assignment);
    http::Response response = freshJson(describeWhole(assignment));
    response.status = isNew ? 201 : 200;
    response.logged.emplace_back("assignment", assignment.id);
    return response;
}

http::Response deleteAssignment(Context& context, const Call& call) {
    refuseParameters(call);
    if (!context.assignments.remove(call.parameter))
        throw Error(message<"http.not-found/assignment">("name"_arg = call.parameter));
    http::Response response;
    response.status = 204;
    return response;
}

http::Response getCodes(Context& context, const Call& call) {
    refuseParameters(call);
    return freshJson(toJson(context.assignments.codes(assignmentOf(context, call).id)));
}

http::Response postCodes(Context& context, const Call& call) {
    refuseParameters(call);
    const Assignment assignment = assignmentOf(context, call);
    const StudentsRequest wanted = readStudents(call.body.read(kStudentsJson.bytes));
    return freshJson(
        toJson(context.assignments.issue(assignment.id, wanted.students, wanted.renews)));
}

http::Response getSubmissions(Context& context, const Call& call) {
    const Parameters wanted = readParameters(call.request.query, {false, false, {"student"}, {}});
    const Assignment assignment = assignmentOf(context, call);
    if (const std::string student = wanted.ownValue("student"); !student.empty()) {
        auto kept = context.assignments.submissionOf(assignment.id, student);
        if (!kept) throw Error(message<"http.not-found/submission">("student"_arg = student));
        http::Response response;
        response.contentType = "application/octet-stream";
        response.body = std::move(kept->bytes);
        response.set("Cache-Control", "no-store");
        response.set("Content-Disposition", "attachment");
        return response;
    }
    json all = json::array();
    for (const KeptSubmission& one : context.assignments.submissions(assignment.id))
        all.push_back({{"student", one.student},
                       {"file", one.fileName},
                       {"bytes", one.size},
                       {"at", timeText(one.at)}});
    return freshJson({{"submissions", std::move(all)}});
}

}  // namespace farol::server
