#include "render/texture_prefetch.h"

#include <algorithm>
#include <thread>

#include "core/error.h"

namespace farol::render {

TexturePrefetch::TexturePrefetch(const std::vector<TextureRef>& refs, OpenTexture open)
    : open_(std::move(open)) {
    const std::size_t most = std::max(1U, std::thread::hardware_concurrency());
    std::int64_t pixels = 0;
    for (const TextureRef& ref : refs) {
        if (started_.size() >= most) return;
        if (ref.chess || started_.count(ref.key) != 0) continue;
        UndecodedTexture file;
        try {
            file = open_(ref);
        } catch (const Error&) {
            continue;  // reported where the plan needs the texture
        }
        pixels += std::int64_t{file.width} * file.height;
        if (pixels > kMaxPixelsAtOnce) return;
        std::future<Decoded> image = std::async(std::launch::async, [decode = file.decode] {
            Decoded decoded;
            decoded.image = decode(decoded.damage);
            return decoded;
        });
        started_.emplace(ref.key,
                         Started{file.width, file.height, file.mayHaveAlpha,
                                 std::make_shared<std::future<Decoded>>(std::move(image))});
    }
}

UndecodedTexture TexturePrefetch::open(const TextureRef& ref) {
    const auto at = started_.find(ref.key);
    if (at == started_.end()) return open_(ref);
    const Started started = std::move(at->second);
    started_.erase(at);
    return {started.width, started.height, started.mayHaveAlpha,
            [image = started.image](std::string& damage) {
                Decoded decoded = image->get();
                damage = std::move(decoded.damage);
                return std::move(decoded.image);
            }};
}

}  // namespace farol::render
