#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// The parts of a fuzz target. The same file links to our driver (driver.cpp) and, built by
/// clang with -fsanitize=fuzzer, to libFuzzer.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace farol::fuzz {

/// Inputs are no longer than this; longer seeds are left out.
inline constexpr std::size_t kMaxInput = 64 * 1024;

/// A target may throw farol::Error within itself only; this, or anything else that leaves it, is
/// a finding.
class Finding : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

inline void require(bool holds, const std::string& message) {
    if (!holds) throw Finding(message);
}

/// Tells the driver what an input reached (a diagnostic's code, a format): inputs that reach a new
/// set of things are kept as seeds. libFuzzer watches the code itself and does not need it.
void reached(std::string_view what);

struct Target {
    /// Endings of the seed files ("xml"); empty: every file.
    std::vector<std::string> endings;
    /// Words of the language, put into inputs whole.
    std::vector<std::string> tokens;
    /// Bound on the resident memory of the whole run, in MiB, without sanitizers.
    std::size_t maxMegabytes = 512;
};

/// Each target defines it.
const Target& target();

}  // namespace farol::fuzz
