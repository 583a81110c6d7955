#include "worker/worker_output.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>

namespace farol::worker {
namespace {

constexpr std::size_t kMaxLine = 500;  // bytes of a line that are logged
constexpr int kPipeBytes = 256 << 10;  // a sanitizer's report fits
constexpr int kLinesASecond = 100;     // a log is not a dump
// Reading more would let a worker that prints without end occupy a core of the parent.
constexpr std::size_t kBytesASecond = std::size_t{1} << 20U;

}  // namespace

WorkerOutput::WorkerOutput(Sink sink) : sink_(std::move(sink)) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
        throw std::runtime_error(std::string("no pipe for the workers: ") + std::strerror(errno));
    readFd_ = ends[0];
    writeFd_ = ends[1];
    fcntl(writeFd_, F_SETFL, O_NONBLOCK);
    fcntl(writeFd_, F_SETPIPE_SZ, kPipeBytes);
    thread_ = std::thread([this] { run(); });
}

WorkerOutput::~WorkerOutput() {
    // The workers have ended, so that this is the last open write end.
    close(writeFd_);
    thread_.join();
    close(readFd_);
}

void WorkerOutput::run() {
    std::array<char, 4096> bytes;
    std::string line;
    int lines = 0;
    std::size_t bytesRead = 0;
    auto second = std::chrono::steady_clock::now();
    const auto flush = [&] {
        if (line.empty()) return;
        if (lines < kLinesASecond) sink_(line);
        if (++lines == kLinesASecond) sink_("(more lines in this second are not logged)");
        line.clear();
    };
    const auto beginSecond = [&] {
        const auto now = std::chrono::steady_clock::now();
        if (now - second < std::chrono::seconds(1)) return;
        second = now;
        lines = 0;
        bytesRead = 0;
    };
    for (;;) {
        beginSecond();
        if (bytesRead >= kBytesASecond) {  // the full pipe then drops the workers' output
            std::this_thread::sleep_until(second + std::chrono::seconds(1));
            continue;
        }
        const ssize_t got = read(readFd_, bytes.data(), bytes.size());
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) break;
        beginSecond();  // it may have waited for long
        bytesRead += static_cast<std::size_t>(got);
        for (ssize_t i = 0; i < got; ++i) {
            const char c = bytes[static_cast<std::size_t>(i)];
            if (c == '\n')
                flush();
            else if (line.size() < kMaxLine)
                line += c;
        }
    }
    flush();
}

}  // namespace farol::worker
