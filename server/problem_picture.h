#pragma once

#include "server/context.h"
#include "server/request/problem.h"

namespace farol::server {

/// Makes a picture of the answer to a problem, where the request wants that (onerror=image) and a
/// worker can draw it; status and headers stay.
void drawProblem(Context& context, const http::Request& request, const Problem& problem,
                 http::Response& response);

}  // namespace farol::server
