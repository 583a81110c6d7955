#include "server/descriptor_limit.h"

#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>

#include "core/error.h"
#include "server/messages.h"

namespace farol::server {
namespace {

// Standard streams, socket, epoll, inotify, the store's lock, the workers' output; libraries.
constexpr std::uint64_t kBase = 32;
constexpr std::uint64_t kPerThread = 2, kPerProcess = 2;
constexpr int kMinConnections = 16;

}  // namespace

std::uint64_t raiseDescriptorLimit() {
    rlimit limit{};
    if (::getrlimit(RLIMIT_NOFILE, &limit) != 0)
        throw std::system_error(errno, std::generic_category(), "cannot read RLIMIT_NOFILE");
    const rlimit raised{limit.rlim_max, limit.rlim_max};
    if (limit.rlim_cur < limit.rlim_max && ::setrlimit(RLIMIT_NOFILE, &raised) == 0) limit = raised;
    return limit.rlim_cur;
}

int connectionsWithin(std::uint64_t limit, const DescriptorUse& use, int wanted, bool isSet) {
    const std::uint64_t reserved = kBase + kPerThread * static_cast<std::uint64_t>(use.threads) +
                                   kPerProcess * static_cast<std::uint64_t>(use.processes);
    const std::uint64_t room = limit > reserved ? limit - reserved : 0;
    const int least = isSet ? wanted : std::min(wanted, kMinConnections);
    if (room < static_cast<std::uint64_t>(least))
        throw Error(message<"option.range/descriptors">(
                        "limit"_arg = limit, "reserved"_arg = reserved, "threads"_arg = use.threads,
                        "workers"_arg = use.processes, "connections"_arg = least),
                    {}, "max-connections");
    return static_cast<int>(std::min<std::uint64_t>(room, static_cast<std::uint64_t>(wanted)));
}

}  // namespace farol::server
