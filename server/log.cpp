#include "server/log.h"

#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "server/problem.h"

namespace farol::server {
namespace {

constexpr std::size_t kMostWaiting = std::size_t{1} << 20U;  // bytes of lines

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

void Logger::put(const std::vector<std::string>& lines) const {
    std::string all;
    for (const std::string& line : lines) {
        if (sink_)
            sink_(line);
        else
            all.append(line).append("\n");
    }
    // Nobody could be told that the log cannot be written.
    for (std::string_view rest = all; !rest.empty();) {
        const ssize_t done = ::write(STDERR_FILENO, rest.data(), rest.size());
        if (done < 0 && errno == EINTR) continue;
        if (done < 0) return;
        rest.remove_prefix(static_cast<std::size_t>(done));
    }
}

void Logger::write(std::string line) {
    std::unique_lock lock(mutex_);
    room_.wait(lock, [this] { return waitingBytes_ < kMostWaiting || !isWriting_; });
    waitingBytes_ += line.size();
    waiting_.push_back(std::move(line));
    if (std::exchange(isWriting_, true)) return;
    while (!waiting_.empty()) {
        const std::vector<std::string> lines = std::exchange(waiting_, {});
        const bool wasFull = std::exchange(waitingBytes_, 0) >= kMostWaiting;
        lock.unlock();
        if (wasFull) room_.notify_all();
        put(lines);
        lock.lock();
    }
    isWriting_ = false;
}

}  // namespace farol::server
