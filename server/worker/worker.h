#pragma once

#include "server/worker/sandbox.h"

/// The program as a worker: `farol worker`, started by the pool only.
namespace farol::server::worker {

/// Serves jobs over kSocket until the other end closes it. Returns the exit code.
int runWorker(const SandboxOptions& options);

/// Closes itself in as a worker does, tries what a worker must not do, and prints a JSON object of
/// what came of each to stdout: the name of the error, or "done". `probe` is a file of the test's
/// own: it must be readable before, its folder writable.
int runSelfTest(const SandboxOptions& options, const std::string& probe);

}  // namespace farol::server::worker
