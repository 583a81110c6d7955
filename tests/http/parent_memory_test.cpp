// Memory that JSON and files from outside take in the service's own process.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <fstream>
#include <thread>

#include "tests/http/daemon.h"
#include "tests/support/skip.h"

using namespace farol::test;

namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20U;

/// The status line's number of the answer to a request; 0 without one.
int statusOf(int port, const std::string& request) {
    const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    int status = 0;
    if (connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0) {
        std::size_t sent = 0;
        while (sent < request.size()) {
            const ssize_t count =
                send(fd, request.data() + sent, request.size() - sent, MSG_NOSIGNAL);
            if (count <= 0) break;
            sent += static_cast<std::size_t>(count);
        }
        char head[16] = {};
        if (recv(fd, head, sizeof head - 1, MSG_WAITALL) > 12) status = std::atoi(head + 9);
    }
    close(fd);
    return status;
}

/// A render whose upload has this part beside its scene.
std::string withPart(const std::string& names, const std::string& content) {
    const std::string body =
        "--b\r\nContent-Disposition: form-data; name=\"scene\"\r\n\r\n<world/>\r\n"
        "--b\r\nContent-Disposition: form-data; " +
        names + "\r\n\r\n" + content + "\r\n--b--\r\n";
    return "POST /v1/render HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: multipart/form-data; "
           "boundary=b\r\nContent-Length: " +
           std::to_string(body.size()) + "\r\n\r\n" + body;
}

std::string withOptions(const std::string& options) {
    return withPart("name=\"options\"", options);
}

std::string repeated(const std::string& text, std::size_t bytes) {
    std::string out;
    out.reserve(bytes + text.size());
    while (out.size() < bytes) out += text;
    return out;
}

long statusMiB(pid_t pid, const std::string& field) {
    std::ifstream in("/proc/" + std::to_string(pid) + "/status");
    for (std::string line; std::getline(in, line);)
        if (line.rfind(field + ":", 0) == 0) return std::stol(line.substr(field.size() + 1)) / 1024;
    return -1;
}

}  // namespace

TEST_CASE("options of 16 MiB take the service their bytes and no more") {
    Daemon daemon({"--port", "0", "--workers", "1", "--spares", "0"});
    const int port = portIn(daemon.firstLine());
    REQUIRE(statusOf(port, withOptions("{\"width\": 32, \"height\": 32}")) == 200);
    const std::size_t most = 15 * kMiB + 900'000;
    const std::string texts[] = {
        std::string(most, '['),        repeated("{\"a\":", most),        "[" + repeated("1,", most),
        "\"" + std::string(most, 'x'), "{" + repeated("\"a\":1,", most), std::string(most, '1'),
    };
    for (const std::size_t clients : {std::size_t{1}, std::size_t{4}})
        for (const std::string& text : texts) {
            [[maybe_unused]] const long before = statusMiB(daemon.pid(), "VmRSS");
            std::ofstream("/proc/" + std::to_string(daemon.pid()) + "/clear_refs") << "5";
            const std::string request = withOptions(text);
            std::vector<int> statuses(clients);
            std::vector<std::thread> threads;
            for (int& status : statuses)
                threads.emplace_back([&] { status = statusOf(port, request); });
            for (std::thread& thread : threads) thread.join();
            INFO(clients << " x " << text.substr(0, 20));
            for (const int status : statuses) CHECK((status == 400 || status == 429));
            [[maybe_unused]] const long bodies = static_cast<long>(clients * request.size() / kMiB);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they keep what is freed
            CHECK(statusMiB(daemon.pid(), "VmHWM") <= before + before / 4 + bodies + 1);
#endif
            CHECK(statusOf(port, "GET /livez HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n") == 200);
        }
}

TEST_CASE("a request for which the service has no memory is answered 503, the next one is served") {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    skip("a build with sanitizers takes terabytes of addresses");
#else
    Daemon daemon({"--port", "0", "--workers", "1", "--spares", "0"});
    const int port = portIn(daemon.firstLine());
    const std::string small = withOptions("{\"width\": 32, \"height\": 32}");
    // Packing it for a worker takes its bytes again.
    const std::string large =
        withPart("name=\"file\"; filename=\"a.bin\"", std::string(15 * kMiB, 'x'));
    REQUIRE(statusOf(port, small) == 200);
    const auto addresses = [&](rlim_t bytes) {
        const rlimit both{bytes, RLIM_INFINITY};
        REQUIRE(prlimit(daemon.pid(), RLIMIT_AS, &both, nullptr) == 0);
    };
    addresses((static_cast<rlim_t>(statusMiB(daemon.pid(), "VmSize")) + 8) * kMiB);
    // Where it runs out differs: while the body arrives, or while it is packed.
    for (int i = 0; i < 8; ++i) {
        CHECK(statusOf(port, large) == 503);
        CHECK(statusOf(port, small) == 200);
    }
    addresses(RLIM_INFINITY);
    CHECK(statusOf(port, large) == 200);
#endif
}
