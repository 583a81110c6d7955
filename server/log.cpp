#include "server/log.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>
#include <utility>
#include <variant>

#include "core/bounded_json.h"

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

double toMicroseconds(double milliseconds) { return std::round(milliseconds * 1000.0) / 1000.0; }

Logger::Logger(Sink sink) : sink_(std::move(sink)) {}

void Logger::request(const http::Request& request, const http::Response& response,
                     double milliseconds, bool sent) {
    nlohmann::ordered_json line = {{"time", timestamp()},
                                   {"requestId", request.id},
                                   {"remote", request.remoteAddress},
                                   {"method", request.method},
                                   {"path", request.path},
                                   {"status", response.status},
                                   {"ms", toMicroseconds(milliseconds)}};
    for (const auto& [name, value] : response.logged)
        std::visit([&line, &name = name](const auto& plain) { line[name] = plain; }, value);
    if (!sent) line["sent"] = false;
    write(dumpJson(line));
}

std::string Logger::eventLine(const std::string& name, const std::string& message) {
    const nlohmann::ordered_json line = {
        {"time", timestamp()}, {"event", name}, {"message", message}};
    return dumpJson(line);
}

void Logger::event(const std::string& name, const std::string& message) {
    write(eventLine(name, message));
}

void Logger::write(const std::string& line) {
    if (!sink_) return;
    const std::lock_guard lock(mutex_);
    sink_(line);
}

}  // namespace farol::server
