#pragma once

#include "core/message.h"

namespace farol {

inline constexpr MessageRow kCoreMessages[] = {
    {"limit.diagnostics", "{count} more findings are not shown", {"17"}},
    {"part.more-like-these", "{count} more like the {shown} shown", {"12", "5"}},
    {"part.number-empty", "is empty; expected a number"},
    {"part.number-not", "is not a number[; write \"{suggestion}\"]", {"60"}},
    {"part.number-comma", "has a decimal comma; write \"{suggestion}\"", {"1.5"}},
    {"part.number-large", "is too large; the largest number is {max}", {"1e18"}},
    {"part.number-infinite", "is not a finite number"},
};

/// A message of core's table, for core and for every floor above it.
template <FixedString kId, FixedString... kNames>
Message coreMessage(const NamedArgument<kNames>&... arguments) {
    return makeMessage<kId, kCoreMessages>(arguments...);
}

}  // namespace farol
