#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace farol::server {

/// A strong entity tag, quotes included, that names all of `parts`: their order and their borders
/// count.
std::string entityTag(const std::vector<std::string_view>& parts);

/// True if an If-None-Match header (a list of tags, or *) covers `tag`; weak comparison, by
/// RFC 9110 section 13.1.2.
bool matchesTag(const std::optional<std::string>& header, const std::string& tag);

}  // namespace farol::server
