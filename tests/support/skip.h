#pragma once

#include <string>

/// Tests that cannot run are counted as skipped, not as passed: ctest shows them, and scripts/test
/// lists them with their reasons.
namespace farol::test {

/// Ends the current test case as skipped, for want of something that is no part of the project
/// (the folder ../shared/data, a build without sanitizers). Prints "SKIPPED: REASON".
[[noreturn]] void skip(const std::string& reason);

/// Ends the current test case as skipped, for want of a program, locale or kernel feature.
/// Fails it under CI=true, where all of them must be present.
[[noreturn]] void skipMissing(const std::string& reason);

/// Returns whether a program of this name is on the PATH.
bool hasProgram(const std::string& name);

}  // namespace farol::test
