#include "render/texture_prefetch.h"

#include <set>

#include "core/error.h"

namespace farol::render {

TexturePrefetch::TexturePrefetch(const std::vector<TextureRef>& refs, OpenTexture open,
                                 Workers& workers)
    : open_(std::move(open)) {
    if (workers.size() == 0) return;
    std::int64_t pixels = 0;
    for (const TextureRef& ref : refs) {
        if (ref.chess || started_.count(ref.key) != 0) continue;
        UndecodedTexture file;
        try {
            file = open_(ref);
        } catch (const Error&) {
            continue;  // reported where the plan needs the texture
        }
        pixels += std::int64_t{file.width} * file.height;
        if (pixels > kMaxPixelsAtOnce) return;
        const auto isWanted = std::make_shared<std::atomic<bool>>(true);
        std::future<Decoded> image = workers.add([decode = file.decode, isWanted] {
            Decoded decoded;
            if (*isWanted) decoded.image = decode(decoded.damage);
            return decoded;
        });
        images_.push_back(std::make_shared<std::future<Decoded>>(std::move(image)));
        started_.emplace(
            ref.key, Started{file.width, file.height, file.mayHaveAlpha, images_.back(), isWanted});
    }
}

TexturePrefetch::~TexturePrefetch() {
    keepOnly({});
    // Decoders read what `open` knows of.
    for (const auto& image : images_)
        if (image->valid()) image->wait();
}

void TexturePrefetch::keepOnly(const std::vector<TextureRef>& refs) {
    std::set<std::string> kept;
    for (const TextureRef& ref : refs) kept.insert(ref.key);
    for (const auto& [key, started] : started_)
        if (kept.count(key) == 0) *started.isWanted = false;
}

UndecodedTexture TexturePrefetch::open(const TextureRef& ref) {
    const auto at = started_.find(ref.key);
    if (at == started_.end() || !*at->second.isWanted) return open_(ref);
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
