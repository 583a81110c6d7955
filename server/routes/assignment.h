#pragma once

#include "server/assignments/assignment.h"
#include "server/context.h"
#include "server/router.h"

namespace farol::server {

/// Returns the assignment of the path. Throws Error http.not-found.
Assignment assignmentOf(Context& context, const Call& call);

}  // namespace farol::server
