#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// multipart/form-data by RFC 7578, on a body that is already in memory and bounded.
namespace farol::server {

struct Part {
    std::string name;
    std::string fileName;     ///< filename*, else filename, as sent; empty for a plain field
    std::string contentType;  ///< lower case, without parameters; may be empty
    std::string content;
};

inline constexpr std::size_t kMaxParts = 4096;
inline constexpr std::size_t kMaxPartHead = 8 * 1024;

/// The boundary of a Content-Type header, or nothing when it has none or a malformed one.
std::optional<std::string> boundaryOf(std::string_view contentType);

/// The parts in order; the largest takes over the body's memory. Throws Error http.multipart when
/// the body is not such a document or has more than kMaxParts.
std::vector<Part> parseMultipart(std::string body, const std::string& boundary);

}  // namespace farol::server
