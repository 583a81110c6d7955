#include "server/metrics.h"

#include <charconv>

#include "worker/tasks/assignment.h"

namespace farol::server {
namespace {

std::string number(double value) {
    char text[64];
    const auto [end, error] = std::to_chars(text, text + sizeof text, value);
    return error == std::errc() ? std::string(text, end) : "NaN";
}

std::string quoted(const std::string& value) {
    std::string out = "\"";
    for (const char c : value) {
        if (c == '\n') {
            out += "\\n";
            continue;
        }
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + "\"";
}

void head(std::string& out, const char* name, const char* type, const char* help) {
    out.append("# HELP ").append(name).append(" ").append(help).append("\n# TYPE ");
    out.append(name).append(" ").append(type).append("\n");
}

void line(std::string& out, const std::string& name, double value) {
    out.append(name).append(" ").append(number(value)).append("\n");
}

}  // namespace

void Metrics::Histogram::add(double seconds) {
    ++count;
    sumS += seconds;
    for (std::size_t i = 0; i < kBoundsS.size(); ++i)
        if (seconds <= kBoundsS[i]) {
            ++counts[i];
            return;
        }
}

void Metrics::request(std::string_view route, int status, double milliseconds) {
    const std::lock_guard lock(mutex_);
    auto found = routes_.find(route);
    if (found == routes_.end()) found = routes_.emplace(route, RouteCounts{}).first;
    RouteCounts& counts = found->second;
    ++counts.byStatus[status];
    ++counts.count;
    counts.sumS += milliseconds / 1000.0;
    duration_.add(milliseconds / 1000.0);
}

void Metrics::stage(const std::string& stage, double milliseconds) {
    const std::lock_guard lock(mutex_);
    stages_[stage].add(milliseconds / 1000.0);
}

void Metrics::write(std::string& out, const std::string& name, const std::string& label,
                    const Histogram& histogram) {
    const std::string comma = label.empty() ? "" : label + ",";
    std::uint64_t below = 0;
    for (std::size_t i = 0; i < kBoundsS.size(); ++i) {
        below += histogram.counts[i];
        line(out, name + "_bucket{" + comma + "le=\"" + number(kBoundsS[i]) + "\"}",
             static_cast<double>(below));
    }
    const auto count = static_cast<double>(histogram.count);
    const std::string labels = label.empty() ? "" : "{" + label + "}";
    line(out, name + "_bucket{" + comma + "le=\"+Inf\"}", count);
    line(out, name + "_sum" + labels, histogram.sumS);
    line(out, name + "_count" + labels, count);
}

std::string Metrics::text(const worker::BackendState& backend, PictureCache::Counts pictures,
                          bool storeUp, const http::Traffic& traffic, std::uint64_t droppedLogLines,
                          const std::string& version, const std::string& renderer) const {
    std::string out;
    const std::lock_guard lock(mutex_);
    head(out, "farol_http_requests_total", "counter", "Requests answered.");
    for (const auto& [route, counts] : routes_)
        for (const auto& [status, count] : counts.byStatus)
            line(out,
                 "farol_http_requests_total{route=" + quoted(route) + ",code=\"" +
                     std::to_string(status) + "\"}",
                 static_cast<double>(count));
    head(out, "farol_route_duration_seconds", "summary", "Time to answer the requests of a route.");
    for (const auto& [route, counts] : routes_) {
        const std::string label = "{route=" + quoted(route) + "}";
        line(out, "farol_route_duration_seconds_sum" + label, counts.sumS);
        line(out, "farol_route_duration_seconds_count" + label, static_cast<double>(counts.count));
    }
    head(out, "farol_request_duration_seconds", "histogram", "Time to answer a request.");
    write(out, "farol_request_duration_seconds", "", duration_);
    head(out, "farol_stage_duration_seconds", "histogram", "Time of the stages of an image.");
    for (const auto& [stage, histogram] : stages_)
        write(out, "farol_stage_duration_seconds", "stage=" + quoted(stage), histogram);
    head(out, "farol_queue_depth", "gauge", "Jobs that wait for a worker.");
    line(out, "farol_queue_depth", backend.queued);
    head(out, "farol_workers", "gauge", "Worker processes that can draw.");
    line(out, "farol_workers", backend.workers);
    head(out, "farol_workers_busy", "gauge", "Workers with a job.");
    line(out, "farol_workers_busy", backend.busy);
    head(out, "farol_worker_restarts_total", "counter", "Workers replaced, by reason.");
    for (const char* reason : {"busy", "cpu", "crash", "deadline", "folder", "idle", "isolated",
                               "killed", "memory", "recycled", "reply", "stalled"}) {
        const auto found = backend.restarts.find(reason);
        line(out, "farol_worker_restarts_total{reason=" + quoted(reason) + "}",
             found == backend.restarts.end() ? 0.0 : static_cast<double>(found->second));
    }
    head(out, "farol_coalesced_requests_total", "counter",
         "Images answered by one that was being drawn.");
    line(out, "farol_coalesced_requests_total", static_cast<double>(backend.coalesced));
    head(out, "farol_retried_jobs_total", "counter",
         "Jobs begun again because somebody killed their worker.");
    line(out, "farol_retried_jobs_total", static_cast<double>(backend.retried));
    head(out, "farol_superseded_requests_total", "counter",
         "Frames that a newer one of their session overtook.");
    line(out, "farol_superseded_requests_total", static_cast<double>(backend.superseded));
    head(out, "farol_jobs_total", "counter", "Jobs of workers, by kind and how they ended.");
    for (const auto& [task, counts] : backend.jobs) {
        const std::string name = "farol_jobs_total{task=" + quoted(task) + ",outcome=";
        line(out, name + "\"done\"}", static_cast<double>(counts.done));
        line(out, name + "\"refused\"}", static_cast<double>(counts.refused));
        line(out, name + "\"failed\"}", static_cast<double>(counts.failed));
    }
    head(out, "farol_job_duration_seconds", "summary", "Time in a worker of jobs that were done.");
    for (const auto& [task, counts] : backend.jobs) {
        // Its time depends on the hidden reference, and students may read this page.
        if (task == worker::AssignmentTask::kName) continue;
        const std::string label = "{task=" + quoted(task) + "}";
        line(out, "farol_job_duration_seconds_sum" + label, counts.seconds);
        line(out, "farol_job_duration_seconds_count" + label, static_cast<double>(counts.done));
    }
    head(out, "farol_cache_requests_total", "counter", "Images looked for among those sent.");
    line(out, "farol_cache_requests_total{cache=\"picture\",result=\"hit\"}",
         static_cast<double>(pictures.hits));
    line(out, "farol_cache_requests_total{cache=\"picture\",result=\"miss\"}",
         static_cast<double>(pictures.misses));
    head(out, "farol_http_connections", "gauge", "Connections, by what they do.");
    const auto labelled = [&](const std::string& name, const std::string& label, long value) {
        line(out, name + "{" + label + "}", static_cast<double>(value));
    };
    const std::string now = "farol_http_connections";
    labelled(now, R"(state="idle")", traffic.idle);
    labelled(now, R"(state="receiving")", traffic.receiving);
    labelled(now, R"(state="active")", traffic.active);
    labelled(now, R"(state="sending")", traffic.sending);
    head(out, "farol_http_connections_closed_total", "counter",
         "Connections ended by the service, by what the client did or what was "
         "full.");
    const std::string closed = "farol_http_connections_closed_total";
    labelled(closed, R"(reason="slow_head")", traffic.slowHead);
    labelled(closed, R"(reason="slow_body")", traffic.slowBody);
    labelled(closed, R"(reason="slow_reader")", traffic.slowReader);
    labelled(closed, R"(reason="buffers_full")", traffic.memory);
    labelled(closed, R"(reason="connections_full")", traffic.full);
    labelled(closed, R"(reason="client_full")", traffic.clientFull);
    labelled(closed, R"(reason="displaced")", traffic.displaced);
    head(out, "farol_http_buffered_bytes", "gauge",
         "Of requests that arrive and answers that wait for their clients.");
    line(out, "farol_http_buffered_bytes", static_cast<double>(traffic.bufferedBytes));
    head(out, "farol_log_lines_dropped_total", "counter",
         "Lines of the log that could not be written.");
    line(out, "farol_log_lines_dropped_total", static_cast<double>(droppedLogLines));
    head(out, "farol_store_up", "gauge", "Whether the store of uploads could be asked last time.");
    line(out, "farol_store_up", storeUp ? 1 : 0);
    head(out, "farol_build_info", "gauge", "What is running.");
    line(out, "farol_build_info{version=" + quoted(version) + ",renderer=" + quoted(renderer) + "}",
         1);
    return out;
}

}  // namespace farol::server
