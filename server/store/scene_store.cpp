#include "server/store/scene_store.h"

#include <algorithm>

#include "scene/error.h"

namespace farol::server::store {

std::string idOf(const scene::Bundle& bundle) { return "~" + scene::digestOf(bundle); }

bool isStoredId(const std::string& id) {
    constexpr std::size_t kDigits = 32;
    return id.size() == kDigits + 1 && id.front() == '~' &&
           std::all_of(id.begin() + 1, id.end(),
                       [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
}

void refuseLargerThan(const StoreLimits& limits, std::uint64_t bytes) {
    if (bytes > limits.bytes)
        throw Error("limit.store", "The scene with its files has " + std::to_string(bytes) +
                                       " bytes; the store takes " + std::to_string(limits.bytes) +
                                       " at most.");
}

}  // namespace farol::server::store
