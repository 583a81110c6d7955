#pragma once

#include <string>

#include "server/context.h"
#include "server/request/upload.h"
#include "server/router.h"

namespace farol::server {

/// The scene in the body. With `base`, the id of a served scene, the document alone comes in the
/// body, and the files are those of that scene. Throws as readUpload and Catalogue do.
Upload takeUpload(const Context& context, const Call& call, const std::string& base);

}  // namespace farol::server
