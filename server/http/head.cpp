#include "server/http/head.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "server/http/text.h"
#include "server/http/uri.h"

namespace farol::server::http {
namespace {

using std::string_view;

std::string lower(string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return out;
}

// RFC 9110 5.6.2: what a method or a header's name may consist of.
bool isToken(string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
               string_view("!#$%&'*+-.^_`|~").find(c) != string_view::npos;
    });
}

bool isFieldValue(string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) {
        return c == '\t' || (static_cast<unsigned char>(c) >= 0x20 && c != 0x7F);
    });
}

// Ours to interpret, or not to be believed: the library never sees these.
bool isWithheld(const std::string& name) {
    static constexpr std::array<string_view, 11> kNames = {
        "range",       "if-range",    "accept-encoding", "content-encoding",
        "remote_addr", "remote_port", "local_addr",      "local_port",
        "expect",      "connection",  "content-type"};
    return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

bool isRequestId(const std::string& text) {
    return !text.empty() && text.size() <= 64 && std::all_of(text.begin(), text.end(), [](char c) {
        return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
               c == '-' || c == '_' || c == '.';
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
    const auto bad = [&](int status, std::string code, std::string message) {
        head.refusal = Refusal{status, std::move(code), std::move(message)};
        return false;
    };
    const std::size_t first = line.find(' ');
    const std::size_t last = line.rfind(' ');
    if (first == string_view::npos || first == last || !isFieldValue(line))
        return bad(400, "http.syntax", "The request line is not METHOD TARGET HTTP/1.1.");
    const string_view method = line.substr(0, first);
    const string_view version = line.substr(last + 1);
    const string_view target = line.substr(first + 1, last - first - 1);
    if (!isToken(method) || target.find(' ') != string_view::npos)
        return bad(400, "http.syntax", "The request line is not METHOD TARGET HTTP/1.1.");
    head.isHead = method == "HEAD";
    head.request.method = head.isHead ? "GET" : std::string(method);
    if (line.size() > kMaxRequestLine)
        return bad(414, "http.uri-too-long",
                   "The address is longer than " + std::to_string(kMaxRequestLine) + " bytes.");
    if (version != "HTTP/1.1" && version != "HTTP/1.0")
        return bad(505, "http.version", "This server speaks HTTP/1.1 and HTTP/1.0.");
    head.keepAlive = version == "HTTP/1.1";
    auto parsed = parseTarget(target);
    if (!parsed)
        return bad(400, "http.target",
                   "The address does not start with '/' or holds a bad %XX escape.");
    if (parsed->path.size() > kMaxPath)
        return bad(414, "http.uri-too-long",
                   "The path is longer than " + std::to_string(kMaxPath) + " bytes.");
    head.request.path = std::move(parsed->path);
    head.request.query = std::move(parsed->query);
    static constexpr std::array<string_view, 8> kMethods = {"GET",    "HEAD",    "POST",  "PUT",
                                                            "DELETE", "OPTIONS", "PATCH", "TRACE"};
    if (std::find(kMethods.begin(), kMethods.end(), method) == kMethods.end())
        return bad(501, "http.method-unknown", "This server does not know that method.");
    return true;
}

bool readLength(const std::string& value, Head& head) {
    std::uint64_t length = 0;
    const auto [end, fault] = std::from_chars(value.data(), value.data() + value.size(), length);
    if (value.empty() || fault != std::errc{} || end != value.data() + value.size() ||
        (head.contentLength && *head.contentLength != length))
        return false;
    head.contentLength = length;
    return true;
}

// What the headers say together; RFC 9112 section 6.
void checkFraming(Head& head) {
    if (head.refusal) return;
    if (head.request.method == "DELETE" && !head.chunked && !head.contentLength)
        head.contentLength = 0;
    if (head.chunked && head.contentLength)
        head.refusal =
            Refusal{400, "http.length", "Content-Length and Transfer-Encoding exclude each other."};
    else if (head.mayHaveBody() && !head.chunked && !head.contentLength)
        head.refusal =
            Refusal{411, "http.length-required", "A request with a body needs a Content-Length."};
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
    if (!lineGood && !head.refusal)
        head.refusal = Refusal{400, "http.syntax", "The request is not HTTP."};
    head.cleaned = std::string(line.value_or("")) + "\r\n";
    bool lengthsGood = true;
    while (const auto next = takeLine(rest)) {
        if (next->empty()) break;
        const std::size_t colon = next->find(':');
        const string_view name = next->substr(0, colon);
        const string_view value =
            colon == string_view::npos ? string_view{} : trim(next->substr(colon + 1));
        if (colon == string_view::npos || !isToken(name) || !isFieldValue(value)) {
            if (!head.refusal)
                head.refusal = Refusal{400, "http.syntax", "A header line is not 'Name: value'."};
            continue;
        }
        const std::string key = lower(name);
        const std::string content(value);
        if (key == "content-length") {
            lengthsGood = readLength(content, head) && lengthsGood;
        } else if (key == "transfer-encoding") {
            if (lower(content) == "chunked" && !head.chunked)
                head.chunked = true;
            else if (!head.refusal)
                head.refusal = Refusal{501, "http.transfer-encoding",
                                       "The only transfer encoding known here is chunked."};
        } else if (key == "connection") {
            const std::string wish = lower(content);
            if (wish.find("close") != std::string::npos)
                head.keepAlive = false;
            else if (wish.find("keep-alive") != std::string::npos)
                head.keepAlive = true;
        } else if (key == "expect") {
            head.expectsContinue = lower(content) == "100-continue";
        } else if (key == "x-request-id" && isRequestId(content)) {
            head.request.id = content;
        }
        head.request.headers.emplace_back(key, content);
        // Folded into one Content-Length below: a repeated one never reaches the library.
        if (!isWithheld(key) && key != "content-length")
            head.cleaned.append(name).append(": ").append(content).append("\r\n");
    }
    if (!lengthsGood && !head.refusal)
        head.refusal = Refusal{400, "http.length", "Content-Length is not one whole number."};
    checkFraming(head);
    if (head.contentLength)
        head.cleaned += "Content-Length: " + std::to_string(*head.contentLength) + "\r\n";
    head.cleaned += "\r\n";
    return head;
}

}  // namespace farol::server::http
