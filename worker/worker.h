#pragma once

#include "render/gl_source.h"
#include "worker/sandbox.h"

/// The program as a worker: `farol worker`, started by the pool only.
namespace farol::worker {

/// Serves jobs over kSocket until the other end closes it. Returns the exit code. `maxCost` and
/// `source` as in WorkerState.
int runWorker(const SandboxOptions& options, double maxCost, render::GlSource source);

/// Closes itself in as a worker does, or as the command line, tries forbidden actions, and prints a
/// JSON object with the outcome of each to stdout: the name of the error, or "done". `probe` is a
/// file of the test's: readable before, its folder writable.
int runSelfTest(const SandboxOptions& options, const std::string& probe, bool asCommandLine);

}  // namespace farol::worker
