#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace farol::server {

/// Returns a strong entity tag, with quotes: a digest of all `parts`, which depends on their order
/// and borders.
std::string entityTag(const std::vector<std::string_view>& parts);

/// True if an If-None-Match header (a list of tags, or *) covers `tag`; weak comparison, by
/// RFC 9110 section 13.1.2.
bool matchesTag(const std::optional<std::string>& header, const std::string& tag);

}  // namespace farol::server
