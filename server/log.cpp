#include "server/log.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>

#include "server/problem.h"

namespace farol::server {
namespace {

std::string timestamp() {
    const auto now = std::chrono::system_clock::now();
    const std::time_t seconds = std::chrono::system_clock::to_time_t(now);
    const auto ms =
        std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch()).count() %
        1000;
    std::tm utc{};
    gmtime_r(&seconds, &utc);
    char text[64];
    std::snprintf(text, sizeof text, "%04d-%02d-%02dT%02d:%02d:%02d.%03dZ", utc.tm_year + 1900,
                  utc.tm_mon + 1, utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec,
                  static_cast<int>(ms));
    return text;
}

}  // namespace

Logger::Logger(Sink sink) : sink_(std::move(sink)) {}

void Logger::request(const http::Request& request, const http::Response& response,
                     double milliseconds, bool sent) {
    nlohmann::ordered_json line = {{"time", timestamp()},
                                   {"requestId", request.id},
                                   {"remote", request.remoteAddress},
                                   {"method", request.method},
                                   {"path", request.path},
                                   {"status", response.status},
                                   {"ms", std::round(milliseconds * 1000.0) / 1000.0}};
    const auto numberOrText = [](const std::string& value) {
        const auto parsed = nlohmann::ordered_json::parse(value, nullptr, false);
        return parsed.is_number() ? parsed : nlohmann::ordered_json(value);
    };
    for (const auto& [name, value] : response.headers)
        if (name == "Content-Length") line["bytes"] = numberOrText(value);
    for (const auto& [name, value] : response.logged) line[name] = numberOrText(value);
    if (!sent) line["sent"] = false;
    write(line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void Logger::event(const std::string& name, const std::string& message) {
    const nlohmann::ordered_json line = {
        {"time", timestamp()}, {"event", name}, {"message", message}};
    write(line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

void Logger::write(const std::string& line) {
    const std::lock_guard lock(mutex_);
    if (sink_)
        sink_(line);
    else
        std::fprintf(stderr, "%s\n", line.c_str());
}

}  // namespace farol::server
