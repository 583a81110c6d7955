#pragma once

#include "server/context.h"
#include "server/request/problem.h"

namespace farol::server {

/// Replaces a problem document by an image of its text if the request has onerror=image and a
/// worker can render it; status and headers stay.
void drawProblem(Context& context, const http::Request& request, const Problem& problem,
                 http::Response& response);

}  // namespace farol::server
