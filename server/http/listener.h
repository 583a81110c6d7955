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

/// Timeouts of a client: wall-clock bounds on the whole step, not on one read.
struct Timeouts {
    std::chrono::milliseconds head{10'000};  ///< from its first byte to its blank line
    std::chrono::milliseconds body{30'000};
    std::chrono::milliseconds write{30'000};  ///< to read a response
    std::chrono::milliseconds linger{1'000};  ///< after a response that ends the connection
    std::chrono::milliseconds grace{12'000};  ///< from stop() to the last byte
};

struct ListenOptions {
    std::string host = "127.0.0.1";
    int port = 8080;                              ///< 0: any free port
    int threads = 32;                             ///< requests handled at once
    int maxConnections = 1024;                    ///< over it, an idle one is closed
    int connectionsPerClient = 0;                 ///< at once; 0: maxConnections
    std::chrono::milliseconds keepAlive{15'000};  ///< for a connection without a request
    /// Memory for arriving requests and slowly read responses; beyond it, the slowest
    /// connections are closed.
    std::size_t bufferBytes = std::size_t{256} << 20U;
    Timeouts timeouts;
};

/// Accepts connections. One thread, which never waits for a client, moves all bytes and passes
/// complete requests to a pool of threads. So clients that are idle, send slowly or do not read
/// their responses occupy no thread. The next request of a connection is handled after the
/// response before it was sent. All queues are bounded by maxConnections, all buffers together by
/// bufferBytes. At maxConnections, the client with the most connections without a request loses
/// the one that has waited longest.
class Listener {
  public:
    /// Binds and listens. Throws std::runtime_error with the reason.
    Listener(const ListenOptions& options, Handler& handler);
    ~Listener();
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;

    int port() const { return port_; }
    void start();
    /// Every response from here on is the last one of its connection.
    void drain() { closing_ = true; }
    /// Accepts no new connection, handles the requests that have begun, sends their responses
    /// within the grace, and closes all connections.
    void stop();
    Traffic traffic() const;

  private:
    /// A request thread owns the connection while it is `active`, else the I/O thread does.
    enum class Phase { idle, receiving, active, holding, sending, lingering };
    struct Client {
        Client(int fd, const Handler& handler, std::string address)
            : link(fd),
              arrival(handler),
              remoteAddress(std::move(address)),
              network(clientOfAddress(remoteAddress)) {}
        /// True if no request of it is complete: the client can repeat it after a close.
        bool isWaiting() const;
        Link link;
        Arrival arrival;
        std::optional<Answered> answered;  ///< not reported yet
        const std::string remoteAddress;
        const std::string network;  ///< key of its count in networks_
        std::size_t held = 0;       ///< bytes of it in buffered_
        std::size_t drained = 0;    ///< bytes read while lingering
        bool hasAsked = false;      ///< a request of it has been answered
        Phase phase = Phase::idle;
        Clock::time_point since, until;  ///< of the phase
    };

    void moveLoop();
    bool isOver(Clock::time_point stoppedAt);
    void acceptSome();
    void admit(int fd, std::string address);
    bool makeRoom(const std::string& network);
    Client* displaceable(const std::string& network) const;
    void displace(Client& client);
    void refuse(int fd, long& counter);
    void accept(bool isOn);
    void look(int fd);
    void move(Client& client, Phase phase);
    void receive(Client& client);
    void linger(Client& client);
    void sweep();
    void relieve();
    void giveUp(Client& client, Phase phase);

    // Both kinds of threads call these for a connection they own, and give up ownership.
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
    std::atomic<bool> closing_{false}, stopping_{false};
    std::atomic<std::size_t> buffered_{0};
    mutable std::mutex mutex_;  ///< guards clients_ to networks_, and Client's phase
    std::condition_variable ready_;
    std::map<int, std::unique_ptr<Client>> clients_;
    std::deque<Client*> queue_;
    Traffic closed_;
    bool ended_ = false;
    std::map<std::string, int, std::less<>> networks_;  ///< connections of each
    Clock::time_point swept_{}, acceptAgain_{};
    bool isAccepting_ = true;
    int reads_ = 1;  ///< most of one connection in a round
    std::thread mover_;
    std::vector<std::thread> threads_;
};

}  // namespace farol::server::http
