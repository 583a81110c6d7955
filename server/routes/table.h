#pragma once

#include <vector>

#include "server/router.h"

namespace farol::server {

/// All that the service answers.
std::vector<Route> routes();

}  // namespace farol::server
