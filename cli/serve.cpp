#include "server/serve.h"

#include <malloc.h>

#include <memory>

#include "cli/command.h"
#include "cli/settings.h"

namespace farol::cli {
namespace {

/// Times are read as seconds and become the server's milliseconds.
void addSeconds(CLI::App& command, const std::string& name, std::chrono::milliseconds& into,
                const std::string& help, double min = 0.001, double max = 86'400.0) {
    const auto set = [&into](double seconds) {
        into = std::chrono::milliseconds(static_cast<std::int64_t>(seconds * 1000.0));
    };
    CLI::Option* option = command.add_option_function<double>(name, set, help);
    takesNumber(option, min, max);
    option->default_str(std::to_string(into.count() / 1000));
}

int run(const server::ServeOptions& options) {
    // Pictures are made by one thread and dropped by another: with a heap for each thread, there
    // are holes in all of them. Answers from the cache are no slower for it.
    ::mallopt(M_ARENA_MAX, 2);
    try {
        return server::serve(options) == 0 ? kDone : kInternal;
    } catch (const Error& error) {
        throw UsageError(error.what(), error.code());  // all that serve is told are its flags
    }
}

}  // namespace

void addServe(CLI::App& root, Action& action) {
    CLI::App* command = root.add_subcommand("serve", "Answers HTTP requests until SIGTERM or ^C");
    const auto options = std::make_shared<server::ServeOptions>();
    const auto add = [&](const std::string& name, auto& value, const std::string& help, double min,
                         double max) {
        takesNumber(command->add_option(name, value, help), min, max);
    };
    command->add_option("--host", options->listen.host, "address to listen on")
        ->type_name("ADDRESS")
        ->capture_default_str();
    add("--port", options->listen.port, "port to listen on; 0: any free one", 0, 65'535);
    command->add_option("--scenes", options->scenesDir, "folder of scenes to serve; default none")
        ->type_name("DIR");
    add("--workers", options->workers, "processes that draw; 0: one a core, at most 8", 0, 64);
    add("--spares", options->spares, "processes kept ready to take the place of a lost one", 0, 64);
    add("--recycle", options->recycleAfter, "jobs a process does before it is replaced", 1,
        1'000'000);
    add("--worker-memory", options->workerMemoryMiB, "memory of a process, MiB; 0: no cap", 0,
        1 << 20);
    addSeconds(*command, "--quarantine", options->quarantine,
               "how long a scene that ended two processes is refused, s");
    add("--queue", options->queue.waiting,
        "requests that may wait for a worker; 0: four a worker, at least 16", 0, 10'000);
    addSeconds(*command, "--wait", options->queue.wait, "longest wait for a worker, s");
    addSeconds(*command, "--deadline", options->queue.deadline, "longest time for a request, s");
    add("--max-body", options->maxBodyBytes, "largest request body, bytes", 1, 1 << 30);
    add("--threads", options->listen.threads, "requests handled at once", 1, 1024);
    add("--max-connections", options->listen.maxConnections, "clients at once", 1, 100'000);
    addSeconds(*command, "--keep-alive", options->listen.keepAlive,
               "how long a connection may be idle, s");
    addSeconds(*command, "--head-timeout", options->listen.timeouts.head,
               "how long the head of a request may take to arrive, s");
    addSeconds(*command, "--body-timeout", options->listen.timeouts.body,
               "how long the body of a request may take to arrive, s");
    addSeconds(*command, "--write-timeout", options->listen.timeouts.write,
               "how long a client may take to read an answer, s");
    add("--buffer-bytes", options->listen.bufferBytes,
        "memory for requests that arrive and answers that are read slowly, bytes; beyond, the "
        "slowest clients are dropped",
        65'536, 1LL << 40U);
    addSeconds(*command, "--grace", options->listen.timeouts.grace,
               "how long requests that have begun may take once the service is told to end, s");
    command
        ->add_option("--cors", options->corsOrigin,
                     "origin whose pages may call the service, or *; default none")
        ->type_name("ORIGIN");
    command
        ->add_option("--data", options->dataDir,
                     "folder to keep uploaded scenes in; default: in memory, until the end")
        ->type_name("DIR");
    command
        ->add_option("--store", options->storeUrl,
                     "a Redis to keep them in, shared with other services: "
                     "redis://[user:password@]host[:port][/database]")
        ->type_name("URL");
    add("--store-bytes", options->storeBytes,
        "of uploaded scenes, bytes; 0: 1 GiB with --data or --store, else 128 MiB", 0, 1e15);
    addSeconds(*command, "--expire", options->expire,
               "how long an uploaded scene is kept, s; 0: for good", 0.0, 1e9);
    command
        ->add_option("--token", options->token,
                     "what storing and deleting needs: \"Authorization: Bearer TOKEN\"")
        ->type_name("TOKEN");
    add("--cache-bytes", options->cacheBytes, "memory for pictures that were sent, bytes; 0: none",
        0, 1LL << 40U);
    add("--rate", options->rate.perSecond, "requests of one client a second; 0: no limit", 0, 1e6);
    add("--burst", options->rate.burst,
        "requests of one client at once, after a pause; 0: two seconds' worth, at least 20", 0,
        1'000'000);
    command->add_flag("--trust-proxy", options->rate.trustProxy,
                      "a client is the last address of X-Forwarded-For: only behind a proxy");
    addSettings(*command);
    command->callback([&action, command, options] {
        readSettings(*command);
        action = [options](Report&) { return run(*options); };
    });
}

}  // namespace farol::cli
