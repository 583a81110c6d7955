#pragma once

#include <optional>
#include <string>

#include "server/request/parameters.h"

namespace farol::server {

/// The quality, 0..1, that an Accept header gives a media type ("image/png"); 1 without a header.
/// RFC 9110 section 12.5.1.
double acceptedQuality(const std::optional<std::string>& accept, const std::string& type);

/// If the query names no format, chooses the one that the client prefers, PNG first. Throws Error
/// http.not-acceptable when the client accepts none, or not the named one.
void chooseFormat(Parameters& wanted, const std::optional<std::string>& accept);

}  // namespace farol::server
