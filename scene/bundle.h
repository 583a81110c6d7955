#pragma once

#include <map>
#include <string>

#include "scene/error.h"

namespace farol::scene {

/// A document and the files that it may name, by their paths (isSafePath).
struct Bundle {
    std::string main;  ///< the document's path
    std::map<std::string, std::string> files;

    std::size_t bytes() const;
};

/// Bounds of what an archive may unpack to.
inline constexpr std::size_t kMaxBundleFiles = 256;
inline constexpr std::size_t kMaxBundleBytes = std::size_t{64} << 20U;

/// Which of the files is the scene: scene.xml, else the only one that ends in .xml. Throws Error
/// bundle.no-scene, or bundle.which-scene with the candidates' names.
std::string mainOf(const std::map<std::string, std::string>& files);

/// Names the bundle's content, however it was sent: a contentDigest of every path and file.
std::string digestOf(const Bundle& bundle);

}  // namespace farol::scene
