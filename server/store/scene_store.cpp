#include "server/store/scene_store.h"

#include <algorithm>

#include "core/error.h"
#include "core/text.h"
#include "server/messages.h"

namespace farol::server::store {

std::string idOf(const scene::Bundle& bundle) { return "~" + scene::digestOf(bundle); }

bool isStoredId(const std::string& id) {
    constexpr std::size_t kDigits = 32;
    return id.size() == kDigits + 1 && id.front() == '~' &&
           std::all_of(id.begin() + 1, id.end(),
                       [](char c) { return isDigit(c) || (c >= 'a' && c <= 'f'); });
}

void refuseLargerThan(const StoreLimits& limits, std::uint64_t bytes) {
    if (bytes > limits.bytes)
        throw Error(message<"limit.store">("count"_arg = bytes, "max"_arg = limits.bytes));
}

}  // namespace farol::server::store
