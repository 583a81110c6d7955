#pragma once

#include "server/backend.h"

namespace farol::server::worker {

/// Decodes or draws both, cuts them and tells how they differ. Throws as those that it calls do:
/// image.*, limit.*, scene.*, option.range of `crop` and `mask`.
CompareReply compareSubjects(render::Renderer& renderer, const CompareJob& job);

}  // namespace farol::server::worker
