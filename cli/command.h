#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <stdexcept>
#include <string>

#include "cli/report.h"
#include "render/gl_source.h"

/// The command line: one file a subcommand, each over the libraries.
namespace farol::cli {

enum ExitCode {
    kDone = 0,
    kInputFault = 1,  ///< a scene, mesh or picture is at fault
    kUsage = 2,       ///< the command line is
    kInternal = 3     ///< the program or the machine is: no GL, a file that cannot be written
};

/// The command line is at fault: unknown shape, an argument out of range. Becomes kUsage.
class UsageError : public std::runtime_error {
  public:
    explicit UsageError(Message message)
        : UsageError(diagnosticOf(Severity::error, std::move(message))) {}
    /// An input's fault where the input is an argument of the command line.
    explicit UsageError(Diagnostic fault)
        : std::runtime_error(fault.message), diagnostic_(std::move(fault)) {}
    const Diagnostic& diagnostic() const { return diagnostic_; }

  private:
    Diagnostic diagnostic_;
};

/// Runs the chosen subcommand after its flags are read; returns the exit code.
using Action = std::function<int(Report&)>;

/// Each adds its subcommand to `root`; where the user chose it, `action` is set after parsing.
void addServe(CLI::App& root, Action& action);
void addRender(CLI::App& root, Action& action);
void addGenerate(CLI::App& root, Action& action);
void addConvert(CLI::App& root, Action& action);
void addValidate(CLI::App& root, Action& action);
void addCompare(CLI::App& root, Action& action);
void addGrade(CLI::App& root, Action& action);
void addExplain(CLI::App& root, Action& action);
void addHealth(CLI::App& root, Action& action);
void addSchema(CLI::App& root, Action& action);
void addVersion(CLI::App& root, Action& action);
void addCompletion(CLI::App& root, Action& action);
/// Prints man pages, for the install rules; not in the help.
void addManual(CLI::App& root, Action& action);
/// Internal: started by `serve`; not in the help.
void addWorker(CLI::App& root, Action& action);

/// Returns the exit code of `work`; an exception becomes an exit code and an entry of the report.
int runGuarded(const std::function<int()>& work, Report& report);

/// Adds --lang: the language of the report.
void addLanguage(CLI::App& command, Report& report);

/// Restricts the option to finite numbers from min to max (CLI::Range lets NaN pass), and adds the
/// range and the default to its help.
void takesNumber(CLI::Option* option, double min, double max);

/// Adds --gl.
void addGlSource(CLI::App& command, render::GlSource& source);

/// "farol 0.2.0", then the renderer's own line.
std::string versionLine(render::GlSource source = render::GlSource::automatic);

}  // namespace farol::cli
