#pragma once

#include <cstdint>

/// Descriptors of the service's process: the settings never need more than there are.
namespace farol::server {

/// Raises the soft limit (RLIMIT_NOFILE) to the hard one; returns the limit.
std::uint64_t raiseDescriptorLimit();

struct DescriptorUse {
    int threads = 0;    ///< that handle requests: each may have a file and its folder open
    int processes = 0;  ///< workers and spares
};

/// Returns the connections that `limit` descriptors allow, at most `wanted`. Throws Error
/// option.range where they are too few: for `wanted` if the caller has set it (`isSet`), else for
/// any service.
int connectionsWithin(std::uint64_t limit, const DescriptorUse& use, int wanted, bool isSet);

}  // namespace farol::server
