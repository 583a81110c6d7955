#include "server/http/message.h"

namespace farol::server::http {

std::optional<std::string> Request::header(std::string_view name) const {
    for (const auto& [key, value] : headers)
        if (key == name) return value;
    return std::nullopt;
}

}  // namespace farol::server::http
