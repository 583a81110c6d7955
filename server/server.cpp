#include "server/server.h"

namespace farol::server {

Server::Server(const http::ListenOptions& listen, ServiceOptions service, Backend& backend,
               Logger::Sink log)
    : logger_(std::move(log)),
      service_(std::move(service), backend, logger_),
      listener_(listen, service_) {
    service_.watch([this] { return listener_.traffic(); });
}

Server::~Server() { stop(); }

void Server::start() { listener_.start(); }

void Server::stop() {
    service_.drain();
    listener_.stop();
}

}  // namespace farol::server
