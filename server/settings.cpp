#include "server/settings.h"

#include "core/number.h"
#include "core/text.h"
#include "render/gl_source.h"

namespace farol::server {
namespace {

constexpr double kMinTimeS = 0.001, kMaxTimeS = 86'400.0;

Setting number(const std::string& name, const std::string& help, double min, double max,
               SettingTarget (*target)(ServeOptions&)) {
    return {name, help, min, max, "", {}, target};
}

Setting text(const std::string& name, const std::string& help, const std::string& form,
             SettingTarget (*target)(ServeOptions&), const std::vector<std::string>& words = {}) {
    return {name, help, 0, 0, form, words, target};
}

Setting flag(const std::string& name, const std::string& help,
             SettingTarget (*target)(ServeOptions&)) {
    return {name, help, 0, 0, "", {}, target};
}

#define FIELD(path) [](ServeOptions& options) -> SettingTarget { return &options.path; }

std::vector<Setting> makeSettings() {
    return {
        text("host", "address to listen on", "ADDRESS", FIELD(listen.host)),
        number("port", "port to listen on; 0: any free one", 0, 65'535, FIELD(listen.port)),
        text("scenes", "folder of scenes to serve; default none", "DIR", FIELD(scenesDir)),
        number("workers", "processes that draw; 0: one a core, at most 8", 0, 64, FIELD(workers)),
        number("spares", "processes kept ready to take the place of a lost one", 0, 64,
               FIELD(spares)),
        number("recycle", "jobs a process does before it is replaced", 1, 1'000'000,
               FIELD(recycleAfter)),
        number("worker-memory", "memory of a process, MiB; 0: no cap", 0, 1 << 20,
               FIELD(workerMemoryMiB)),
        text("gl",
             "library that draws: OSMesa or EGL, by the processor, or EGL on a GPU; auto: OSMesa "
             "where it is installed, else EGL",
             joined(render::kGlSourceWords.all(), "|"), FIELD(gl),
             {"auto", "osmesa", "egl", "egl:gpu"}),
        text("isolate", "uploads: a process ends after each job of an upload; none: it goes on",
             "none|uploads", FIELD(isolate), {"none", "uploads"}),
        number("quarantine",
               "how long a request that ended two processes, or a scene that three requests "
               "crashed, is refused, s",
               kMinTimeS, kMaxTimeS, FIELD(quarantine)),
        number("queue", "requests that may wait for a worker; 0: four a worker, at least 16", 0,
               10'000, FIELD(queue.waiting)),
        number("wait", "longest wait for a worker, s", kMinTimeS, kMaxTimeS, FIELD(queue.wait)),
        number("deadline", "longest time for a request, s", kMinTimeS, kMaxTimeS,
               FIELD(queue.deadline)),
        number("cpu", "most processor time of a process for a request, s; 0: twice the deadline",
               0.0, kMaxTimeS, FIELD(cpu)),
        number("max-cost",
               "largest estimated cost of a request, core-seconds; 0: 1.5 times the deadline", 0,
               1e6, FIELD(maxCost)),
        number("max-body", "largest request body, bytes", 1, 1 << 30, FIELD(maxBodyBytes)),
        number("threads", "requests handled at once", 1, 1024, FIELD(listen.threads)),
        number("max-connections",
               "connections at once; 0: 1024, or fewer where the descriptors are", 0, 100'000,
               FIELD(maxConnections)),
        number("max-connections-per-client",
               "of one address (IPv6: /64); 0: seven eighths of them, all with --trust-proxy", 0,
               100'000, FIELD(connectionsPerClient)),
        number("keep-alive", "how long a connection may be idle, s", kMinTimeS, kMaxTimeS,
               FIELD(listen.keepAlive)),
        number("head-timeout", "how long the head of a request may take to arrive, s", kMinTimeS,
               kMaxTimeS, FIELD(listen.timeouts.head)),
        number("body-timeout", "how long the body of a request may take to arrive, s", kMinTimeS,
               kMaxTimeS, FIELD(listen.timeouts.body)),
        number("write-timeout", "how long a client may take to read an answer, s", kMinTimeS,
               kMaxTimeS, FIELD(listen.timeouts.write)),
        number("buffer-bytes",
               "memory for requests that arrive and answers that are read slowly, bytes; beyond, "
               "the slowest clients are dropped",
               65'536, 1LL << 40U, FIELD(listen.bufferBytes)),
        number("grace", "how long running requests may take after SIGTERM, s", kMinTimeS, kMaxTimeS,
               FIELD(listen.timeouts.grace)),
        number("drain", "how long the service keeps serving, unready, after SIGTERM, s", 0.0,
               3'600.0, FIELD(drain)),
        text("allowed-hosts",
             "names that clients may use for the service, comma-separated; * any; default: "
             "loopback names and --host where that is loopback, else any",
             "HOSTS", FIELD(allowedHosts)),
        text(
            "cors",
            "origin whose pages may call the service and show /embed in frames, or *; default none",
            "ORIGIN", FIELD(corsOrigin)),
        text("base-path", "what stands before all paths, behind a proxy: /farol; default nothing",
             "PATH", FIELD(basePath)),
        text("data", "folder to keep uploaded scenes in; default: in memory, until the end", "DIR",
             FIELD(dataDir)),
        text("store",
             "a Redis to keep them in, shared with other services: "
             "redis://[user:password@]host[:port][/database]",
             "URL", FIELD(storeUrl)),
        number("store-bytes",
               "of uploaded scenes, bytes; 0: 1 GiB with --data or --store, else 128 MiB", 0, 1e15,
               FIELD(storeBytes)),
        number("expire", "how long an uploaded scene is kept, s; 0: for good", 0.0, 1e9,
               FIELD(expire)),
        text("token", "what storing and deleting needs: \"Authorization: Bearer TOKEN\"", "TOKEN",
             FIELD(token)),
        number("check-time",
               "answers to students' checks of an assignment leave at multiples of it after the "
               "request, s",
               kMinTimeS, 60.0, FIELD(checkTime)),
        number("cache-bytes", "memory for images that were sent, bytes; 0: none", 0, 1LL << 40U,
               FIELD(cacheBytes)),
        number("rate", "requests of one client a second; 0: no limit", 0, 1e6,
               FIELD(rate.perSecond)),
        number("burst",
               "requests of one client at once, after a pause; 0: two seconds' worth, at least 20",
               0, 1'000'000, FIELD(rate.burst)),
        flag("trust-proxy", "a client is the last address of X-Forwarded-For: only behind a proxy",
             FIELD(rate.trustProxy)),
    };
}

#undef FIELD

std::string textOf(int value) { return std::to_string(value); }
std::string textOf(std::uint64_t value) { return std::to_string(value); }
std::string textOf(double value) { return formatNumber(value); }
std::string textOf(bool) { return ""; }
std::string textOf(const std::string& value) { return value; }
std::string textOf(std::chrono::milliseconds value) {
    return formatNumber(static_cast<double>(value.count()) / 1000.0);
}

}  // namespace

std::span<const Setting> settings() {
    static const std::vector<Setting> kSettings = makeSettings();
    return kSettings;
}

std::string defaultText(const Setting& setting) {
    ServeOptions options;
    return std::visit([](const auto* value) { return textOf(*value); }, setting.target(options));
}

}  // namespace farol::server
