#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "server/store/scene_store.h"

namespace farol::server::store {

/// A stored scene as one file: "farol-scene 1 DIGEST\n", then listed, expiry (seconds since 1970,
/// 0: never), the document's path, and path and content of each file, every one as "SIZE:BYTES".
/// The digest is of all that follows it.
std::string encodeScene(const Stored& scene);

/// Returns the scene, with its id and size, or nothing for a truncated, damaged or foreign file.
std::optional<Stored> decodeScene(std::string_view file);

}  // namespace farol::server::store
