#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "server/http/connection.h"
#include "server/http/message.h"

namespace farol::server::http {

struct ListenOptions {
    std::string host = "127.0.0.1";
    int port = 8080;                              ///< 0: any free port
    int threads = 32;                             ///< requests served at once
    int maxConnections = 1024;                    ///< more are answered 503 and closed
    std::chrono::milliseconds keepAlive{15'000};  ///< for a connection without a request
    Timeouts timeouts;
};

/// Accepts connections and gives each to a thread while it has a request to serve. A connection
/// that waits for its next request, or has sent only part of its head, costs a descriptor and no
/// thread, so idle and slow clients starve nobody. All queues are bounded by maxConnections.
class Listener {
  public:
    /// Binds and listens. Throws std::runtime_error that says why it cannot.
    Listener(const ListenOptions& options, Handler& handler);
    ~Listener();
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;

    int port() const { return port_; }
    void start();
    /// Takes no new connection, lets the requests that are being served end, closes all.
    void stop();

  private:
    using Clock = std::chrono::steady_clock;
    struct Client {
        std::string remoteAddress;
        Clock::time_point idleSince;
        Clock::time_point headSince{};  ///< when a head began that is not complete yet
        bool active = false;            ///< in the queue or with a thread
    };

    void acceptLoop();
    void acceptAll();
    void serveLoop();
    bool nextIsHere(int fd);
    void look(int fd, bool ended);
    void watch(int fd);
    void activate(int fd);
    void park(int fd);
    void drop(int fd);
    void sweep();
    void dropAll();

    ListenOptions options_;
    Handler& handler_;
    int listenFd_ = -1, epollFd_ = -1, wakeFd_ = -1;
    int port_ = 0;
    std::atomic<bool> stopping_{false};
    std::mutex mutex_;
    std::condition_variable ready_;
    std::map<int, Client> clients_;
    std::deque<int> queue_;
    bool ended_ = false;
    std::thread acceptor_;
    std::vector<std::thread> threads_;
};

}  // namespace farol::server::http
