#include "server/service.h"

#include <new>
#include <system_error>

#include "server/messages.h"
#include "server/problem_picture.h"
#include "server/request/media.h"
#include "server/request/token.h"
#include "server/routes/table.h"

namespace farol::server {

namespace {

// A scene's source is XML from strangers: a browser that opens it must not run its scripts.
constexpr const char* kDataPolicy = "default-src 'none'; frame-ancestors 'none'; sandbox";

constexpr std::chrono::milliseconds kRefusalHold{200};
// Bodies of the largest size that one client may have in memory at once.
constexpr std::size_t kBodiesOfOne = 4;
constexpr std::chrono::seconds kSweep{60};

void checkToken(const Route& route, const http::Request& request, const std::string& token) {
    if (route.traits.isWriting) requireToken(request, token);
    if (route.traits.isTeachers) requireTeacher(request, token);
}

}  // namespace

Service::Service(ServiceOptions options, worker::Backend& backend, Logger& logger)
    : context_(std::move(options), backend, logger),
      limiter_(context_.options.rate),
      bodies_(kBodiesOfOne * context_.options.maxBodyBytes),
      guard_(context_.options.allowedHosts, context_.options.corsOrigin),
      router_(routes()) {}

http::Request Service::inside(const http::Request& request) const {
    http::Request inner = request;
    const std::string& base = context_.options.basePath;
    if (!base.empty() && inner.path.starts_with(base + "/")) inner.path.erase(0, base.size());
    return inner;
}

std::size_t Service::bodyLimit(const http::Request& whole) const {
    const http::Request request = inside(whole);
    const Route* route = router_.find(request);
    if (route == nullptr) return 0;
    try {
        guard_.check(request);
        checkToken(*route, request, context_.options.token);
    } catch (const Error&) {
        return 0;
    }
    return context_.options.maxBodyBytes;
}

http::Response Service::handle(const http::Request& whole, http::Body& body) {
    const std::string& base = context_.options.basePath;
    if (base.empty() || whole.path != base) return answer(inside(whole), body);
    // The page's URLs are relative to it: they need the slash.
    http::Response response;
    response.status = 308;
    response.set("Location", base + "/");
    finish(whole, response);
    return response;
}

http::Response Service::answer(const http::Request& request, http::Body& body) {
    const ServiceOptions& options = context_.options;
    http::Response response;
    bool isAdmitted = false;
    try {
        guard_.check(request);
        isAdmitted = true;
        if (limiter_.isOn() && request.path.starts_with("/v1/"))
            limiter_.admit(clientOf(request, options.rate.trustProxy));
        if (const Route* route = router_.find(request); route != nullptr)
            checkToken(*route, request, options.token);
        CountedBody counted(body, bodies_, clientOf(request, options.rate.trustProxy));
        response = router_.route(context_, request, counted);
    } catch (...) {
        const Problem problem = problemOfCurrent(request);
        response = problemResponse(problem, request.id, languageOf(request));
        if (isAdmitted && router_.drawsProblem(request.path))
            drawProblem(context_, request, problem, response);
    }
    finish(request, response);
    return response;
}

Problem Service::problemOfCurrent(const http::Request& request) {
    Problem problem;
    const auto shortOf = [&](const std::string& what) {
        context_.logger.event("resources", request.id + ": " + what);
        problem = problemOf(503, message<"busy.resources">());
        problem.headers = {{"Retry-After", "5"}};
    };
    try {
        throw;
    } catch (const ProblemException& known) {
        problem = known.problem();
    } catch (const Error& error) {
        problem = problemOf(error);
        if (problem.status == 405)
            problem.headers.emplace_back("Allow", router_.allowed(request.path));
        if (problem.code == "http.media-type")
            problem.headers.emplace_back("Accept-Post",
                                         "application/xml, text/xml, multipart/form-data, "
                                         "application/zip, application/x-tar, application/gzip, "
                                         "application/x-7z-compressed, application/vnd.rar");
        if (problem.status == 401)
            problem.headers.emplace_back("WWW-Authenticate", "Bearer realm=\"farol\"");
    } catch (const worker::Busy& busy) {
        problem = problemOf(busy);
        // Delays refusals so that immediate retries do not starve renders.
        if (busy.code() == "busy.queue" && request.path.starts_with("/v1/"))
            problem.hold = kRefusalHold;
    } catch (const std::bad_alloc&) {
        shortOf("memory");
    } catch (const std::system_error& fault) {
        shortOf(fault.what());
    } catch (const std::exception& fault) {
        // The details are for the operator; the client gets the request id.
        context_.logger.event("internal-error", request.id + ": " + fault.what());
        problem = problemOf(500, message<"internal">());
    }
    return problem;
}

http::Response Service::refuse(const http::Request& request, int status, const Message& message) {
    http::Response response =
        problemResponse(problemOf(status, message), request.id, languageOf(request));
    finish(request, response);
    return response;
}

void Service::finish(const http::Request& request, http::Response& response) const {
    const auto has = [&](const char* name) {
        for (const auto& [key, value] : response.headers)
            if (key == name) return true;
        return false;
    };
    response.set("X-Request-Id", request.id);
    response.set("X-Content-Type-Options", "nosniff");
    response.set("Referrer-Policy", "no-referrer");
    if (!has("Content-Security-Policy")) response.set("Content-Security-Policy", kDataPolicy);
    if (!has("Cache-Control")) response.set("Cache-Control", "no-cache");
    if (context_.options.corsOrigin.empty()) return;
    response.set("Access-Control-Allow-Origin", context_.options.corsOrigin);
    response.set("Access-Control-Expose-Headers",
                 "ETag, Location, Server-Timing, X-Request-Id, X-Farol-Stats, "
                 "X-Farol-Quality, "
                 "X-Farol-Camera, "
                 "X-Farol-Diagnostics, Retry-After");
    if (request.method == "OPTIONS") {
        response.set("Access-Control-Allow-Methods", "GET, HEAD, POST, PUT, DELETE, OPTIONS");
        response.set("Access-Control-Allow-Headers",
                     "Content-Type, If-None-Match, Authorization, X-Request-Id");
        response.set("Access-Control-Max-Age", "600");
    }
}

void Service::finished(const http::Request& request, const http::Response& response,
                       double milliseconds, bool sent) {
    const std::string_view route = router_.patternOf(inside(request).path);
    context_.metrics.request(route.empty() ? "none" : route, response.status, milliseconds);
    context_.logger.request(request, response, milliseconds, sent);
    sweep();
}

void Service::sweep() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
    auto last = swept_.load();
    const auto pause = std::chrono::duration_cast<std::chrono::steady_clock::duration>(kSweep);
    if (now - last < pause.count() || !swept_.compare_exchange_strong(last, now)) return;
    if (const std::size_t gone = context_.store.expire(); gone > 0)
        context_.logger.event("expired", std::to_string(gone) + " scenes");
    try {
        if (const std::size_t gone = context_.assignments.expire(); gone > 0)
            context_.logger.event("expired", std::to_string(gone) + " records");
    } catch (const std::exception& fault) {  // the next sweep tries again
        context_.logger.event("store", fault.what());
    }
}

}  // namespace farol::server
