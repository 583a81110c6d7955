#include "cli/frame_pipe.h"

#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <stdexcept>

#include "render/options.h"

namespace farol::cli {
namespace {

constexpr std::size_t kChannels = 4;

/// Precedes the pixels of a frame.
struct FrameHead {
    std::int32_t width = 0, height = 0;  ///< px
};

void sendBytes(int socket, const void* data, std::size_t size) {
    const char* from = static_cast<const char*>(data);
    while (size > 0) {
        const ssize_t sent = ::send(socket, from, size, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent < 0) throw std::runtime_error("the process that encodes has ended");
        from += sent;
        size -= static_cast<std::size_t>(sent);
    }
}

// By read(): the sandbox allows recv() for one socket alone.
bool readBytes(int descriptor, void* data, std::size_t size) {
    char* to = static_cast<char*>(data);
    while (size > 0) {
        const ssize_t got = ::read(descriptor, to, size);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        to += got;
        size -= static_cast<std::size_t>(got);
    }
    return true;
}

}  // namespace

void FrameSender::append(const image::Image& frame) {
    const FrameHead head{frame.width, frame.height};
    sendBytes(socket_, &head, sizeof head);
    sendBytes(socket_, frame.pixels.data(), frame.pixels.size());
}

std::optional<image::Image> receiveFrame(int descriptor) {
    FrameHead head;
    if (!readBytes(descriptor, &head, sizeof head)) return std::nullopt;
    const std::int64_t pixels = std::int64_t{head.width} * head.height;
    if (head.width < 1 || head.height < 1 || pixels > render::kMaxPixels) return std::nullopt;
    image::Image frame{head.width, head.height, {}};
    frame.pixels.resize(static_cast<std::size_t>(pixels) * kChannels);
    if (!readBytes(descriptor, frame.pixels.data(), frame.pixels.size())) return std::nullopt;
    return frame;
}

}  // namespace farol::cli
