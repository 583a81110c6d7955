#include "server/etag.h"

#include "core/digest.h"

namespace farol::server {

std::string entityTag(const std::vector<std::string_view>& parts) {
    std::string all;
    for (const std::string_view part : parts)
        all.append(std::to_string(part.size())).append(":").append(part);
    return "\"" + contentDigest(all) + "\"";
}

bool matchesTag(const std::optional<std::string>& header, const std::string& tag) {
    if (!header) return false;
    std::string_view rest = *header;
    while (!rest.empty()) {
        const std::size_t start = rest.find_first_not_of(" \t,");
        if (start == std::string_view::npos) return false;
        rest.remove_prefix(start);
        if (rest.starts_with('*')) return true;
        if (rest.starts_with("W/")) rest.remove_prefix(2);
        if (rest.starts_with(tag)) return true;  // the tag ends with its quote
        const std::size_t open = rest.find('"');
        const std::size_t close = open == std::string_view::npos ? open : rest.find('"', open + 1);
        if (close == std::string_view::npos) return false;
        rest.remove_prefix(close + 1);
    }
    return false;
}

}  // namespace farol::server
