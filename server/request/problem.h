#pragma once

#include <chrono>
#include <exception>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "core/code_status.h"
#include "core/error.h"
#include "core/language.h"
#include "server/http/message.h"
#include "worker/backend.h"

/// Errors as clients see them: RFC 9457 problem documents, one for every failure.
namespace farol::server {

/// "Bad Request" and so on.
std::string statusTitle(int status);

struct Problem {
    int status = 500;
    std::string code = "internal";
    std::string detail;
    Diagnostics diagnostics;            ///< at least one
    http::Fields headers;               ///< Allow, Retry-After, ...
    std::chrono::milliseconds hold{0};  ///< delay of the response
};

Problem problemOf(const Error& error);
Problem problemOf(const worker::Busy& busy);
Problem problemOf(int status, Message message);

/// A problem document that no Error describes.
class ProblemException : public std::exception {
  public:
    explicit ProblemException(Problem problem) : problem_(std::move(problem)) {}
    const Problem& problem() const { return problem_; }
    const char* what() const noexcept override { return problem_.detail.c_str(); }

  private:
    Problem problem_;
};

/// Returns the diagnostics of the document: all but the infos, at least one.
Diagnostics errorsOf(const Problem& problem);

/// Returns the response with the problem document. Precondition: problem.status is 400..599.
http::Response problemResponse(const Problem& problem, const std::string& requestId,
                               Language language = Language::en);

/// [{code,severity,file,line,column,message,field}]; unknown members are left out.
nlohmann::json toJson(const Diagnostics& diagnostics, Language language = Language::en);

/// Sets `member` to the findings, at most kMaxFindings with a note of how many are left out, and
/// `member`Total to the number of all.
void setDiagnostics(nlohmann::json& object, const std::string& member, Diagnostics diagnostics,
                    Language language = Language::en);

/// Returns the diagnostics without infos.
Diagnostics notable(const Diagnostics& diagnostics);

/// UTF-8 text; invalid bytes become U+FFFD instead of an exception.
std::string dump(const nlohmann::json& value, int indent = -1);

}  // namespace farol::server
