#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/options.h"
#include "server/http/message.h"
#include "worker/backend.h"

namespace farol::server {

/// Parameters of a request's query: picture options and those of the route.
struct Parameters {
    render::PictureOptions picture;
    http::Fields given;   ///< picture options as given, sorted by name: part of a picture's key
    bool strict = false;  ///< warnings are errors
    bool formatGiven = false;
    http::Fields own;  ///< parameters in `ownNames`

    std::string ownValue(const std::string& name, const std::string& fallback = "") const;
};

struct ParameterRules {
    bool picture = false;  ///< picture options and `strict` are understood
    bool strict = false;   ///< `strict` alone is
    std::vector<std::string> ownNames;
    http::Fields preset;  ///< options that hold before the query's
};

/// Reads the query, on top of `fromBody` (the JSON of an upload's `options` part, may be empty).
/// Throws Error with every fault found: option.unknown, option.range, option.repeated,
/// option.syntax; each names its field.
Parameters readParameters(const http::Fields& query, const ParameterRules& rules,
                          const std::string& fromBody = "");

/// A whole number in a range, from a parameter. Throws Error option.range.
std::int64_t wholeNumber(const std::string& name, const std::string& value, std::int64_t min,
                         std::int64_t max);

/// Parameters of all routes that render: those of turnOf(), and the form of an error response.
inline const std::vector<std::string> kDrawnNames = {"session", "seq", "onerror"};

/// Returns the session and frame number of a request. Throws Error option.range for a session not
/// 1..64 letters, digits, "-", "." or "_", for a seq that is not a whole number in 0..2^53-1, and
/// where one is given without the other.
worker::Turn turnOf(const Parameters& parameters);

}  // namespace farol::server
