#pragma once

#include <cstddef>

namespace farol::server::http {

/// Connections, for metrics.
struct Traffic {
    long idle = 0, receiving = 0, active = 0, sending = 0;  ///< open now, by state
    std::size_t bufferedBytes = 0;                          ///< in memory for clients now
    /// Closed since the start, or never taken, for this reason.
    long slowHead = 0, slowBody = 0, slowReader = 0, memory = 0, full = 0;
    long clientFull = 0;  ///< over connectionsPerClient
    long displaced = 0;   ///< idle ones, closed for a new connection at maxConnections
};

}  // namespace farol::server::http
