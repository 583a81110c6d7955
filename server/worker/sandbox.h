#pragma once

#include <string>
#include <vector>

#include "server/backend.h"

/// What a worker may still do once it is closed in: compute, read below the folders it was given,
/// and speak over the one socket it was born with (docs/operations.md has the threats).
namespace farol::server::worker {

struct SandboxOptions {
    std::vector<std::string> readable;  ///< folders of scenes; may be empty
    std::size_t memoryBytes = 0;        ///< of private memory; 0: no cap
};

/// To be called before the first thread: threads inherit what is set here. Sets resource limits,
/// no_new_privs, the death signal, and Landlock rules that leave the system's libraries, the
/// readable folders and Mesa's shader cache. Adds a layer each to `layers`.
void enterSandbox(const SandboxOptions& options, Layers& layers);

/// To be called when there is a GL context and it has drawn: from here on no file is opened for
/// writing, no process and no socket is made (seccomp, for all threads), and this thread reads
/// below `options.readable` and from Mesa's shader cache only.
void closeSandbox(const SandboxOptions& options, Layers& layers);

/// The layers of landlock.cpp. `writable` folders may be written to as well. Returns "abi N", or
/// "missing: why".
std::string restrictFiles(const std::vector<std::string>& readable,
                          const std::vector<std::string>& writable);

/// The layer of seccomp.cpp. Returns "on", or "missing: why".
std::string restrictCalls(int socket);

/// The descriptor that a worker speaks over.
inline constexpr int kSocket = 3;

}  // namespace farol::server::worker
