#pragma once

#include <string>

#include "server/http/message.h"

namespace farol::server {

/// Throws Error http.unauthorized unless the request shows the token; an empty one asks for none.
void requireToken(const http::Request& request, const std::string& token);

}  // namespace farol::server
