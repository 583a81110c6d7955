#pragma once

#include <optional>
#include <string>

#include "core/language.h"
#include "server/request/parameters.h"

namespace farol::server {

/// The quality, 0..1, that an Accept header gives a media type ("image/png"); 1 without a header.
/// RFC 9110 section 12.5.1.
double acceptedQuality(const std::optional<std::string>& accept, const std::string& type);

/// Returns the language that an Accept-Language header prefers (RFC 9110 section 12.5.4): the
/// highest quality, the first of equals. "pt-BR" is pt, "*" English; English if it names no known
/// one.
Language acceptedLanguage(const std::optional<std::string>& header);
/// The same of a request.
Language languageOf(const http::Request& request);

/// Adds Content-Language and Vary to a response with messages in `language`.
void setLanguage(http::Response& response, Language language);

/// If the query names no format, chooses the one that the client prefers, PNG first. Throws Error
/// http.not-acceptable when the client accepts none, or not the named one.
void chooseFormat(Parameters& wanted, const std::optional<std::string>& accept);

}  // namespace farol::server
