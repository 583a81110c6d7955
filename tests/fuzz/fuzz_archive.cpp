// Archives of scenes: the whole input is a zip, a tar or a gzipped tar.
#include "scene/files/archive.h"
#include "scene/files/assets.h"
#include "tests/fuzz/checks.h"
#include "tests/fuzz/target.h"

namespace farol::fuzz {

const Target& target() {
    static const Target made{
        {"zip", "tar", "gz"},
        {"PK\x03\x04", "PK\x01\x02", "PK\x05\x06", "ustar", "../", "/etc/passwd", "scene.xml",
         "a/b/", "C:\\", std::string("\0", 1), "\x1f\x8b\x08", std::string(512, '\0')},
        512};
    return made;
}

}  // namespace farol::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace farol;
    using namespace farol::fuzz;
    const std::string bytes(reinterpret_cast<const char*>(data), std::min(size, kMaxInput));
    try {
        const scene::Bundle bundle = scene::readArchive(bytes);
        require(bundle.files.count(bundle.main) == 1, "the document is not among the files");
        require(bundle.files.size() <= scene::Assets::kMaxListed, "more files than may be");
        require(bundle.bytes() <= scene::kMaxBundleBytes, "more bytes than may be");
        for (const auto& [path, content] : bundle.files)
            require(scene::isSafePath(path), "a path that leads out of the bundle: " + path);
        require(scene::digestOf(scene::readArchive(bytes)) == scene::digestOf(bundle),
                "the same archive is read in two ways");
        reached("files " + std::to_string(bundle.files.size()));
    } catch (const Error& error) {
        checkError(error);
        reached(error.what());
    }
    return 0;
}
