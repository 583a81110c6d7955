#pragma once

/// Places of this build. They are values of one source, not definitions of all, so that the
/// compiler cache serves every clone and preset.
namespace farol::test {

extern const char* const kSourceDir;   ///< the checkout
extern const char* const kTestOutput;  ///< folder for files that tests write
extern const char* const kProgram;     ///< the farol program
}  // namespace farol::test
