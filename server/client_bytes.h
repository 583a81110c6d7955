#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <string>

#include "server/http/message.h"

namespace farol::server {

/// Counts the bytes of request bodies in memory while their requests are handled, by client. Each
/// client has a limit, so that no client fills the memory with requests that wait for workers.
/// Bounded by the requests that are handled at once. Thread-safe.
class ClientBytes {
  public:
    explicit ClientBytes(std::size_t share) : share_(share) {}
    /// Throws Busy limit.client where the client then had more than its share.
    void add(const std::string& client, std::size_t bytes);
    void remove(const std::string& client, std::size_t bytes);

  private:
    const std::size_t share_;
    std::mutex mutex_;
    std::map<std::string, std::size_t> bytes_;
};

/// A body whose bytes count for its client from the read until the request is answered.
class CountedBody final : public http::Body {
  public:
    CountedBody(http::Body& body, ClientBytes& all, std::string client)
        : body_(body), all_(all), client_(std::move(client)) {}
    ~CountedBody() override { all_.remove(client_, counted_); }
    CountedBody(const CountedBody&) = delete;
    CountedBody& operator=(const CountedBody&) = delete;

    std::string read(std::size_t maxBytes) override;

  private:
    http::Body& body_;
    ClientBytes& all_;
    const std::string client_;
    std::size_t counted_ = 0;
};

}  // namespace farol::server
