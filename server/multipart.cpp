#include "server/multipart.h"

#include <algorithm>

#include "scene/error.h"
#include "server/http/text.h"

namespace farol::server {
namespace {

using http::trim;
using std::string_view;

[[noreturn]] void refuse(const std::string& why) {
    throw Error("http.multipart", "The multipart body " + why + ".");
}

std::string lower(string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return out;
}

// A token or a quoted string at the start of `rest`, removed from it.
std::optional<std::string> takeValue(string_view& rest) {
    std::string out;
    if (!rest.starts_with('"')) {
        const string_view token = trim(rest.substr(0, rest.find(';')));
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
        string_view rest = trim(header.substr(start + 1));
        const std::size_t equals = rest.find('=');
        if (equals == string_view::npos) return std::nullopt;
        const std::string name = lower(trim(rest.substr(0, equals)));
        rest = trim(rest.substr(equals + 1));
        auto value = takeValue(rest);
        if (!value || name == wanted) return value;
        const std::size_t next = rest.find(';');
        if (next == string_view::npos) return std::nullopt;
        header = rest;
        start = next;
    }
    return std::nullopt;
}

void readHeaderLine(string_view line, Part& part, bool& named) {
    const std::size_t colon = line.find(':');
    if (colon == string_view::npos) refuse("has a part with an unreadable header");
    const std::string name = lower(trim(line.substr(0, colon)));
    const string_view value = trim(line.substr(colon + 1));
    if (name == "content-disposition") {
        if (lower(value.substr(0, value.find(';'))) != "form-data")
            refuse("has a part that is not form-data");
        const auto partName = parameterOf(value, "name");
        named = partName.has_value();
        part.name = partName.value_or("");
        part.fileName = parameterOf(value, "filename").value_or("");
    } else if (name == "content-type") {
        part.contentType = lower(trim(value.substr(0, value.find(';'))));
    } else if (name == "content-transfer-encoding" && lower(value) != "binary" &&
               lower(value) != "8bit" && lower(value) != "7bit") {
        refuse("has a part in a transfer encoding, which RFC 7578 forbids");
    }
}

}  // namespace

std::optional<std::string> boundaryOf(string_view contentType) {
    auto boundary = parameterOf(contentType, "boundary");
    if (!boundary || boundary->empty() || boundary->size() > 70) return std::nullopt;
    return boundary;
}

std::vector<Part> parseMultipart(string_view body, const std::string& boundary) {
    const std::string delimiter = "\r\n--" + boundary;
    std::vector<Part> parts;
    // The first delimiter may stand at the very start, without its line end.
    string_view rest = body;
    if (rest.starts_with(string_view(delimiter).substr(2))) {
        rest.remove_prefix(delimiter.size() - 2);
    } else {
        const std::size_t at = rest.find(delimiter);
        if (at == string_view::npos) refuse("does not hold its boundary");
        rest.remove_prefix(at + delimiter.size());
    }
    for (;;) {
        if (rest.starts_with("--")) return parts;
        const std::size_t lineEnd = rest.find("\r\n");
        if (lineEnd == string_view::npos || !trim(rest.substr(0, lineEnd)).empty())
            refuse("is cut off or has a damaged boundary");
        rest.remove_prefix(lineEnd);  // keeps the CRLF: an empty head is "\r\n\r\n"
        const std::size_t headEnd = rest.find("\r\n\r\n");
        if (headEnd == string_view::npos) refuse("is cut off in the head of a part");
        if (headEnd > kMaxPartHead) refuse("has a part whose head is too large");
        Part part;
        bool named = false;
        for (string_view head = rest.substr(0, headEnd); !head.empty();) {
            head.remove_prefix(2);
            const string_view line = head.substr(0, head.find("\r\n"));
            head.remove_prefix(line.size());
            readHeaderLine(line, part, named);
        }
        if (!named) refuse("has a part without a name");
        rest.remove_prefix(headEnd + 2);
        const std::size_t end = rest.find(delimiter);
        if (end == string_view::npos) refuse("is cut off");
        if (end >= 2) part.content = std::string(rest.substr(2, end - 2));
        rest.remove_prefix(end + delimiter.size());
        if (parts.size() == kMaxParts)
            refuse("has more than " + std::to_string(kMaxParts) + " parts");
        parts.push_back(std::move(part));
    }
}

}  // namespace farol::server
