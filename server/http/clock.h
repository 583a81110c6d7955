#pragma once

#include <chrono>

namespace farol::server::http {
using Clock = std::chrono::steady_clock;
}
