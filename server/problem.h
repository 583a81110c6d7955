#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "scene/error.h"
#include "server/http/message.h"

/// Errors as clients see them: RFC 9457 problem documents, one for every failure.
namespace farol::server {

/// The status of a caller's fault by the family of its code: option.*, http.*, xml.* and bundle.*
/// 400 (unless listed otherwise), limit.body and limit.store 413, everything else 422.
int statusOf(const std::string& code);

/// "Bad Request" and so on.
std::string statusTitle(int status);

struct Problem {
    int status = 500;
    std::string code = "internal";
    std::string detail;
    Diagnostics diagnostics;  ///< empty: one is made of code and detail
    http::Fields headers;     ///< Allow, Retry-After, ...
};

Problem problemOf(const Error& error);

/// The answer. Precondition: problem.status is 400..599.
http::Response problemResponse(const Problem& problem, const std::string& requestId);

/// [{code,severity,file,line,column,message,field}]; what is unknown is left out.
nlohmann::json toJson(const Diagnostics& diagnostics);

/// Those that a client should look at: without the infos.
Diagnostics notable(const Diagnostics& diagnostics);

/// UTF-8 text; invalid bytes become U+FFFD instead of an exception.
std::string dump(const nlohmann::json& value, int indent = -1);

}  // namespace farol::server
