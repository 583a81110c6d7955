#pragma once

#include "fixture.h"
#include "tests/support/paths.h"
#include "worker/pool.h"

namespace farol::test {

/// One pool for all tests that draw: a worker takes its time to start. What scenes it may read
/// lies below the sources and the tests' output.
inline worker::WorkerPool& realBackend() {
    static worker::WorkerPool backend(
        [] {
            worker::PoolOptions options;
            options.queue = {64, std::chrono::milliseconds(60'000),
                             std::chrono::milliseconds(60'000)};
            options.worker.program = farol::test::kProgram;
            options.worker.scenesDir = std::string(farol::test::kSourceDir) + "/scenes";
            return options;
        }(),
        [](const std::string&, const std::string&) {});
    return backend;
}

/// A server with the real backend; logs are dropped.
struct RealServer : TestServer {
    explicit RealServer(server::ServiceOptions options = {})
        : TestServer(realBackend(), std::move(options)) {}
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
