#include "server/request/multipart.h"

#include <algorithm>

#include "core/error.h"
#include "core/text.h"
#include "server/messages.h"

namespace farol::server {
namespace {

using std::string_view;

[[noreturn]] void refuse(Message message) { throw Error(std::move(message)); }

// A token or a quoted string at the start of `rest`, removed from it.
std::optional<std::string> takeValue(string_view& rest) {
    std::string out;
    if (!rest.starts_with('"')) {
        const string_view token = trimmed(rest.substr(0, rest.find(';')), kLineBlanks);
        rest.remove_prefix(std::min(rest.size(), rest.find(';')));
        return std::string(token);
    }
    for (std::size_t i = 1; i < rest.size(); ++i) {
        if (rest[i] == '"') {
            rest.remove_prefix(i + 1);
            return out;
        }
        // Browsers escape quotes as %22, curl as \"; a lone backslash is part of a name.
        if (rest[i] == '\\' && i + 1 < rest.size() && (rest[i + 1] == '"' || rest[i + 1] == '\\'))
            ++i;
        out += rest[i];
    }
    return std::nullopt;
}

// The value of a parameter of "word; name=value; ...".
std::optional<std::string> parameterOf(string_view header, string_view wanted) {
    std::size_t start = header.find(';');
    while (start != string_view::npos) {
        string_view rest = trimmed(header.substr(start + 1), kLineBlanks);
        const std::size_t equals = rest.find('=');
        if (equals == string_view::npos) return std::nullopt;
        const std::string name = lowerCase(trimmed(rest.substr(0, equals), kLineBlanks));
        rest = trimmed(rest.substr(equals + 1), kLineBlanks);
        auto value = takeValue(rest);
        if (!value || name == wanted) return value;
        const std::size_t next = rest.find(';');
        if (next == string_view::npos) return std::nullopt;
        header = rest;
        start = next;
    }
    return std::nullopt;
}

int hexDigit(char c) {
    if (isDigit(c)) return c - '0';
    const char small = lowerCase(c);
    return small >= 'a' && small <= 'f' ? small - 'a' + 10 : -1;
}

// RFC 5987: charset'language'percent-encoded. RFC 7578 forbids it, clients send it all the same.
std::optional<std::string> extendedValue(const std::string& value) {
    const std::size_t first = value.find('\'');
    const std::size_t second = first == std::string::npos ? first : value.find('\'', first + 1);
    if (second == std::string::npos) return std::nullopt;
    std::string bytes;
    for (std::size_t i = second + 1; i < value.size(); ++i) {
        if (value[i] != '%') {
            bytes += value[i];
            continue;
        }
        const int high = i + 2 < value.size() ? hexDigit(value[i + 1]) : -1;
        const int low = i + 2 < value.size() ? hexDigit(value[i + 2]) : -1;
        if (high < 0 || low < 0) return std::nullopt;
        bytes += static_cast<char>(high * 16 + low);
        i += 2;
    }
    const std::string charset = lowerCase(value.substr(0, first));
    if (charset == "iso-8859-1") return latin1ToUtf8(bytes);
    if (charset != "utf-8" || !isUtf8(bytes)) return std::nullopt;
    return bytes;
}

void readHeaderLine(string_view line, Part& part, bool& named) {
    const std::size_t colon = line.find(':');
    if (colon == string_view::npos) refuse(message<"http.multipart/header">());
    const std::string name = lowerCase(trimmed(line.substr(0, colon), kLineBlanks));
    const string_view value = trimmed(line.substr(colon + 1), kLineBlanks);
    if (name == "content-disposition") {
        if (lowerCase(value.substr(0, value.find(';'))) != "form-data")
            refuse(message<"http.multipart/form-data">());
        const auto partName = parameterOf(value, "name");
        named = partName.has_value();
        part.name = partName.value_or("");
        part.fileName = parameterOf(value, "filename").value_or("");
        if (const auto extended = parameterOf(value, "filename*")) {
            const auto fileName = extendedValue(*extended);
            if (!fileName) refuse(message<"http.multipart/extended-name">());
            part.fileName = *fileName;  // RFC 6266: it comes first
        }
    } else if (name == "content-type") {
        part.contentType = lowerCase(trimmed(value.substr(0, value.find(';')), kLineBlanks));
    } else if (name == "content-transfer-encoding" && lowerCase(value) != "binary" &&
               lowerCase(value) != "8bit" && lowerCase(value) != "7bit") {
        refuse(message<"http.multipart/encoding">());  // RFC 7578 section 4.7
    }
}

}  // namespace

std::optional<std::string> boundaryOf(string_view contentType) {
    auto boundary = parameterOf(contentType, "boundary");
    if (!boundary || boundary->empty() || boundary->size() > 70) return std::nullopt;
    return boundary;
}

std::vector<Part> parseMultipart(std::string whole, const std::string& boundary) {
    const std::string delimiter = "\r\n--" + boundary;
    const string_view body = whole;
    std::vector<Part> parts;
    std::vector<string_view> contents;
    // The first delimiter may stand at the very start, without its line end.
    string_view rest = body;
    if (rest.starts_with(string_view(delimiter).substr(2))) {
        rest.remove_prefix(delimiter.size() - 2);
    } else {
        const std::size_t at = rest.find(delimiter);
        if (at == string_view::npos) refuse(message<"http.multipart/no-boundary">());
        rest.remove_prefix(at + delimiter.size());
    }
    for (;;) {
        if (rest.starts_with("--")) break;
        const std::size_t lineEnd = rest.find("\r\n");
        if (lineEnd == string_view::npos || !trimmed(rest.substr(0, lineEnd), kLineBlanks).empty())
            refuse(message<"http.multipart/delimiter">());
        rest.remove_prefix(lineEnd);  // keeps the CRLF: an empty head is "\r\n\r\n"
        const std::size_t headEnd = rest.find("\r\n\r\n");
        if (headEnd == string_view::npos) refuse(message<"http.multipart/head">());
        if (headEnd > kMaxPartHead)
            refuse(message<"http.multipart/head-size">("max"_arg = kMaxPartHead));
        Part part;
        bool named = false;
        for (string_view head = rest.substr(0, headEnd); !head.empty();) {
            head.remove_prefix(2);
            const string_view line = head.substr(0, head.find("\r\n"));
            head.remove_prefix(line.size());
            readHeaderLine(line, part, named);
        }
        if (!named) refuse(message<"http.multipart/name">());
        rest.remove_prefix(headEnd + 2);
        const std::size_t end = rest.find(delimiter);
        if (end == string_view::npos) refuse(message<"http.multipart/cut-off">());
        contents.push_back(end >= 2 ? rest.substr(2, end - 2) : string_view{});
        rest.remove_prefix(end + delimiter.size());
        if (parts.size() == kMaxParts)
            refuse(message<"http.multipart/parts">("max"_arg = kMaxParts));
        parts.push_back(std::move(part));
    }
    if (parts.empty()) return parts;
    const auto largest =
        std::max_element(contents.begin(), contents.end(),
                         [](string_view a, string_view b) { return a.size() < b.size(); });
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (contents[i].data() != largest->data()) parts[i].content = std::string(contents[i]);
    const auto begin = static_cast<std::size_t>(largest->data() - whole.data());
    std::string& content = parts[static_cast<std::size_t>(largest - contents.begin())].content;
    if (largest->empty()) return parts;
    whole.resize(begin + largest->size());
    whole.erase(0, begin);
    content = std::move(whole);
    return parts;
}

}  // namespace farol::server
