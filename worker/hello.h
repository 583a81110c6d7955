#pragma once

#include <string>
#include <utility>
#include <vector>

namespace farol::worker {

/// Names and values, for /version.
using Layers = std::vector<std::pair<std::string, std::string>>;

/// The message of a worker that is initialised.
struct Hello {
    std::string fault;  ///< why it cannot, else empty
    std::string gl;
    Layers sandbox;
};

}  // namespace farol::worker
