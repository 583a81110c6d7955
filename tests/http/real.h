#pragma once

#include "fixture.h"
#include "server/worker/pool.h"

namespace farol::test {

/// One pool for all tests that draw: a worker takes its time to start. What scenes it may read
/// lies below the sources and the tests' output.
inline server::worker::WorkerPool& realBackend() {
    static server::Logger quiet([](const std::string&) {});
    static server::worker::WorkerPool backend(
        [] {
            server::worker::PoolOptions options;
            options.queue = {64, std::chrono::milliseconds(60'000),
                             std::chrono::milliseconds(60'000)};
            options.worker.program = FAROL_BINARY;
            options.worker.scenesDir = std::string(FAROL_SOURCE_DIR) + "/scenes";
            return options;
        }(),
        quiet);
    return backend;
}

/// A server with the real backend; logs are dropped.
struct RealServer {
    explicit RealServer(server::ServiceOptions options = {})
        : server(listenAnywhere(), std::move(options), realBackend(), [](const std::string&) {}) {
        server.start();
    }
    static server::http::ListenOptions listenAnywhere() {
        server::http::ListenOptions listen;
        listen.port = 0;
        listen.threads = 8;
        return listen;
    }
    int port() const { return server.port(); }
    server::Server server;
};

inline std::string world(const std::string& content) {
    return "<world>\n<window width=\"64\" height=\"48\"/>\n<camera><position x=\"0\" y=\"0\" "
           "z=\"5\"/>"
           "<lookAt x=\"0\" y=\"0\" z=\"0\"/><up x=\"0\" y=\"1\" z=\"0\"/>"
           "<projection fov=\"60\" near=\"1\" far=\"100\"/></camera>\n" +
           content + "\n</world>\n";
}

inline std::string model(const std::string& file, const std::string& inside = "") {
    return world("<group><models>\n<model file=\"" + file + "\">" + inside +
                 "</model>\n</models></group>");
}

}  // namespace farol::test
