#include "server/serve.h"

#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <thread>

#include "core/text.h"
#include "server/animation_probe.h"
#include "server/descriptor_limit.h"
#include "server/http/socket.h"
#include "server/log_writer.h"
#include "server/messages.h"
#include "server/service.h"
#include "server/store/disk_records.h"
#include "server/store/disk_store.h"
#include "server/store/memory_store.h"
#include "server/store/redis_records.h"
#include "server/store/redis_store.h"
#include "worker/pool.h"

namespace farol::server {
namespace {

void checkOptions(const ServeOptions& options) {
    const auto range = [](const char* name, long value, long min, long max) {
        if (value < min || value > max)
            throw Error(message<"option.range/number">("name"_arg = name, "value"_arg = value,
                                                       "min"_arg = min, "max"_arg = max),
                        {}, name);
    };
    range("port", options.listen.port, 0, 65535);
    range("threads", options.listen.threads, 1, 1024);
    range("max-connections", options.maxConnections, 0, 100'000);
    range("max-connections-per-client", options.connectionsPerClient, 0, 100'000);
    range("buffer-bytes", static_cast<long>(options.listen.bufferBytes), 65'536, 1L << 40U);
    range("workers", options.workers, 0, 64);
    range("spares", options.spares, 0, 64);
    range("recycle", options.recycleAfter, 1, 1'000'000);
    if (options.isolate != "none" && options.isolate != "uploads")
        throw Error(
            message<"option.range/words">("name"_arg = "isolate", "value"_arg = options.isolate,
                                          "known"_arg = "none or uploads"),
            {}, "isolate");
    if (!render::kGlSourceWords.find(options.gl))
        throw Error(
            message<"option.range/words">("name"_arg = "gl", "value"_arg = options.gl,
                                          "known"_arg = joined(render::kGlSourceWords.all(), ", ")),
            {}, "gl");
    range("worker-memory", static_cast<long>(options.workerMemoryMiB), 0, 1L << 20);
    range("queue", options.queue.waiting, 0, 10'000);
    range("max-body", static_cast<long>(options.maxBodyBytes), 1, 1L << 30);
    if (!options.storeUrl.empty()) {
        if (!options.dataDir.empty()) throw Error(message<"option.repeated/store">(), {}, "store");
        store::redisAddressOf(options.storeUrl);  // throws for one that cannot be
    }
    std::error_code ignored;
    if (!options.scenesDir.empty() && !std::filesystem::is_directory(options.scenesDir, ignored))
        throw Error(message<"asset.missing/folder">("path"_arg = uncut(options.scenesDir)), {},
                    "scenes");
}

/// Sets the stores of uploads and of assignments; each has the limit for itself.
void openStores(const ServeOptions& options, Logger& logger, ServiceOptions& service) {
    const bool inMemory = options.dataDir.empty() && options.storeUrl.empty();
    store::StoreLimits limits;
    limits.bytes = std::uint64_t{inMemory ? 128U : 1024U} << 20U;
    if (options.storeBytes > 0) limits.bytes = options.storeBytes;
    limits.expire = std::chrono::ceil<std::chrono::seconds>(options.expire);
    const auto log = [&logger](const std::string& message) { logger.event("store", message); };
    if (inMemory) {
        service.store = std::make_shared<store::MemoryStore>(limits);
        service.records = std::make_shared<store::MemoryRecords>(limits.bytes);
    } else if (!options.dataDir.empty()) {
        service.store = std::make_shared<store::DiskStore>(options.dataDir, limits, log);
        service.records = std::make_shared<store::DiskRecords>(options.dataDir, limits.bytes, log);
    } else {
        const store::RedisAddress address = store::redisAddressOf(options.storeUrl);
        service.store = std::make_shared<store::RedisStore>(address, limits, log);
        service.records = std::make_shared<store::RedisRecords>(address, limits.bytes, log);
    }
}

http::ListenOptions listenOptions(const ServeOptions& options, int processes, Logger& logger) {
    http::ListenOptions listen = options.listen;
    const bool isSet = options.maxConnections > 0;
    const int wanted = isSet ? options.maxConnections : listen.maxConnections;
    const std::uint64_t limit = raiseDescriptorLimit();
    listen.maxConnections = connectionsWithin(limit, {listen.threads, processes}, wanted, isSet);
    if (listen.maxConnections < wanted)
        logger.event("descriptors", "max-connections is " + std::to_string(listen.maxConnections) +
                                        " instead of " + std::to_string(wanted) +
                                        ": this process may open " + std::to_string(limit) +
                                        " files (RLIMIT_NOFILE)");
    listen.connectionsPerClient = options.connectionsPerClient;
    // All connections of a proxy have its address.
    if (listen.connectionsPerClient == 0 && !options.rate.trustProxy)
        listen.connectionsPerClient =
            std::max(1, listen.maxConnections - listen.maxConnections / 8);
    return listen;
}

/// Checks --base-path and takes a slash at its end off. Throws Error option.range.
std::string basePathOf(std::string path) {
    while (path.ends_with('/')) path.pop_back();
    const bool isPlain = std::all_of(path.begin(), path.end(), [](char c) {
        return isAlphanumeric(c) || std::string_view("/-._~").find(c) != std::string_view::npos;
    });
    const bool isPath =
        path.empty() || (path.starts_with('/') && isPlain && path.find("//") == std::string::npos &&
                         path.find("/.") == std::string::npos);
    if (!isPath)
        throw Error(message<"option.range/base-path">("value"_arg = path), {}, "base-path");
    return path;
}

std::vector<std::string> allowedHosts(const ServeOptions& options, Logger& logger) {
    std::vector<std::string> hosts;
    std::string_view rest = options.allowedHosts;
    while (!rest.empty()) {
        const std::string_view name = rest.substr(0, rest.find(','));
        rest.remove_prefix(std::min(rest.size(), name.size() + 1));
        hosts.emplace_back(trimmed(name, kLineBlanks));
    }
    if (!hosts.empty()) return hosts;
    const std::string& own = options.listen.host;
    if (http::isLoopback(own))
        return {"localhost", "127.0.0.1", "[::1]",
                own.find(':') == std::string::npos ? own : "[" + own + "]"};
    logger.event("hosts", "any Host header is accepted, since --host " + own +
                              " is not loopback: name the hosts with --allowed-hosts");
    return {};
}

/// Waits for one of the signals; false if there is none within `patience`.
bool waitForSignal(const sigset_t& signals, std::chrono::milliseconds patience) {
    const timespec wait{patience.count() / 1000, patience.count() % 1000 * 1'000'000};
    while (sigtimedwait(&signals, nullptr, &wait) < 0)
        if (errno != EINTR) return false;
    return true;
}

std::string urlOf(const std::string& host, int port) {
    const bool v6 = host.find(':') != std::string::npos;
    return "http://" + (v6 ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

}  // namespace

int serve(const ServeOptions& options) {
    checkOptions(options);
    // Blocked here and so in every thread below; this one waits for them.
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGTERM);
    sigaddset(&signals, SIGINT);
    sigaddset(&signals, SIGHUP);  // its terminal or supervisor has gone: no reason to lose answers
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);  // a write beyond a limit fails, as on a full disk

    AnimationProbe animations;
    worker::PoolOptions pool;
    pool.workers = options.workers;
    if (pool.workers == 0)  // a core each: one picture's work is spread over cores in part only
        pool.workers = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 8);
    pool.spares = options.spares;
    pool.recycleAfter = options.recycleAfter;
    pool.isolatesUploads = options.isolate == "uploads";
    pool.cpu = options.cpu;
    // Two cores have twice the deadline; a quarter of it stays for reading, decoding and encoding.
    constexpr double kDeadlines = 1.5;
    const std::chrono::duration<double> deadline = options.queue.deadline;
    pool.worker.maxCost = options.maxCost > 0 ? options.maxCost : kDeadlines * deadline.count();
    pool.quarantine = std::chrono::ceil<std::chrono::seconds>(options.quarantine);
    pool.worker.gl = *render::kGlSourceWords.find(options.gl);
    pool.worker.memoryBytes = options.workerMemoryMiB << 20U;
    if (!options.scenesDir.empty())
        pool.worker.scenesDir = std::filesystem::absolute(options.scenesDir).string();
    pool.queue = options.queue;
    // A browser opens six connections at once: fewer places than that would refuse its thumbnails.
    if (pool.queue.waiting == 0) pool.queue.waiting = std::max(16, 4 * pool.workers);
    LogWriter log(STDERR_FILENO, {.notice = [](std::uint64_t lines) {
                      return Logger::eventLine("log", std::to_string(lines) +
                                                          " lines before this one were dropped: "
                                                          "the log was not read fast enough");
                  }});
    const Logger::Sink sink = [&log](const std::string& line) { log.write(line); };
    Logger logger(sink);
    const http::ListenOptions listen = listenOptions(options, pool.workers + pool.spares, logger);
    worker::WorkerPool backend(pool,
                               [&logger](const std::string& name, const std::string& message) {
                                   logger.event(name, message);
                               });
    ServiceOptions service;
    service.scenesDir = pool.worker.scenesDir;  // a link in it may lead elsewhere later
    service.maxBodyBytes = options.maxBodyBytes;
    service.cacheBytes = options.cacheBytes;
    service.rate = options.rate;
    service.corsOrigin = options.corsOrigin;
    service.basePath = basePathOf(options.basePath);
    openStores(options, logger, service);
    service.token = options.token;
    service.checkTime = options.checkTime;
    service.allowedHosts = allowedHosts(options, logger);
    service.animations = animations.names();
    service.droppedLogLines = [&log] { return log.dropped(); };
    Service handler(std::move(service), backend, logger);
    http::Listener listener(listen, handler);
    handler.watch([&listener] { return listener.traffic(); });
    listener.start();
    std::printf("listening on %s\n",
                (urlOf(options.listen.host, listener.port()) + handler.basePath()).c_str());
    std::fflush(stdout);

    int received = 0;
    sigwait(&signals, &received);
    handler.drain();
    listener.drain();
    if (options.drain.count() > 0) waitForSignal(signals, options.drain);
    listener.stop();
    backend.stop();
    return 0;
}

}  // namespace farol::server
