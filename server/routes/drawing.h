#pragma once

#include <string>

#include "server/context.h"
#include "server/request/parameters.h"
#include "server/router.h"

/// Functions that the rendering routes share.
namespace farol::server {

/// The picture as an answer; its stages are counted.
http::Response drawn(Context& context, worker::Done<render::Picture> done);
/// Throws Error option.range for an `onerror` that is neither image nor problem.
void checkOnError(const Parameters& wanted);
/// All options that decide a picture: part of its tag.
std::string keyOf(const Parameters& wanted);

}  // namespace farol::server
