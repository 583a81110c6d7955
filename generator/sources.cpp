#include "generator/sources.h"

#include <span>

#include "scene/embedded.h"
#include "scene/text.h"
#include "scene/words.h"

namespace farol {
std::span<const EmbeddedFile> builtin();  // made by cmake/embed.cmake
}

namespace farol::generator {

std::string baseNameOf(const std::string& path) {
    const std::size_t slash = path.find_last_of("/\\");
    return slash == std::string::npos ? path : path.substr(slash + 1);
}

std::optional<std::string_view> builtinFile(const std::string& path) {
    const std::string base = baseNameOf(path);
    for (const EmbeddedFile& file : builtin())
        if (file.name == base) return file.bytes;
    return std::nullopt;
}

std::string nearestFile(const std::string& name, const scene::Assets& assets,
                        std::vector<std::string> candidates) {
    // More names than this would cost more time than the hint is worth.
    constexpr std::size_t kMaxNames = 2'000;
    for (const EmbeddedFile& file : builtin()) candidates.emplace_back(file.name);
    for (const std::string& path : assets.list()) {
        if (candidates.size() >= kMaxNames) break;
        candidates.push_back(baseNameOf(path));
    }
    const std::string near = scene::didYouMean(baseNameOf(name), candidates);
    return near.empty() || near == name ? "" : "; did you mean \"" + near + "\"?";
}

std::string readSource(const std::string& path, const scene::Assets& assets) {
    Diagnostics unheard;  // resolve has said where the file was found
    if (const auto found = scene::locate(assets, path, {}, unheard))
        if (auto bytes = assets.read(*found)) return std::move(*bytes);
    if (const auto bytes = builtinFile(path)) return std::string(*bytes);
    throw Error("asset.missing",
                "there is no file " + scene::quoted(path) + nearestFile(path, assets));
}

}  // namespace farol::generator
