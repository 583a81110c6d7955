#include "server/http/head.h"

#include <algorithm>
#include <array>

#include "core/number.h"
#include "core/text.h"
#include "server/http/uri.h"
#include "server/messages.h"

namespace farol::server::http {
namespace {

using std::string_view;

// Returns whether a text is a token (RFC 9110 section 5.6.2): a method or a header's name.
bool isToken(string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
        return isAlphanumeric(c) || string_view("!#$%&'*+-.^_`|~").find(c) != string_view::npos;
    });
}

bool isFieldValue(string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) {
        return c == '\t' || (static_cast<unsigned char>(c) >= 0x20 && c != 0x7F);
    });
}

// True for headers hidden from the library: the server interprets them, or they may be forged.
bool isWithheld(const std::string& name) {
    static constexpr std::array<string_view, 11> kNames = {
        "range",       "if-range",    "accept-encoding", "content-encoding",
        "remote_addr", "remote_port", "local_addr",      "local_port",
        "expect",      "connection",  "content-type"};
    return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

bool isRequestId(const std::string& text) {
    return !text.empty() && text.size() <= 64 && std::all_of(text.begin(), text.end(), [](char c) {
        return isAlphanumeric(c) || c == '-' || c == '_' || c == '.';
    });
}

// One line without its end, removed from `rest`; a bare CR or LF inside makes it unusable.
std::optional<string_view> takeLine(string_view& rest) {
    const std::size_t end = rest.find("\r\n");
    if (end == string_view::npos) return std::nullopt;
    const string_view line = rest.substr(0, end);
    rest.remove_prefix(end + 2);
    return line;
}

bool readRequestLine(string_view line, Head& head) {
    const auto bad = [&](int status, Message message) {
        head.refusal = Refusal{status, std::move(message)};
        return false;
    };
    const std::size_t first = line.find(' ');
    const std::size_t last = line.rfind(' ');
    if (first == string_view::npos || first == last || !isFieldValue(line))
        return bad(400, message<"http.syntax/request-line">());
    const string_view method = line.substr(0, first);
    const string_view version = line.substr(last + 1);
    const string_view target = line.substr(first + 1, last - first - 1);
    if (!isToken(method) || target.find(' ') != string_view::npos)
        return bad(400, message<"http.syntax/request-line">());
    head.isHead = method == "HEAD";
    head.request.method = head.isHead ? "GET" : std::string(method);
    if (line.size() > kMaxRequestLine)
        return bad(414, message<"http.uri-too-long">("max"_arg = kMaxRequestLine));
    if (version != "HTTP/1.1" && version != "HTTP/1.0") return bad(505, message<"http.version">());
    head.keepAlive = version == "HTTP/1.1";
    auto parsed = parseTarget(target);
    if (!parsed) return bad(400, message<"http.target">());
    if (parsed->path.size() > kMaxPath)
        return bad(414, message<"http.uri-too-long/path">("max"_arg = kMaxPath));
    head.request.path = std::move(parsed->path);
    head.request.query = std::move(parsed->query);
    head.request.authority = std::move(parsed->authority);
    static constexpr std::array<string_view, 8> kMethods = {"GET",    "HEAD",    "POST",  "PUT",
                                                            "DELETE", "OPTIONS", "PATCH", "TRACE"};
    if (std::find(kMethods.begin(), kMethods.end(), method) == kMethods.end())
        return bad(501,
                   message<"http.method-unknown">("known"_arg = uncut(joined(kMethods, ", "))));
    return true;
}

bool readLength(const std::string& value, Head& head) {
    const auto length = parseExact<std::uint64_t>(value);
    if (!length || (head.contentLength && *head.contentLength != *length)) return false;
    head.contentLength = length;
    return true;
}

/// Of the Host headers, RFC 9112 section 3.2.
class HostField {
  public:
    void add(const std::string& value) {
        isValid_ = isValid_ && !isThere_;
        isThere_ = true;
        if (value.empty()) return;
        authority_ = parseAuthority(value);
        isValid_ = isValid_ && authority_;
    }
    void finish(Head& head, bool isHttp11) {
        if (!isValid_ && !head.refusal) head.refusal = Refusal{400, message<"http.host/value">()};
        head.request.lacksHost = isHttp11 && !authority_;
        if (!head.request.authority) head.request.authority = std::move(authority_);
    }

  private:
    bool isThere_ = false, isValid_ = true;
    std::optional<Authority> authority_;
};

// Checks the headers of the body's length together; RFC 9112 section 6.
void checkFraming(Head& head) {
    if (head.refusal) return;
    if (head.request.method == "DELETE" && !head.chunked && !head.contentLength)
        head.contentLength = 0;
    if (head.chunked && head.contentLength)
        head.refusal = Refusal{400, message<"http.length">()};
    else if (head.mayHaveBody() && !head.chunked && !head.contentLength)
        head.refusal = Refusal{411, message<"http.length-required">()};
}

}  // namespace

bool Head::mayHaveBody() const {
    return request.method == "POST" || request.method == "PUT" || request.method == "PATCH" ||
           request.method == "DELETE";
}

void Head::takeAsEmpty() {
    refusal.reset();
    contentLength = 0;
    cleaned.insert(cleaned.size() - 2, "Content-Length: 0\r\n");
}

Head checkHead(string_view text) {
    Head head;
    string_view rest = text;
    const auto line = takeLine(rest);
    const bool lineGood = line && readRequestLine(*line, head);
    if (!lineGood && !head.refusal) head.refusal = Refusal{400, message<"http.syntax">()};
    head.cleaned = std::string(line.value_or("")) + "\r\n";
    const bool isHttp11 = line && line->ends_with(" HTTP/1.1");
    bool lengthsGood = true;
    HostField host;
    std::size_t lines = 0;
    while (const auto next = takeLine(rest)) {
        if (next->empty()) break;
        if (++lines > kMaxHeaderLines) {
            head.refusal = Refusal{431, message<"http.head/lines">("max"_arg = kMaxHeaderLines)};
            break;
        }
        const std::size_t colon = next->find(':');
        const string_view name = next->substr(0, colon);
        const string_view value = colon == string_view::npos
                                      ? string_view{}
                                      : trimmed(next->substr(colon + 1), kLineBlanks);
        if (colon == string_view::npos || !isToken(name) || !isFieldValue(value)) {
            if (!head.refusal) head.refusal = Refusal{400, message<"http.syntax/header">()};
            continue;
        }
        const std::string key = lowerCase(name);
        const std::string content(value);
        if (key == "content-length") {
            lengthsGood = readLength(content, head) && lengthsGood;
        } else if (key == "transfer-encoding") {
            if (lowerCase(content) == "chunked" && !head.chunked)
                head.chunked = true;
            else if (!head.refusal)
                head.refusal = Refusal{501, message<"http.transfer-encoding">()};
        } else if (key == "connection") {
            const std::string wish = lowerCase(content);
            if (wish.find("close") != std::string::npos)
                head.keepAlive = false;
            else if (wish.find("keep-alive") != std::string::npos)
                head.keepAlive = true;
        } else if (key == "host") {
            host.add(content);
        } else if (key == "expect") {
            head.expectsContinue = lowerCase(content) == "100-continue";
        } else if (key == "x-request-id" && isRequestId(content)) {
            head.request.id = content;
        }
        head.request.headers.emplace_back(key, content);
        // Folded into one Content-Length below: a repeated one never reaches the library.
        if (!isWithheld(key) && key != "content-length")
            head.cleaned.append(name).append(": ").append(content).append("\r\n");
    }
    host.finish(head, isHttp11);
    if (!lengthsGood && !head.refusal) head.refusal = Refusal{400, message<"http.length/value">()};
    checkFraming(head);
    if (head.contentLength)
        head.cleaned += "Content-Length: " + std::to_string(*head.contentLength) + "\r\n";
    head.cleaned += "\r\n";
    return head;
}

}  // namespace farol::server::http
