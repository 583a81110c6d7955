#include "server/http/body_reader.h"

#include <algorithm>
#include <charconv>
#include <new>

namespace farol::server::http {
namespace {
// Of a line with a chunk's size and its extension.
constexpr std::size_t kMaxLine = 256;
constexpr std::size_t kMaxSizeDigits = 16;
// Of all extensions and leading zeros together: bounds the cost of a body with few bytes.
constexpr std::size_t kMaxExtensions = 16 * 1024;
}  // namespace

BodyReader::BodyReader(std::optional<std::uint64_t> length, std::size_t maxBytes)
    : maxBytes_(maxBytes),
      chunked_(!length),
      left_(length.value_or(0)),
      part_(chunked_ ? Part::sizeLine : Part::data) {
    if (left_ > maxBytes_)
        state_ = State::tooLarge;
    else if (!chunked_ && left_ == 0)
        state_ = State::whole;
}

void BodyReader::giveUp() {
    if (state_ == State::more) state_ = State::broken;
}

void BodyReader::append(std::string_view bytes) {
    body_.append(bytes);
    left_ -= bytes.size();
    if (left_ > 0) return;
    part_ = Part::dataEnd;
    if (!chunked_) state_ = State::whole;
}

// A line without its CRLF is in line_.
void BodyReader::lineDone() {
    if (part_ != Part::sizeLine) {
        if (!line_.empty())
            state_ = State::broken;
        else if (part_ == Part::end)
            state_ = State::whole;
        part_ = Part::sizeLine;
        return;
    }
    const char* const last = line_.data() + line_.size();
    const auto [end, fault] = std::from_chars(line_.data(), last, left_, 16);
    extensions_ += line_.size() - std::min(line_.size(), kMaxSizeDigits);
    const bool isSize = fault == std::errc{} && (end == last || *end == ';') && line_[0] != '-';
    if (fault == std::errc::result_out_of_range ||
        (isSize && left_ > maxBytes_ - std::min(maxBytes_, body_.size())))
        state_ = State::tooLarge;
    else if (!isSize || extensions_ > kMaxExtensions)
        state_ = State::broken;
    else
        part_ = left_ > 0 ? Part::data : Part::end;
    line_.clear();
}

std::size_t BodyReader::feed(std::string_view bytes) {
    std::size_t at = 0;
    try {
        read(bytes, at);
    } catch (const std::bad_alloc&) {
        std::string().swap(body_);
        state_ = State::noMemory;
    }
    return at;
}

void BodyReader::read(std::string_view bytes, std::size_t& at) {
    while (state_ == State::more && at < bytes.size()) {
        if (part_ == Part::data) {
            const std::size_t count = std::min<std::uint64_t>(left_, bytes.size() - at);
            append(bytes.substr(at, count));
            at += count;
            continue;
        }
        const char c = bytes[at++];
        if (!line_.empty() && line_.back() == '\r') {
            if (c != '\n') {
                state_ = State::broken;
            } else {
                line_.pop_back();
                lineDone();
            }
        } else if (c == '\n' || line_.size() >= kMaxLine) {
            state_ = State::broken;
        } else {
            line_ += c;
        }
    }
}

}  // namespace farol::server::http
