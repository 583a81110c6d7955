// Heads of requests: what is let through to the HTTP library is one clean head. Bodies end in one
// place however their bytes arrive.
#include <algorithm>

#include "server/etag.h"
#include "server/http/body_reader.h"
#include "server/http/head.h"
#include "server/http/uri.h"
#include "tests/fuzz/checks.h"
#include "tests/fuzz/target.h"

namespace farol::fuzz {
namespace {

bool isControl(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

bool clean(const std::string& text) { return std::none_of(text.begin(), text.end(), isControl); }

void checkAccepted(const server::http::Head& head) {
    const std::string& cleaned = head.cleaned;
    require(cleaned.size() >= 4 && cleaned.find("\r\n\r\n") == cleaned.size() - 4,
            "what is let through is not one head");
    // A blank is put after each colon, which has at least three bytes beside it.
    require(cleaned.size() <= server::http::kMaxHead * 3 / 2, "a head that grew without bound");
    for (std::size_t i = 0; i < cleaned.size(); ++i)
        require(cleaned[i] != '\0' && (cleaned[i] != '\n' || (i > 0 && cleaned[i - 1] == '\r')),
                "a line end of another kind is let through");
    const server::http::Request& request = head.request;
    require(request.path.starts_with('/') && clean(request.path), "no path");
    require(request.path.size() <= server::http::kMaxPath, "a path without bound");
    for (const auto& [name, value] : request.query)
        require(clean(name) && clean(value), "a control character in the query");
    require(!(head.chunked && head.contentLength), "two lengths of one body");
    server::matchesTag(request.header("if-none-match"), "\"0123\"");
}

/// A body read in pieces of the given size, and what was left over of the bytes.
struct Read {
    server::http::BodyReader reader;
    std::size_t taken = 0;
};

Read readIn(std::string_view bytes, std::size_t piece, std::optional<std::uint64_t> length) {
    constexpr std::size_t kMaxBody = 1000;
    Read read{server::http::BodyReader(length, kMaxBody)};
    using State = server::http::BodyReader::State;
    while (read.reader.state() == State::more && read.taken < bytes.size()) {
        const std::string_view part = bytes.substr(read.taken, piece);
        const std::size_t took = read.reader.feed(part);
        require(took <= part.size(), "more was taken than there is");
        require(took == part.size() || read.reader.state() != State::more, "bytes were left");
        read.taken += took;
    }
    require(read.reader.size() <= kMaxBody, "a body beyond its bound");
    return read;
}

/// However the bytes arrive, the same body ends at the same place.
void checkBody(std::string_view bytes) {
    for (const auto& length : {std::optional<std::uint64_t>(), std::optional<std::uint64_t>(7)}) {
        Read whole = readIn(bytes, bytes.size() + 1, length);
        const std::string body = whole.reader.take();
        for (const std::size_t piece : {std::size_t{1}, std::size_t{3}}) {
            Read pieces = readIn(bytes, piece, length);
            require(pieces.reader.state() == whole.reader.state(), "pieces end in another state");
            require(pieces.taken == whole.taken, "pieces end in another place");
            require(pieces.reader.take() == body, "pieces make another body");
        }
    }
}

}  // namespace

const Target& target() {
    static const Target made{{"txt"},
                             {"GET ",
                              "POST ",
                              "DELETE ",
                              " HTTP/1.1\r\n",
                              " HTTP/1.0\r\n",
                              "\r\n",
                              "\r\n\r\n",
                              "\n",
                              "Host: x\r\n",
                              "Content-Length: 5\r\n",
                              "Content-Length: 18446744073709551616\r\n",
                              "Transfer-Encoding: chunked\r\n",
                              "Transfer-Encoding: gzip\r\n",
                              "5\r\nworld\r\n",
                              "0\r\n\r\n",
                              "1;a=b\r\n",
                              "ffffffffffffffffff\r\n",
                              "Connection: close\r\n",
                              "Expect: 100-continue\r\n",
                              "Range: bytes=0-1\r\n",
                              "REMOTE_ADDR: 1.2.3.4\r\n",
                              "If-None-Match: *\r\n",
                              "If-None-Match: W/\"0123\"\r\n",
                              "X-Request-Id: a\r\n",
                              "%00",
                              "%2e%2e",
                              "%",
                              "?a=b&c",
                              "http://h/",
                              "//",
                              "*",
                              " ",
                              "\t",
                              ":",
                              std::string("\0", 1)},
                             512};
    return made;
}

}  // namespace farol::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace farol::server;
    using namespace farol::fuzz;
    std::string text(reinterpret_cast<const char*>(data), std::min(size, http::kMaxHead - 4));
    const std::string decoded = http::percentDecode(text, false).value_or("");
    checkBody(text);
    require(http::percentDecode(http::percentEncodePath(decoded), false) == decoded,
            "what was encoded decodes to something else");
    if (const std::size_t end = text.find("\r\n\r\n"); end != std::string::npos)
        text.resize(end + 4);
    else
        text += "\r\n\r\n";  // as the connection hands it over
    const http::Head head = http::checkHead(text);
    if (head.refusal) {
        const int status = head.refusal->status;
        require(status >= 400 && status < 600 && !head.refusal->message.empty(), "no refusal");
        reached(head.refusal->message.id);
    } else {
        checkAccepted(head);
        reached(std::string(head.keepAlive ? "keep " : "") + (head.chunked ? "chunked " : "") +
                (head.expectsContinue ? "expects " : "") + (head.contentLength ? "length" : ""));
    }
    return 0;
}
