#pragma once

#include <map>
#include <string>

namespace farol::worker {

/// The result of a call: "done" where it is 0 or more, else the name of errno.
std::string outcome(long result);

/// Makes calls that seccomp refuses in this sandbox, with arguments that are valid outside.
/// Returns the outcome of each by its name.
std::map<std::string, std::string> tryForbiddenCalls();

}  // namespace farol::worker
