#include "server/http/connection.h"

#include <httplib.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <ctime>
#include <new>
#include <random>

#include "core/error.h"
#include "server/messages.h"

namespace farol::server::http {
namespace {

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

// Prevents header injection: cuts a value at its first control character.
std::string headerValue(const std::string& value) {
    const auto end = std::find_if(value.begin(), value.end(), [](char c) {
        return (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7F;
    });
    return std::string(value.begin(), end);
}

/// Stream of the library: it reads the cleaned head, and writes to the link.
class Exchange final : public httplib::Stream {
  public:
    Exchange(Link& link, std::string head) : link_(link), head_(std::move(head)) {}

    bool is_readable() const override { return taken_ < head_.size(); }
    bool is_writable() const override { return !link_.isBroken(); }
    ssize_t read(char* target, size_t size) override {
        const std::size_t count = head_.copy(target, size, taken_);
        taken_ += count;
        return static_cast<ssize_t>(count);
    }
    ssize_t write(const char* source, size_t size) override {
        link_.put({source, size});
        return link_.isBroken() ? -1 : static_cast<ssize_t>(size);
    }
    // The peer's address is read when the socket is accepted, not here.
    void get_remote_ip_and_port(std::string& ip, int& port) const override { none(ip, port); }
    void get_local_ip_and_port(std::string& ip, int& port) const override { none(ip, port); }
    /// The library only compares it with FD_SETSIZE, for select(), which is not used here.
    socket_t socket() const override { return 0; }

    // Newer releases of the library ask for these; in older ones they override nothing.
    bool wait_readable() const { return is_readable(); }
    bool wait_writable() const { return is_writable(); }
    time_t duration() const { return 0; }

  private:
    static void none(std::string& ip, int& port) {
        ip.clear();
        port = 0;
    }

    Link& link_;
    const std::string head_;
    std::size_t taken_ = 0;
};

/// The body of a request as far as it has arrived.
class Arrived final : public Body {
  public:
    explicit Arrived(Incoming& incoming) : incoming_(incoming) {}

    std::string read(std::size_t maxBytes) override {
        using State = BodyReader::State;
        const State state = std::exchange(incoming_.bodyState, State::broken);
        if (state == State::tooLarge || incoming_.body.size() > maxBytes)
            throw Error(message<"limit.body">("max"_arg = maxBytes));
        if (state == State::noMemory) throw std::bad_alloc();
        if (state != State::whole) throw Error(message<"http.body">());
        return std::move(incoming_.body);
    }

  private:
    Incoming& incoming_;
};

}  // namespace

std::string newRequestId() {
    static std::atomic<std::uint64_t> next{std::random_device{}() * 0x100000000ULL};
    char text[24];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(next.fetch_add(1)));
    return text;
}

/// The library's server without its sockets: parses a head that head.cpp has checked and writes
/// the response of the Handler. It never reads a body.
class Connection::Parser final : public httplib::Server {
  public:
    explicit Parser(http::Handler& handler) : handler_(handler) {
        set_pre_routing_handler([this](const httplib::Request&, httplib::Response& out) {
            const Head& head = incoming_->head;
            Arrived body(*incoming_);
            if (const auto& refusal = head.refusal)
                answer(handler_.refuse(head.request, refusal->status, refusal->message), out);
            else
                answer(handler_.handle(head.request, body), out);
            return HandlerResponse::Handled;
        });
        set_error_handler(
            HandlerWithResponse([this](const httplib::Request&, httplib::Response& out) {
                if (answered_) return HandlerResponse::Unhandled;
                keep_ = false;
                const int status = out.status;
                answer(handler_.refuse(incoming_->head.request, status,
                                       message<"http.syntax/request">()),
                       out);
                return HandlerResponse::Handled;
            }));
        set_exception_handler(
            [this](const httplib::Request&, httplib::Response& out, std::exception_ptr) {
                keep_ = false;
                answer(handler_.refuse(incoming_->head.request, 500, message<"internal">()), out);
            });
        set_post_routing_handler([this](const httplib::Request&, httplib::Response& out) {
            for (const char* name : {"Connection", "Keep-Alive", "Accept-Ranges"})
                out.headers.erase(name);
            if (out.status == 304 || out.status == 204) out.headers.erase("Content-Length");
            if (shared_) {
                out.headers.erase("Content-Length");
                out.headers.emplace("Content-Length", std::to_string(shared_->size()));
            }
            if (!keep_) out.headers.emplace("Connection", "close");
        });
    }

    Answered serve(Link& link, Incoming incoming, const std::atomic<bool>& isClosing) {
        incoming_ = &incoming;
        link_ = &link;
        isClosing_ = &isClosing;
        Head& head = incoming.head;
        if (head.request.id.empty()) head.request.id = newRequestId();
        answered_ = false;
        shared_.reset();
        // The rest of a body must not be read as the next request.
        isCut_ = incoming.bodyState != BodyReader::State::whole ||
                 (head.hasBody() && !head.mayHaveBody());
        keep_ = head.keepAlive && !isCut_ && !head.refusal;
        // A refused request is replaced by a plain one: the library must not parse it.
        Exchange stream(link, !head.refusal ? std::move(head.cleaned)
                              : head.isHead ? "HEAD / HTTP/1.1\r\n\r\n"
                                            : "GET / HTTP/1.1\r\n\r\n");
        bool closed = false;
        const bool written = process(stream, closed);
        // A shared body is sent directly, since the library would copy it.
        if (shared_ && !head.isHead) link.put(*shared_);
        shared_.reset();
        link.flush();
        incoming_ = nullptr;
        return {std::move(head.request), std::move(last_), incoming.since, keep_ && written,
                isCut_ || head.refusal};
    }

  private:
    // Newer releases have parameters for the addresses of both ends as well.
    template <typename Stream>
    bool process(Stream& stream, bool& closed) {
        const auto untouched = [](httplib::Request& request) { request.path = "/"; };
        if constexpr (requires { this->process_request(stream, false, closed, untouched); })
            return this->process_request(stream, false, closed, untouched);
        else
            return this->process_request(stream, std::string(), 0, std::string(), 0, false, closed,
                                         untouched);
    }

    void answer(Response response, httplib::Response& out) {
        answered_ = true;
        if (response.status >= 400 || *isClosing_) keep_ = false;
        if (response.hold.count() > 0 && !*isClosing_) link_->hold();
        out.headers.clear();
        out.status = response.status;
        for (const auto& [name, value] : response.headers)
            out.headers.emplace(name, headerValue(value));
        out.headers.emplace("Date", httpDate(std::time(nullptr)));
        const std::size_t length = response.shared ? response.shared->size() : response.body.size();
        if (!response.contentType.empty())
            out.headers.emplace("Content-Type", response.contentType);
        out.body = std::move(response.body);
        shared_ = std::move(response.shared);
        response.logged.emplace(response.logged.begin(), "bytes",
                                static_cast<std::int64_t>(length));
        response.body.clear();
        last_ = std::move(response);
    }

    http::Handler& handler_;
    Incoming* incoming_ = nullptr;
    Link* link_ = nullptr;
    const std::atomic<bool>* isClosing_ = nullptr;
    Response last_;
    std::shared_ptr<const std::string> shared_;  ///< the body of this response
    bool answered_ = false, isCut_ = false, keep_ = true;
};

Connection::Connection(Handler& handler) : parser_(std::make_unique<Parser>(handler)) {}

Connection::~Connection() = default;

Answered Connection::answer(Link& link, Incoming incoming, const std::atomic<bool>& isClosing) {
    return parser_->serve(link, std::move(incoming), isClosing);
}

}  // namespace farol::server::http
