#pragma once

#include <string_view>

namespace farol::server::http {

/// Without the blanks and tabs (OWS of RFC 9110) at both ends.
inline std::string_view trim(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
    return text;
}

}  // namespace farol::server::http
