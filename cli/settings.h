#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace farol::cli {

/// Lets every flag of the command be set by the environment too, --max-body as FAROL_MAX_BODY, and
/// by a TOML file that --config or FAROL_CONFIG names, as max-body = 1000. A flag wins over the
/// environment, the environment over the file. Call it after the last flag was added.
void addSettings(CLI::App& command);

/// The environment variable of a flag: FAROL_MAX_BODY of --max-body.
std::string variableOf(const std::string& flag);

/// Reads the file, if one is named, for the flags that nothing else has set; from the command's
/// callback. Throws CLI::ParseError that names the file and the key: unknown keys and values out
/// of range are faults.
void readSettings(CLI::App& command);

}  // namespace farol::cli
