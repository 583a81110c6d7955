#include "server/http/connection.h"

#include <httplib.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <ctime>
#include <random>

#include "scene/error.h"
#include "server/http/head.h"
#include "server/http/socket_stream.h"

namespace farol::server::http {
namespace {

std::string newRequestId() {
    static std::atomic<std::uint64_t> next{std::random_device{}() * 0x100000000ULL};
    char text[24];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(next.fetch_add(1)));
    return text;
}

// "Mon, 02 Jan 2006 15:04:05 GMT"; written out because strftime follows the locale.
std::string httpDate(std::time_t now) {
    static constexpr const char* kDays[] = {"Sun", "Mon", "Tue", "Wed", "Thu", "Fri", "Sat"};
    static constexpr const char* kMonths[] = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                              "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[64];
    std::snprintf(text, sizeof text, "%s, %02d %s %04d %02d:%02d:%02d GMT", kDays[utc.tm_wday],
                  utc.tm_mday, kMonths[utc.tm_mon], utc.tm_year + 1900, utc.tm_hour, utc.tm_min,
                  utc.tm_sec);
    return text;
}

// No header of ours can be split: control characters end a value.
std::string headerValue(const std::string& value) {
    const auto end = std::find_if(value.begin(), value.end(), [](char c) {
        return (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7F;
    });
    return std::string(value.begin(), end);
}

}  // namespace

/// The library's server without its sockets: it parses a head that head.cpp has checked, frames
/// the body and writes the answer; everything between is one Handler.
class Connection::Parser final : public httplib::Server {
  public:
    Parser(http::Handler& handler, Timeouts timeouts) : handler_(handler), timeouts_(timeouts) {
        set_pre_routing_handler([this](const httplib::Request&, httplib::Response& out) {
            if (const auto& refusal = head_->refusal) {
                answer(handler_.refuse(head_->request, refusal->status, refusal->code,
                                       refusal->message),
                       out);
                return HandlerResponse::Handled;
            }
            if (head_->mayHaveBody()) return HandlerResponse::Unhandled;
            BodyOf none(*this, nullptr);
            answer(handler_.handle(head_->request, none), out);
            return HandlerResponse::Handled;
        });
        const HandlerWithContentReader withBody = [this](const httplib::Request&,
                                                         httplib::Response& out,
                                                         const httplib::ContentReader& reader) {
            BodyOf body(*this, &reader);
            answer(handler_.handle(head_->request, body), out);
        };
        Post("/", withBody);
        Put("/", withBody);
        Patch("/", withBody);
        Delete("/", withBody);
        set_error_handler(
            HandlerWithResponse([this](const httplib::Request&, httplib::Response& out) {
                if (answered_) return HandlerResponse::Unhandled;
                keep_ = false;
                const int status = out.status;
                answer(handler_.refuse(head_->request, status, "http.syntax",
                                       "The request could not be read."),
                       out);
                return HandlerResponse::Handled;
            }));
        set_exception_handler(
            [this](const httplib::Request&, httplib::Response& out, std::exception_ptr) {
                keep_ = false;
                answer(handler_.refuse(head_->request, 500, "internal",
                                       "The server met an error of its own."),
                       out);
            });
        set_post_routing_handler([this](const httplib::Request&, httplib::Response& out) {
            for (const char* name : {"Connection", "Keep-Alive", "Accept-Ranges"})
                out.headers.erase(name);
            if (out.status == 304 || out.status == 204) out.headers.erase("Content-Length");
            if (!keep_) out.headers.emplace("Connection", "close");
        });
    }

    bool serve(int fd, const std::string& remoteAddress, const std::function<bool()>& closing) {
        SocketStream stream(fd);
        stream_ = &stream;
        // The listener waits for a whole head, so the first is there or came too late; of a second
        // one behind it a part may still be under way.
        auto patience = std::chrono::milliseconds(0);
        do {
            std::string text;
            const auto got = stream.readHead(kMaxHead, Clock::now() + patience, text);
            patience = kFollowing;
            if (got == SocketStream::HeadResult::closed) return false;
            Head head = checkHead(text);
            if (got == SocketStream::HeadResult::tooLarge)
                head.refusal = text.find("\r\n") == std::string::npos
                                   ? Refusal{414, "http.uri-too-long", "The address is too long."}
                                   : Refusal{431, "http.head", "The headers are too large."};
            if (got == SocketStream::HeadResult::timedOut)
                head.refusal = Refusal{408, "http.timeout", "The request took too long to arrive."};
            head.request.remoteAddress = remoteAddress;
            if (head.request.id.empty()) head.request.id = newRequestId();
            exchange(stream, head, closing);
        } while (keep_ && stream.hasBuffered());
        if (!keep_ && (unread_ || stream.hasBuffered()))
            stream.finish(kLingerBytes, Clock::now() + timeouts_.linger);
        return keep_;
    }

  private:
    static constexpr std::size_t kLingerBytes = 64U << 20;
    static constexpr std::chrono::milliseconds kFollowing{500};

    /// The body behind the library's reader; stops at the bound instead of reading on.
    class BodyOf final : public Body {
      public:
        BodyOf(Parser& parser, const httplib::ContentReader* reader)
            : parser_(parser), reader_(reader) {}

        std::string read(std::size_t maxBytes) override {
            const Head& head = *parser_.head_;
            std::string bytes;
            if (reader_ == nullptr || !head.hasBody()) return bytes;
            const auto tooLarge = [&] {
                return Error("limit.body",
                             "The body is larger than " + std::to_string(maxBytes) + " bytes.");
            };
            if (head.contentLength.value_or(0) > maxBytes) throw tooLarge();
            if (head.expectsContinue) parser_.sayContinue();
            bytes.reserve(static_cast<std::size_t>(head.contentLength.value_or(0)));
            bool over = false;
            const bool complete = (*reader_)([&](const char* data, std::size_t size) {
                over = size > maxBytes - bytes.size();
                if (!over) bytes.append(data, size);
                return !over;
            });
            if (over) throw tooLarge();
            if (!complete || (head.contentLength && bytes.size() != *head.contentLength))
                throw Error("http.body", "The body did not arrive as it was announced.");
            parser_.bodyRead_ = true;
            return bytes;
        }

      private:
        Parser& parser_;
        const httplib::ContentReader* reader_;
    };

    void sayContinue() {
        static constexpr std::string_view kText = "HTTP/1.1 100 Continue\r\n\r\n";
        stream_->write(kText.data(), kText.size());
    }

    void exchange(SocketStream& stream, Head& head, const std::function<bool()>& closing) {
        const auto start = Clock::now();
        head_ = &head;
        closing_ = &closing;
        answered_ = false;
        bodyRead_ = false;
        unread_ = false;
        keep_ = head.keepAlive;
        const auto readUntil = start + timeouts_.body;
        stream.setReadDeadline(readUntil);
        stream.setWriteDeadline(start + timeouts_.body + timeouts_.write);
        if (head.refusal) {
            keep_ = false;
            unread_ = true;
            // The library is shown a plain request in place of the one it must not see.
            stream.prepend(head.isHead ? "HEAD / HTTP/1.1\r\n\r\n" : "GET / HTTP/1.1\r\n\r\n");
        } else {
            stream.prepend(head.cleaned);
        }
        bool closed = false;
        const bool sent = process(stream, closed, [&](httplib::Request& request) {
            request.path = "/";  // routing is not the library's
            stream.setWriteDeadline(Clock::now() + timeouts_.body + timeouts_.write);
        });
        unread_ = unread_ || (head.hasBody() && !bodyRead_);
        handler_.finished(head.request, last_,
                          std::chrono::duration<double, std::milli>(Clock::now() - start).count(),
                          sent);
        last_ = Response{};
        if (!sent) keep_ = false;
        head_ = nullptr;
    }

    // Newer releases take the addresses of both ends as well.
    template <typename Stream>
    bool process(Stream& stream, bool& closed, const std::function<void(httplib::Request&)>& set) {
        if constexpr (requires { this->process_request(stream, false, closed, set); })
            return this->process_request(stream, false, closed, set);
        else
            return this->process_request(stream, std::string(), 0, std::string(), 0, false, closed,
                                         set);
    }

    void answer(Response response, httplib::Response& out) {
        const Head& head = *head_;
        answered_ = true;
        // Whatever of this request may still be in the socket must not be read as the next one.
        if (response.status >= 400 || (head.hasBody() && !bodyRead_) || (*closing_)())
            keep_ = false;
        out.headers.clear();
        out.status = response.status;
        for (const auto& [name, value] : response.headers)
            out.headers.emplace(name, headerValue(value));
        if (!response.contentType.empty())
            out.headers.emplace("Content-Type", response.contentType);
        out.headers.emplace("Date", httpDate(std::time(nullptr)));
        out.body = std::move(response.body);
        response.set("Content-Length", std::to_string(out.body.size()));
        response.body.clear();
        last_ = std::move(response);
        stream_->setWriteDeadline(Clock::now() + timeouts_.write);
    }

    http::Handler& handler_;
    Timeouts timeouts_;
    SocketStream* stream_ = nullptr;
    const Head* head_ = nullptr;
    const std::function<bool()>* closing_ = nullptr;
    Response last_;
    bool answered_ = false, bodyRead_ = false, unread_ = false, keep_ = true;
};

Connection::Connection(Handler& handler, Timeouts timeouts)
    : parser_(std::make_unique<Parser>(handler, timeouts)) {}

Connection::~Connection() = default;

bool Connection::serve(int fd, const std::string& remoteAddress,
                       const std::function<bool()>& closing) {
    return parser_->serve(fd, remoteAddress, closing);
}

}  // namespace farol::server::http
