#include "generator/sources.h"

#include <span>

#include "core/embedded.h"
#include "core/text.h"
#include "generator/messages.h"
#include "scene/files/locator.h"

namespace farol {
std::span<const EmbeddedFile> builtin();  // made by cmake/embed.cmake
}

namespace farol::generator {

std::optional<std::string_view> builtinFile(const std::string& path) {
    const std::string_view base = baseName(path);
    for (const EmbeddedFile& file : builtin())
        if (file.name == base) return file.bytes;
    return std::nullopt;
}

std::vector<std::string> builtinNames() {
    std::vector<std::string> names;
    for (const EmbeddedFile& file : builtin()) names.emplace_back(file.name);
    return names;
}

std::string readSource(const std::string& path, const scene::Assets& assets) {
    scene::Locator locator(assets);
    Diagnostics unheard;  // resolve has reported where the file was found
    if (const auto found = locator.locate(path, {}, unheard))
        if (auto bytes = assets.read(*found)) return std::move(*bytes);
    if (const auto bytes = builtinFile(path)) return std::string(*bytes);
    const std::optional<Message> near = locator.nearest(path, builtinNames());
    throw Error(
        message<"asset.missing/file">("file"_arg = path, "fix"_arg = near ? *near : Message{}));
}

}  // namespace farol::generator
