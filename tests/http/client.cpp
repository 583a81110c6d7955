#include "client.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace farol::test {
namespace {

constexpr int kPatienceMs = 60'000;

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : static_cast<char>(c);
    });
    return text;
}

}  // namespace

std::string Answer::header(const std::string& name) const {
    const auto found = headers.find(name);
    return found == headers.end() ? "" : found->second;
}

nlohmann::json Answer::json() const { return nlohmann::json::parse(body, nullptr, false); }

std::string Answer::code() const {
    const auto value = json();
    return value.is_object() ? value.value("code", "") : "";
}

RawClient::RawClient(int port, const std::string& from)
    : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    if (!from.empty()) {
        sockaddr_in own{};
        own.sin_family = AF_INET;
        if (::inet_pton(AF_INET, from.c_str(), &own.sin_addr) != 1 ||
            ::bind(fd_, reinterpret_cast<sockaddr*>(&own), sizeof own) != 0)
            throw std::runtime_error("cannot use the address " + from);
    }
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (fd_ < 0 || ::connect(fd_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
        throw std::runtime_error("cannot connect to port " + std::to_string(port));
}

RawClient::~RawClient() { ::close(fd_); }

bool RawClient::send(const std::string& bytes) {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t sent = ::send(fd_, bytes.data() + done, bytes.size() - done, MSG_NOSIGNAL);
        if (sent <= 0) return false;
        done += static_cast<std::size_t>(sent);
    }
    return true;
}

void RawClient::endSending() { ::shutdown(fd_, SHUT_WR); }

bool RawClient::fill() {
    pollfd entry{fd_, POLLIN, 0};
    if (::poll(&entry, 1, kPatienceMs) != 1) return false;
    std::array<char, 65536> chunk;
    const ssize_t got = ::recv(fd_, chunk.data(), chunk.size(), 0);
    if (got <= 0) {
        ended_ = true;
        return false;
    }
    buffer_.append(chunk.data(), static_cast<std::size_t>(got));
    return true;
}

Answer RawClient::read(bool withBody) {
    Answer answer;
    std::size_t end;
    while ((end = buffer_.find("\r\n\r\n")) == std::string::npos)
        if (!fill()) return answer;
    const std::string head = buffer_.substr(0, end + 2);
    buffer_.erase(0, end + 4);
    if (head.rfind("HTTP/1.1 ", 0) != 0) return answer;
    answer.status = std::stoi(head.substr(9, 3));
    for (std::size_t at = head.find("\r\n") + 2; at < head.size();) {
        const std::size_t lineEnd = head.find("\r\n", at);
        const std::string line = head.substr(at, lineEnd - at);
        const std::size_t colon = line.find(": ");
        if (colon != std::string::npos)
            answer.headers.emplace(lower(line.substr(0, colon)), line.substr(colon + 2));
        at = lineEnd + 2;
    }
    const std::string length = answer.header("content-length");
    const std::size_t size = length.empty() ? 0 : std::stoul(length);
    if (withBody) {
        while (buffer_.size() < size && fill()) {
        }
        answer.body = buffer_.substr(0, size);
        buffer_.erase(0, answer.body.size());
    }
    answer.closed = answer.header("connection") == "close";
    return answer;
}

bool RawClient::closedByServer() {
    while (!ended_)
        if (!fill()) return ended_;
    return true;
}

Answer ask(int port, const Ask& request) {
    RawClient client(port);
    std::string text = request.method + " " + request.target + " HTTP/1.1\r\nHost: localhost\r\n";
    for (const auto& [name, value] : request.headers) text += name + ": " + value + "\r\n";
    if (!request.body.empty() || request.method == "POST")
        text += "Content-Length: " + std::to_string(request.body.size()) + "\r\n";
    client.send(text + "\r\n" + request.body);
    return client.read(request.method != "HEAD");
}

Answer get(int port, const std::string& target,
           std::vector<std::pair<std::string, std::string>> headers) {
    return ask(port, {"GET", target, std::move(headers), ""});
}

Answer post(int port, const std::string& target, const std::string& body,
            const std::string& contentType) {
    return ask(port, {"POST", target, {{"Content-Type", contentType}}, body});
}

std::string multipart(const std::vector<FilePart>& parts) {
    std::string body;
    for (const FilePart& part : parts) {
        body += "--frontier\r\nContent-Disposition: form-data; name=\"" + part.name + "\"";
        if (!part.fileName.empty()) body += "; filename=\"" + part.fileName + "\"";
        if (!part.contentType.empty()) body += "\r\nContent-Type: " + part.contentType;
        body += "\r\n\r\n" + part.content + "\r\n";
    }
    return body + "--frontier--\r\n";
}

}  // namespace farol::test
