#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "server/serve.h"

namespace farol::server {

/// The field of a setting. Times are written in seconds.
using SettingTarget =
    std::variant<int*, double*, std::uint64_t*, bool*, std::string*, std::chrono::milliseconds*>;

/// One setting of `farol serve`: source of its flag, environment variable, TOML key and
/// description. Its default is that of its field.
struct Setting {
    std::string name;  ///< "max-body": --max-body, FAROL_MAX_BODY, max-body = 1000
    std::string help;
    double min = 0, max = 0;         ///< of numbers and times, inclusive
    std::string form;                ///< of texts, for help: "DIR"
    std::vector<std::string> words;  ///< the only values of a text; empty: any
    SettingTarget (*target)(ServeOptions& options);
};

/// All settings, in the order of the help.
std::span<const Setting> settings();

/// The default as the help shows it: "8080"; empty for an empty text or a flag.
std::string defaultText(const Setting& setting);

}  // namespace farol::server
