// The canonical writer: what was read, written and read again is the same scene.
#include "scene/read/reader.h"
#include "scene/write/writer.h"
#include "tests/fuzz/checks.h"
#include "tests/fuzz/scene_words.h"
#include "tests/fuzz/target.h"
#include "tests/support/scene_equality.h"

namespace farol::fuzz {

const Target& target() {
    static const Target made{{"xml"}, sceneTokens(), 512};
    return made;
}

}  // namespace farol::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace farol;
    using namespace farol::fuzz;
    const std::string_view xml(reinterpret_cast<const char*>(data), std::min(size, kMaxInput));
    const scene::BundleAssets assets = sceneBundle(xml);
    scene::ReadOptions options;
    options.name = kSceneName;
    scene::Scene first;
    try {
        scene::ReadResult result = scene::read(xml, options, assets);
        for (const Diagnostic& one : result.diagnostics) reached(one.code);
        first = std::move(result.scene);
    } catch (const Error& error) {
        reached(error.code());
        return 0;
    }
    const std::string written = scene::write(first);
    // Included files stand in the canonical text, in groups and with every number spelt out.
    options.limits.bytes = std::size_t{64} << 20U;
    options.limits.depth = 512;
    options.limits.elements = 1'000'000;
    try {
        const scene::ReadResult again = scene::read(written, options, assets);
        for (const Diagnostic& one : again.diagnostics) reached("again " + one.code);
        require(scene::write(again.scene) == written, "written again, the text is another:\n" +
                                                          written + "\n---\n" +
                                                          scene::write(again.scene));
        require(scene::equal(again.scene, first), "read again, the scene is another:\n" + written);
    } catch (const Error& error) {
        throw Finding("the canonical text is refused: " + error.code() + " " + error.what() + "\n" +
                      written);
    }
    return 0;
}
