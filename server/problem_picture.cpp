#include "server/problem_picture.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/text.h"
#include "server/json.h"
#include "server/request/media.h"
#include "worker/tasks/notice.h"

namespace farol::server {
namespace {

std::string noticeOf(const Problem& problem, const Diagnostics& errors) {
    constexpr std::size_t kMaxErrors = 8;
    std::string text = std::to_string(problem.status) + " " + statusTitle(problem.status) + "\n\n";
    for (std::size_t i = 0; i < std::min(errors.size(), kMaxErrors); ++i) {
        const Diagnostic& error = errors[i];
        const Location& where = error.where;
        if (where.line > 0)
            text += where.file + ":" + std::to_string(where.line) + ":" +
                    std::to_string(std::max(0, where.column)) + ": ";
        text += error.message + " [" + error.code + "]\n";
    }
    return toUtf8(text);
}

/// Returns the size and format of the request as far as they are valid: one of them may be the
/// fault.
Parameters shapeOf(const http::Request& request) {
    Parameters wanted;
    for (const auto& [name, value] : request.query) {
        if (name != "width" && name != "height" && name != "format") continue;
        try {
            render::applyOption(wanted.picture, name, value);
        } catch (const Error&) {  // keeps the default
        }
        wanted.formatGiven = wanted.formatGiven || name == "format";
    }
    chooseFormat(wanted, request.header("accept"));
    return wanted;
}

}  // namespace

void drawProblem(Context& context, const http::Request& request, const Problem& problem,
                 http::Response& response) {
    const auto wants = [](const auto& field) {
        return field.first == "onerror" && field.second == "image";
    };
    if (std::none_of(request.query.begin(), request.query.end(), wants)) return;
    try {
        const Diagnostics errors = errorsOf(problem);
        auto done = context.backend.run<worker::NoticeTask>(
            {noticeOf(problem, errors), shapeOf(request).picture});
        // An image is the same in all languages: its text is English.
        std::erase_if(response.headers, [](const auto& field) {
            return field.first == "Content-Language" || field.first == "Vary";
        });
        response.contentType = done.result.contentType;
        response.body = std::move(done.result.bytes);
        response.set("X-Farol-Diagnostics", diagnosticsHeader(errors));
    } catch (const std::exception&) {
        // No worker is free, or no format is acceptable: sends the problem document itself.
    }
}

}  // namespace farol::server
