#pragma once

#include <string_view>

#include "core/error.h"

namespace farol::grade {

/// Returns line and column of the value that a JSON pointer (RFC 6901) names in `text`; of the
/// deepest value on the way where the pointer leads nowhere. Precondition: `text` is JSON that
/// parseJson accepts.
Location placeIn(std::string_view text, std::string_view pointer);

}  // namespace farol::grade
