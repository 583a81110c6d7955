#pragma once

#include <string>

namespace farol::server::http {

/// Returns a non-blocking socket that listens on host and port (0: any free one). Throws
/// std::runtime_error with the reason.
int listenOn(const std::string& host, int port);

/// True if all addresses of the host are the machine's own. False where it has none.
bool isLoopback(const std::string& host);

/// The port that it listens on.
int portOf(int fd);

/// An accepted client, non-blocking; -1 with errno where there is none.
int acceptFrom(int fd, std::string& address);

}  // namespace farol::server::http
