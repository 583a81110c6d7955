#include "server/serve.h"

#include <pthread.h>
#include <signal.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "server/server.h"
#include "server/store/disk_store.h"
#include "server/store/memory_store.h"
#include "server/store/redis_store.h"
#include "server/worker/pool.h"

namespace farol::server {
namespace {

void checkOptions(const ServeOptions& options) {
    const auto range = [](const char* name, long value, long min, long max) {
        if (value < min || value > max)
            throw Error("option.range",
                        std::string(name) + " must be in " + std::to_string(min) + ".." +
                            std::to_string(max) + ", not " + std::to_string(value),
                        {}, name);
    };
    range("port", options.listen.port, 0, 65535);
    range("threads", options.listen.threads, 1, 1024);
    range("max-connections", options.listen.maxConnections, 1, 100'000);
    range("buffer-bytes", static_cast<long>(options.listen.bufferBytes), 65'536, 1L << 40U);
    range("workers", options.workers, 0, 64);
    range("spares", options.spares, 0, 64);
    range("recycle", options.recycleAfter, 1, 1'000'000);
    range("worker-memory", static_cast<long>(options.workerMemoryMiB), 0, 1L << 20);
    range("queue", options.queue.waiting, 0, 10'000);
    range("max-body", static_cast<long>(options.maxBodyBytes), 1, 1L << 30);
    if (!options.storeUrl.empty()) {
        if (!options.dataDir.empty())
            throw Error("option.repeated",
                        "data and store both say where uploaded scenes are kept: give one", {},
                        "store");
        store::redisAddressOf(options.storeUrl);  // throws for one that cannot be
    }
    std::error_code ignored;
    if (!options.scenesDir.empty() && !std::filesystem::is_directory(options.scenesDir, ignored))
        throw Error("asset.missing", "there is no folder " + options.scenesDir, {}, "scenes");
}

std::shared_ptr<store::SceneStore> openStore(const ServeOptions& options, Logger& logger) {
    const bool inMemory = options.dataDir.empty() && options.storeUrl.empty();
    store::StoreLimits limits;
    limits.bytes = std::uint64_t{inMemory ? 128U : 1024U} << 20U;
    if (options.storeBytes > 0) limits.bytes = options.storeBytes;
    limits.expire = std::chrono::ceil<std::chrono::seconds>(options.expire);
    if (inMemory) return std::make_shared<store::MemoryStore>(limits);
    const auto log = [&logger](const std::string& message) { logger.event("store", message); };
    if (!options.dataDir.empty())
        return std::make_shared<store::DiskStore>(options.dataDir, limits, log);
    return std::make_shared<store::RedisStore>(store::redisAddressOf(options.storeUrl), limits,
                                               log);
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
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);  // a write beyond a limit fails, as on a full disk

    worker::PoolOptions pool;
    pool.workers = options.workers;
    if (pool.workers == 0)  // a core each: one picture's work is spread over cores in part only
        pool.workers = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 8);
    pool.spares = options.spares;
    pool.recycleAfter = options.recycleAfter;
    pool.quarantine = std::chrono::ceil<std::chrono::seconds>(options.quarantine);
    pool.worker.memoryBytes = options.workerMemoryMiB << 20U;
    if (!options.scenesDir.empty())
        pool.worker.scenesDir = std::filesystem::canonical(options.scenesDir).string();
    pool.queue = options.queue;
    // A browser opens six connections at once: fewer places than that would refuse its thumbnails.
    if (pool.queue.waiting == 0) pool.queue.waiting = std::max(16, 4 * pool.workers);
    Logger logger;
    worker::WorkerPool backend(pool, logger);
    ServiceOptions service;
    service.scenesDir = options.scenesDir;
    service.maxBodyBytes = options.maxBodyBytes;
    service.cacheBytes = options.cacheBytes;
    service.rate = options.rate;
    service.corsOrigin = options.corsOrigin;
    service.store = openStore(options, logger);
    service.token = options.token;
    Server server(options.listen, service, backend);
    server.start();
    std::printf("listening on %s\n", urlOf(options.listen.host, server.port()).c_str());
    std::fflush(stdout);

    int received = 0;
    sigwait(&signals, &received);
    server.stop();
    backend.stop();
    return 0;
}

}  // namespace farol::server
