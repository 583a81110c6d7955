#pragma once

#include <string>

namespace farol::server {

/// The project's version: "0.1.0".
std::string projectVersion();

}  // namespace farol::server
