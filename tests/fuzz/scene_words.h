#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/files/assets.h"
#include "scene/read/reader.h"

/// Shared by the targets that read scenes.
namespace farol::fuzz {

/// Elements, attributes and words of the language, from its tables, and markup.
const std::vector<std::string>& sceneTokens();

/// The files a fuzzed scene may name; the scene itself is among them, as scene.xml.
scene::BundleAssets sceneBundle(std::string_view xml);

/// The bundle's files that are scenes are known by these names.
inline constexpr const char* kSceneName = "scene.xml";

}  // namespace farol::fuzz
