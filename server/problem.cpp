#include "server/problem.h"

#include <algorithm>
#include <iterator>
#include <map>

namespace farol::server {

using nlohmann::json;

int statusOf(const std::string& code) {
    static const std::map<std::string, int> kExact = {
        {"http.not-found", 404},      {"http.method", 405},          {"http.unauthorized", 401},
        {"limit.store", 413},         {"store.full", 503},           {"store.failed", 503},
        {"http.not-acceptable", 406}, {"http.length-required", 411}, {"limit.body", 413},
        {"http.uri-too-long", 414},   {"http.media-type", 415},      {"http.content-encoding", 415},
        {"busy.connections", 503},    {"busy.queue", 503},           {"busy.deadline", 503},
        {"busy.draining", 503},       {"worker.crashed", 503},       {"worker.killed", 503},
        {"worker.quarantine", 503},   {"busy.superseded", 409},      {"limit.rate", 429},
        {"grade.no-submission", 400}, {"grade.no-reference", 400},   {"not-ready", 503},
        {"store.unreachable", 503},
    };
    if (const auto found = kExact.find(code); found != kExact.end()) return found->second;
    for (const char* family : {"option.", "http.", "xml.", "bundle."})
        if (code.starts_with(family)) return 400;
    return 422;
}

std::string statusTitle(int status) {
    static const std::map<int, std::string> kTitles = {
        {400, "Bad Request"},
        {401, "Unauthorized"},
        {404, "Not Found"},
        {405, "Method Not Allowed"},
        {406, "Not Acceptable"},
        {408, "Request Timeout"},
        {409, "Conflict"},
        {411, "Length Required"},
        {413, "Content Too Large"},
        {414, "URI Too Long"},
        {415, "Unsupported Media Type"},
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
    return {statusOf(error.code()), error.code(), error.primary().message, error.diagnostics(), {}};
}

json toJson(const Diagnostics& diagnostics) {
    static constexpr const char* kSeverities[] = {"info", "warning", "error"};
    json out = json::array();
    for (const Diagnostic& one : diagnostics) {
        json entry = {{"code", one.code},
                      {"severity", kSeverities[static_cast<std::size_t>(one.severity)]},
                      {"message", one.message}};
        if (!one.where.file.empty()) entry["file"] = one.where.file;
        if (one.where.line > 0) entry["line"] = one.where.line;
        if (one.where.column > 0) entry["column"] = one.where.column;
        if (!one.field.empty()) entry["field"] = one.field;
        out.push_back(std::move(entry));
    }
    return out;
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

http::Response problemResponse(const Problem& problem, const std::string& requestId) {
    Diagnostics errors = notable(problem.diagnostics);
    if (errors.empty()) {
        Diagnostic only;
        only.code = problem.code;
        only.message = problem.detail;
        errors.push_back(std::move(only));
    }
    const json body = {{"type", "urn:farol:problem:" + problem.code},
                       {"title", statusTitle(problem.status)},
                       {"status", problem.status},
                       {"code", problem.code},
                       {"detail", problem.detail},
                       {"requestId", requestId},
                       {"errors", toJson(errors)}};
    http::Response response;
    response.status = problem.status;
    response.contentType = "application/problem+json";
    response.body = dump(body, 2) + "\n";
    response.headers = problem.headers;
    response.set("Cache-Control", "no-store");
    response.logged.emplace_back("code", problem.code);
    return response;
}

}  // namespace farol::server
