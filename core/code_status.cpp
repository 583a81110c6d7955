#include "core/code_status.h"

#include <map>

namespace farol {

int statusOf(const std::string& code) {
    static const std::map<std::string, int> kExact = {
        {"http.not-found", 404},      {"http.method", 405},
        {"http.unauthorized", 401},   {"limit.store", 413},
        {"store.full", 503},          {"store.failed", 503},
        {"http.not-acceptable", 406}, {"http.length-required", 411},
        {"limit.body", 413},          {"http.uri-too-long", 414},
        {"http.media-type", 415},     {"http.content-encoding", 415},
        {"busy.connections", 503},    {"busy.queue", 503},
        {"busy.deadline", 503},       {"busy.draining", 503},
        {"limit.client", 429},        {"worker.crashed", 503},
        {"worker.killed", 503},       {"worker.quarantine", 503},
        {"worker.reply", 503},        {"busy.superseded", 409},
        {"limit.rate", 429},          {"grade.no-submission", 400},
        {"grade.no-reference", 400},  {"not-ready", 503},
        {"store.unreachable", 503},   {"http.cross-site", 403},
        {"http.host-unknown", 421},   {"busy.scenes", 503},
        {"busy.resources", 503},      {"option.unavailable", 422},
        {"assignment.no-token", 403}, {"assignment.closed", 403},
        {"assignment.code", 401},     {"assignment.tries", 429},
        {"assignment.failed", 503},   {"busy.cancelled", 503},
    };
    if (const auto found = kExact.find(code); found != kExact.end()) return found->second;
    for (const char* family : {"option.", "http.", "xml.", "bundle."})
        if (code.starts_with(family)) return 400;
    return 422;
}

}  // namespace farol
