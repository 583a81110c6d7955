#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/language.h"
#include "server/context.h"
#include "server/router.h"

/// Answers that several routes give.
namespace farol::server {

/// JSON, indented.
http::Response jsonResponse(const nlohmann::json& value);
/// Returns JSON that no cache keeps: the response to a request with a body.
http::Response freshJson(const nlohmann::json& value);
/// The same with messages in a language.
http::Response freshJson(const nlohmann::json& value, Language language);
/// The body with its tag, or 304.
http::Response tagged(const Call& call, std::string body, const std::string& type);
/// JSON with messages in a language, on which the tag depends, too.
http::Response taggedJson(const Call& call, const nlohmann::json& value, Language language);
/// Throws Error option.unknown where there is any parameter.
void refuseParameters(const Call& call);

}  // namespace farol::server
