#pragma once

#include "render/gl_source.h"
#include "worker/sandbox.h"

/// The program as a worker: `farol worker`, started by the pool only.
namespace farol::worker {

/// Serves jobs over kSocket until the other end closes it. Returns the exit code. `maxCost` and
/// `source` as in WorkerState.
int runWorker(const SandboxOptions& options, double maxCost, render::GlSource source);

/// Enters the sandbox of a worker, or of the command line, tries forbidden actions, and prints a
/// JSON object with the outcome of each to stdout: the name of the error, or "done". `probe`: a
/// file of the test, readable before, in a writable folder.
int runSelfTest(const SandboxOptions& options, const std::string& probe, bool asCommandLine);

}  // namespace farol::worker
