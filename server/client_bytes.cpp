#include "server/client_bytes.h"

#include "server/messages.h"
#include "worker/backend.h"

namespace farol::server {

void ClientBytes::add(const std::string& client, std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    std::size_t& has = bytes_[client];
    if (has + bytes > share_ && has > 0)
        throw worker::Busy(message<"limit.client">("count"_arg = has, "max"_arg = share_), 1);
    has += bytes;
}

void ClientBytes::remove(const std::string& client, std::size_t bytes) {
    if (bytes == 0) return;
    const std::lock_guard lock(mutex_);
    const auto found = bytes_.find(client);
    found->second -= bytes;
    if (found->second == 0) bytes_.erase(found);
}

std::string CountedBody::read(std::size_t maxBytes) {
    std::string all = body_.read(maxBytes);
    if (all.empty()) return all;
    all_.add(client_, all.size());
    counted_ += all.size();
    return all;
}

}  // namespace farol::server
