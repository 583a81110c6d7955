#include "server/http/arrival.h"

#include <string_view>
#include <utility>

#include "server/messages.h"

namespace farol::server::http {
namespace {

// A blank line or two before a request are allowed (RFC 9112 section 2.2).
constexpr std::size_t kMaxBlankLines = 8;

std::size_t blankLines(std::string_view text) {
    std::size_t count = 0;
    while (text.substr(2 * count).starts_with("\r\n")) ++count;
    return count;
}

}  // namespace

Arrival::State Arrival::state() const {
    if (!begun_) return State::nothing;
    if (!head_) return State::head;
    return body_ && body_->state() == BodyReader::State::more ? State::body : State::whole;
}

void Arrival::refuse(Refusal refusal) {
    head_->refusal = std::move(refusal);
    headAt_ = Clock::now();
}

void Arrival::readHead(std::string& in) {
    if (const std::size_t blank = blankLines(in); blank > 0) {
        in.erase(0, 2 * blank);
        blankLines_ += blank;
        if (blankLines_ > kMaxBlankLines) {
            begun_ = true;
            head_ = checkHead("");
            refuse({400, message<"http.syntax/blank-lines">()});
            std::string().swap(in);
            return;
        }
    }
    if (in.empty()) return;
    if (!std::exchange(begun_, true)) since_ = Clock::now();
    const std::size_t end = in.find("\r\n\r\n", searched_);
    if (end == std::string::npos ? in.size() >= kMaxHead : end + 4 > kMaxHead) {
        head_ = checkHead(in);
        refuse(in.find("\r\n") == std::string::npos
                   ? Refusal{414, message<"http.uri-too-long">("max"_arg = kMaxHead)}
                   : Refusal{431, message<"http.head">("max"_arg = kMaxHead)});
        std::string().swap(in);
        return;
    }
    searched_ = in.size() < 3 ? 0 : in.size() - 3;
    if (end == std::string::npos) return;
    head_ = checkHead(std::string_view(in).substr(0, end + 4));
    in.erase(0, end + 4);
    headAt_ = since_ = Clock::now();
    // If the request is refused with any body, that reason is more useful than the missing
    // length.
    if (head_->refusal && head_->refusal->status == 411 && handler_->bodyLimit(head_->request) == 0)
        head_->takeAsEmpty();
    if (head_->refusal || !head_->mayHaveBody() || !head_->hasBody()) return;
    body_.emplace(head_->contentLength, handler_->bodyLimit(head_->request));
    sayContinue_ = head_->expectsContinue && body_->state() == BodyReader::State::more;
}

void Arrival::feed(std::string& in) {
    if (!head_) readHead(in);
    if (state() == State::body && !in.empty()) {
        in.erase(0, body_->feed(in));
        sayContinue_ = false;  // it did not wait for "100 Continue"
    }
    // An idle connection has no buffer.
    if (in.empty()) std::string().swap(in);
}

void Arrival::giveUp(std::string& in) {
    if (state() == State::head) {
        head_ = checkHead(in);
        refuse({408, message<"http.timeout">()});
        std::string().swap(in);
    } else if (body_) {
        body_->giveUp();
    }
}

bool Arrival::mustSayContinue() { return std::exchange(sayContinue_, false); }

Incoming Arrival::take() {
    Incoming out{std::move(*head_), "", BodyReader::State::whole, headAt_};
    if (body_) {
        out.bodyState = body_->state();
        out.body = body_->take();
    }
    *this = Arrival(*handler_);
    return out;
}

}  // namespace farol::server::http
