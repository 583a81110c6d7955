#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/support/paths.h"
#include "tests/support/skip.h"

namespace farol::test {

inline constexpr const char* kCommaLocale = "de_DE.UTF-8";

/// Compiles a locale with a decimal comma, which few systems have installed. Returns the folder
/// that holds it, for LOCPATH; skips the test where localedef lacks its sources.
inline std::string commaLocale() {
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(farol::test::kTestOutput) / "locale";
    if (fs::exists(folder / kCommaLocale)) return folder.string();
    const fs::path made = folder / ("made-by-" + std::to_string(getpid()));
    fs::create_directories(folder);
    const std::string command =
        "localedef -i de_DE -f UTF-8 '" + made.string() + "' > /dev/null 2>&1";
    if (std::system(command.c_str()) != 0)
        skipMissing("localedef cannot compile de_DE.UTF-8 (package locales)");
    std::error_code another;  // a test beside this one has been faster
    fs::rename(made, folder / kCommaLocale, another);
    if (another) fs::remove_all(made);
    return folder.string();
}

}  // namespace farol::test
