#include "server/request/problem.h"

#include <algorithm>
#include <iterator>
#include <map>

#include "core/limit_findings.h"
#include "server/request/media.h"

namespace farol::server {

using nlohmann::json;

std::string statusTitle(int status) {
    static const std::map<int, std::string> kTitles = {
        {400, "Bad Request"},
        {401, "Unauthorized"},
        {403, "Forbidden"},
        {404, "Not Found"},
        {405, "Method Not Allowed"},
        {406, "Not Acceptable"},
        {408, "Request Timeout"},
        {409, "Conflict"},
        {411, "Length Required"},
        {413, "Content Too Large"},
        {414, "URI Too Long"},
        {415, "Unsupported Media Type"},
        {421, "Misdirected Request"},
        {422, "Unprocessable Content"},
        {429, "Too Many Requests"},
        {431, "Request Header Fields Too Large"},
        {500, "Internal Server Error"},
        {501, "Not Implemented"},
        {503, "Service Unavailable"},
        {505, "HTTP Version Not Supported"},
    };
    const auto found = kTitles.find(status);
    return found == kTitles.end() ? "Error" : found->second;
}

Problem problemOf(const Error& error) {
    Problem problem;
    problem.status = statusOf(error.code());
    problem.code = error.code();
    problem.detail = error.primary().message;
    problem.diagnostics = error.diagnostics();
    return problem;
}

Problem problemOf(const worker::Busy& busy) {
    Problem problem;
    problem.status = statusOf(busy.code());
    problem.code = busy.code();
    problem.detail = busy.what();
    problem.diagnostics = {busy.diagnostic()};
    if (busy.retryAfterS() > 0)
        problem.headers.emplace_back("Retry-After", std::to_string(busy.retryAfterS()));
    return problem;
}

Problem problemOf(int status, Message message) {
    Problem problem;
    problem.status = status;
    problem.code = message.code();
    problem.detail = message.text;
    problem.diagnostics = {diagnosticOf(Severity::error, std::move(message))};
    return problem;
}

Diagnostics errorsOf(const Problem& problem) { return notable(problem.diagnostics); }

json toJson(const Diagnostics& diagnostics, Language language) {
    json out = json::array();
    for (const Diagnostic& one : diagnostics) {
        json entry = {{"code", one.code},
                      {"severity", kSeverityWords[one.severity]},
                      {"message", textIn(language, one)}};
        if (!one.where.file.empty()) entry["file"] = one.where.file;
        if (one.where.line > 0) entry["line"] = one.where.line;
        if (one.where.column > 0) entry["column"] = one.where.column;
        if (!one.field.empty()) entry["field"] = one.field;
        if (one.count > 1) entry["count"] = one.count;
        out.push_back(std::move(entry));
    }
    return out;
}

void setDiagnostics(json& object, const std::string& member, Diagnostics diagnostics,
                    Language language) {
    object[member + "Total"] = countFindings(diagnostics);
    limitFindings(diagnostics);
    object[member] = toJson(diagnostics, language);
}

Diagnostics notable(const Diagnostics& diagnostics) {
    Diagnostics out;
    std::copy_if(diagnostics.begin(), diagnostics.end(), std::back_inserter(out),
                 [](const Diagnostic& one) { return one.severity != Severity::info; });
    return out;
}

std::string dump(const json& value, int indent) {
    return value.dump(indent, ' ', false, json::error_handler_t::replace);
}

namespace {
/// Returns the detail, which is the text of one of the diagnostics, in the language.
std::string detailIn(Language language, const Problem& problem) {
    for (const Diagnostic& finding : problem.diagnostics)
        if (finding.message == problem.detail) return textIn(language, finding);
    return problem.detail;
}
}  // namespace

http::Response problemResponse(const Problem& problem, const std::string& requestId,
                               Language language) {
    json body = {{"type", "urn:farol:problem:" + problem.code},
                 {"title", statusTitle(problem.status)},
                 {"status", problem.status},
                 {"code", problem.code},
                 {"detail", detailIn(language, problem)},
                 {"requestId", requestId}};
    setDiagnostics(body, "errors", errorsOf(problem), language);
    http::Response response;
    response.status = problem.status;
    response.contentType = "application/problem+json";
    response.body = dump(body, 2) + "\n";
    response.headers = problem.headers;
    response.hold = problem.hold;
    response.set("Cache-Control", "no-store");
    setLanguage(response, language);
    response.logged.emplace_back("code", problem.code);
    return response;
}

}  // namespace farol::server
