#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "server/http/connection.h"
#include "server/http/message.h"
#include "server/http/traffic.h"

namespace farol::server::http {

/// How long a client may take. All are wall-clock bounds on the whole step, not on one read.
struct Timeouts {
    std::chrono::milliseconds head{10'000};  ///< from its first byte to its blank line
    std::chrono::milliseconds body{30'000};
    std::chrono::milliseconds write{30'000};  ///< to take an answer
    std::chrono::milliseconds linger{1'000};  ///< after an answer that ends the connection
    std::chrono::milliseconds grace{12'000};  ///< from stop() to the last byte
};

struct ListenOptions {
    std::string host = "127.0.0.1";
    int port = 8080;                              ///< 0: any free port
    int threads = 32;                             ///< requests handled at once
    int maxConnections = 1024;                    ///< more are answered 503 and closed
    std::chrono::milliseconds keepAlive{15'000};  ///< for a connection without a request
    /// Of memory for requests that arrive and answers that are taken slowly; beyond, the slowest
    /// connections are closed.
    std::size_t bufferBytes = std::size_t{256} << 20U;
    Timeouts timeouts;
};

/// Accepts connections, moves their bytes in one thread that never waits for a client, and gives
/// whole requests to threads that handle them. So neither a client that is idle, nor one that
/// sends slowly, nor one that does not read its answers holds a thread; the next request of a
/// connection is handled when the answer before it has left. All queues are bounded by
/// maxConnections, all buffers together by bufferBytes.
class Listener {
  public:
    /// Binds and listens. Throws std::runtime_error that says why it cannot.
    Listener(const ListenOptions& options, Handler& handler);
    ~Listener();
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;

    int port() const { return port_; }
    void start();
    /// Takes no new connection, lets the requests that have begun end, their answers leave within
    /// the grace, and closes all.
    void stop();
    Traffic traffic() const;

  private:
    /// A thread has the connection while it is `active`, else the one that moves bytes.
    enum class Phase { idle, receiving, active, holding, sending, lingering };
    struct Client {
        Client(int fd, const Handler& handler, std::string address)
            : link(fd), arrival(handler), remoteAddress(std::move(address)) {}
        Link link;
        Arrival arrival;
        std::optional<Answered> answered;  ///< not reported yet
        std::string remoteAddress;
        std::size_t held = 0;     ///< as counted in buffered_
        std::size_t drained = 0;  ///< while lingering
        Phase phase = Phase::idle;
        Clock::time_point since, until;  ///< of the phase
    };

    void moveLoop();
    bool isOver(Clock::time_point stoppedAt);
    void acceptAll();
    void look(int fd);
    void receive(Client& client);
    void linger(Client& client);
    void sweep();
    void relieve();
    void giveUp(Client& client, Phase phase);

    // What both kinds of threads do with a connection that they have, which they then have not.
    void await(Client& client);
    void enter(Client& client, Phase phase, Clock::time_point since,
               std::chrono::milliseconds patience);
    void activate(Client& client);
    void end(Client& client, bool isCut);
    void drop(Client& client);

    void watch(const Client& client) const;
    void count(Client& client);
    void wake() const;

    void serveLoop();
    void serve(Client& client, Connection& connection);
    bool nextIsHere(Client& client);
    bool othersWait() const;

    const ListenOptions options_;
    Handler& handler_;
    int listenFd_ = -1, epollFd_ = -1, wakeFd_ = -1;
    int port_ = 0;
    std::atomic<bool> stopping_{false};
    std::atomic<std::size_t> buffered_{0};
    mutable std::mutex mutex_;  ///< of what follows, and of Client's phase
    std::condition_variable ready_;
    std::map<int, std::unique_ptr<Client>> clients_;
    std::deque<Client*> queue_;
    Traffic closed_;
    bool ended_ = false;
    Clock::time_point swept_{};
    std::thread mover_;
    std::vector<std::thread> threads_;
};

}  // namespace farol::server::http
