#pragma once

#include <string>

#include "scene/files/bundle.h"
#include "server/context.h"
#include "server/request/upload.h"
#include "server/router.h"

namespace farol::server {

/// The scene in the body. With `base`, the id of a served scene, the body has the document; its
/// files are those of that scene, without the paths of the part `without`, and with those that were
/// sent. Throws as readUpload and Catalogue do, Error option.range.
Upload takeUpload(const Context& context, const Call& call, const std::string& base);

/// Copies the document of a job and the files that it may need. Throws as scene::readFiles does.
scene::Bundle bundleOf(const render::Job& job);

}  // namespace farol::server
