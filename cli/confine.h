#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/report.h"
#include "worker/backend.h"

/// Commands read files of strangers in a child process that is closed in as the service's workers
/// are (docs/explanation/sandbox.md). The parent writes its outputs and reports its crash.
namespace farol::cli {

/// The flags of a command about its sandbox.
struct ConfinementFlags {
    bool isOff = false;
    std::size_t memoryMiB = 4'096;  ///< private memory of the child; 0: no cap
};

/// Adds --no-sandbox and --worker-memory.
void addConfinement(CLI::App& command, ConfinementFlags& flags);

struct Confinement {
    ConfinementFlags flags;
    std::vector<std::string> readable;  ///< folders that the child may read
    std::vector<std::string> outputs;   ///< paths it may write, see framePath
    /// Processes beside the child that share its work, closed in as it is; none where the sandbox
    /// is off.
    int helpers = 0;
};

inline constexpr int kNoFrame = -1;

/// Where confined work writes its outputs and finds the state of its sandbox.
class Outputs {
  public:
    virtual ~Outputs() = default;
    /// Writes output number `output` of the Confinement; with a frame, its number replaces the %d
    /// of the path. Throws OutputError.
    virtual void write(std::size_t output, std::string_view bytes, int frame = kNoFrame) = 0;
    /// Layers of the sandbox and their state; empty where it is off.
    virtual const worker::Layers& layers() const = 0;
    /// Descriptors to read from the helpers by, in their order.
    virtual const std::vector<int>& helpers() const = 0;
};

using ConfinedWork = std::function<int(Outputs& outputs)>;
/// The work of helper number `index`, from 0. The child reads the bytes that it sends over
/// `socket`. It prints nothing; its exceptions end the helper alone.
using HelperWork = std::function<void(int index, int socket)>;

/// Runs `work` closed in. The child writes the report, and this process ends with its exit code; it
/// returns where the sandbox is off, or the child ended by a signal. A signal that ends the child
/// is kInternal with the code worker.crashed (worker.killed for SIGKILL) and leaves no partial
/// output; one that a user sends to end a program ends this one, too. Call it before other threads
/// are started, and with all inputs read.
/// Helpers end with the child, and all of them with this process.
int confine(const Confinement& confinement, Report& report, const ConfinedWork& work,
            const HelperWork& help = nullptr);

/// Returns the path with its %d or %04d replaced by the frame's number; the path itself where it
/// has none, or for kNoFrame.
std::string framePath(const std::string& path, int frame);

}  // namespace farol::cli
