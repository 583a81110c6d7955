#pragma once

#include <cstddef>

#include "server/worker/messages.h"

namespace farol::server::worker {

/// The largest mesh that is sent to a client, in triangles: the file is held in memory.
inline constexpr std::size_t kMaxMeshTriangles = 250'000;

/// Does what is asked. Never throws: what goes wrong is in the reply.
Reply work(render::Renderer& renderer, grade::Grader& grader, const Request& request);

/// Draws small scenes that need the commonest shaders, so that they are compiled.
/// Throws what Renderer::render throws.
void warmUp(render::Renderer& renderer);

}  // namespace farol::server::worker
