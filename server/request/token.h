#pragma once

#include <optional>
#include <string>

#include "server/http/message.h"

namespace farol::server {

/// Throws Error http.unauthorized unless the request shows the token; an empty one asks for none.
void requireToken(const http::Request& request, const std::string& token);

/// The same for what students must not see: throws Error assignment.no-token where the server has
/// no token.
void requireTeacher(const http::Request& request, const std::string& token);

/// Returns the value of "Authorization: Bearer VALUE", or nothing.
std::optional<std::string> bearerOf(const http::Request& request);

}  // namespace farol::server
