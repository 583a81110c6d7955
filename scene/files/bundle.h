#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "scene/files/assets.h"

namespace farol::scene {

/// A document and the files that it may name, by their paths (isSafePath).
struct Bundle {
    std::string main;  ///< the document's path
    std::map<std::string, std::string> files;

    std::size_t bytes() const;
};

/// Files up to here are kept whole, with those that no document names.
inline constexpr std::size_t kMaxBundleFiles = 256;
/// Bound on the bytes of a bundle's files.
inline constexpr std::size_t kMaxBundleBytes = std::size_t{64} << 20U;

/// Whether the first element of the text is the root of a scene: <world>, <scene>, <xmls> or
/// <includes>, in any case. Looks at its beginning only.
bool beginsAsScene(std::string_view text);

/// Which of the files is the scene: scene.xml at the top, else the only .xml file; of several the
/// only one that begins as a scene does (beginsAsScene), else the highest
/// of those that are called scene.xml. Throws Error bundle.no-scene, or bundle.which-scene with the
/// candidates' names.
std::string mainOf(const Assets& files);

/// Returns the files that scenes need of `paths`: all of them where there are kMaxBundleFiles and
/// `mostBytes` at most; of a whole project the documents (.xml, up to 1 MiB) and the files whose
/// base name stands in one of them or, of material libraries and their pictures, in a mesh or
/// library that is named.
std::vector<std::string> neededFiles(const Assets& files, const std::vector<std::string>& paths,
                                     std::size_t mostBytes);

/// Returns the paths of the files that a document names, and of those that these name: the document
/// itself first, then the others by their paths. Names are matched as in neededFiles.
std::vector<std::string> filesNamedBy(const Assets& files, const std::string& document);

/// The bytes of those files. Throws Error limit.bundle over `mostBytes`, and as Assets::read does.
std::map<std::string, std::string> readFiles(const Assets& files,
                                             const std::vector<std::string>& paths,
                                             std::size_t mostBytes);

/// Names the bundle's content, however it was sent: a contentDigest of every path and file.
std::string digestOf(const Bundle& bundle);

}  // namespace farol::scene
