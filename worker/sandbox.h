#pragma once

#include <string>
#include <vector>

#include "worker/hello.h"

/// The rights of a sandboxed worker: compute, read below the folders of its configuration,
/// and use the one socket that it inherited (docs/explanation/sandbox.md has the threats).
namespace farol::worker {

struct SandboxOptions {
    std::vector<std::string> readable;  ///< folders of scenes; may be empty
    std::size_t memoryBytes = 0;        ///< of private memory; 0: no cap
};

/// To be called before the first thread: threads inherit these settings. Sets resource limits,
/// no_new_privs, the death signal, and Landlock rules that allow the system's libraries, the
/// readable folders and Mesa's shader cache. Adds a layer each to `layers`.
void enterSandbox(const SandboxOptions& options, Layers& layers);

/// To be called when there is a GL context and it has drawn: from here on no file is opened for
/// writing, no process and no socket is made (seccomp, for all threads), and this thread reads
/// below `options.readable` and from Mesa's shader cache only.
void closeSandbox(const SandboxOptions& options, Layers& layers);

/// Closes in a process of the command line, before its first thread: the same layers in one step.
/// Mesa's shader cache may be written where Landlock confines the writing to it.
Layers closeCommandLine(const SandboxOptions& options);

/// Restricts files by Landlock. `writable` folders may be written as well as read. Returns "abi N",
/// or "missing: why".
std::string restrictFiles(const std::vector<std::string>& readable,
                          const std::vector<std::string>& writable);

/// Restricts calls by seccomp for all threads; sending and receiving is left for `socket` alone.
/// `writesCache` leaves creating and writing files, for Landlock to confine. Returns "on", or
/// "missing: why".
std::string restrictCalls(int socket, bool writesCache = false);

/// The descriptor that a worker speaks over.
inline constexpr int kSocket = 3;

}  // namespace farol::worker
