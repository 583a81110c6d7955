#pragma once

#include <memory>

#include "server/backend.h"
#include "server/http/listener.h"
#include "server/log.h"
#include "server/service.h"

namespace farol::server {

/// The service on a socket: what tests start on a free port and `farol serve` runs.
class Server {
  public:
    /// Binds at once; throws std::runtime_error that says why it cannot. `backend` outlives it.
    Server(const http::ListenOptions& listen, ServiceOptions service, Backend& backend,
           Logger::Sink log = nullptr);
    ~Server();

    void start();
    /// Not ready any more, no new connections, ends the requests that are being served.
    void stop();
    int port() const { return listener_.port(); }
    const Router& router() const { return service_.router(); }

  private:
    Logger logger_;
    Service service_;
    http::Listener listener_;
};

}  // namespace farol::server
