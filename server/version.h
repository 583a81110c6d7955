#pragma once

#include <string>

namespace farol::server {

/// The project's version: "0.2.0".
std::string projectVersion();

}  // namespace farol::server
