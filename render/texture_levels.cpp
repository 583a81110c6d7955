#include "render/texture_levels.h"

#include <algorithm>
#include <deque>
#include <future>
#include <thread>

#include "render/skybox.h"

namespace farol::render {
namespace {

constexpr std::size_t kMostThreads = 8;
/// Of pictures that are decoded at once: one takes up to 14 bytes a pixel meanwhile. A larger one
/// is decoded alone.
constexpr std::int64_t kPixelsAtOnce = 16 << 20;

void turnOver(Image& image) {
    const auto stride = static_cast<std::ptrdiff_t>(image.width) * 4;
    auto top = image.pixels.begin(), bottom = image.pixels.end() - stride;
    for (; top < bottom; top += stride, bottom -= stride)
        std::swap_ranges(top, top + stride, bottom);
}

TextureLevels levelsOf(const TextureRef& ref, Image image) {
    TextureLevels levels;
    if (ref.cube) {
        for (Image& face : cutCross(image)) levels.images.push_back(std::move(face));
        return levels;
    }
    if (mipmapped(ref.filter)) levels.images = buildMipmaps(image);
    levels.images.insert(levels.images.begin(), std::move(image));
    for (Image& level : levels.images) turnOver(level);
    return levels;
}

}  // namespace

bool mipmapped(scene::Filter filter) {
    return filter == scene::Filter::mipmap || filter == scene::Filter::anisotropic;
}

void loadTextures(const std::vector<const TextureRef*>& refs, const OpenTexture& open,
                  const std::function<void(const TextureRef&, const TextureLevels&)>& take) {
    const std::size_t threads =
        std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, kMostThreads);
    struct Loading {
        const TextureRef* ref;
        std::int64_t pixels;
        std::future<TextureLevels> levels;
    };
    std::deque<Loading> loading;  // their destructors wait
    std::int64_t pixels = 0;
    const auto takeFirst = [&] {
        Loading first = std::move(loading.front());
        loading.pop_front();
        take(*first.ref, first.levels.get());
        pixels -= first.pixels;
    };
    for (const TextureRef* ref : refs) {
        UndecodedTexture next;
        try {
            next = open(*ref);
        } catch (...) {
            while (!loading.empty()) takeFirst();  // an earlier one's fault comes first
            throw;
        }
        while (!loading.empty() &&
               (loading.size() >= threads || pixels + next.pixels > kPixelsAtOnce))
            takeFirst();
        pixels += next.pixels;
        const auto load = [ref, decode = std::move(next.decode)] {
            return levelsOf(*ref, decode());
        };
        // One alone needs no thread.
        const auto how = refs.size() > 1 ? std::launch::async : std::launch::deferred;
        loading.push_back({ref, next.pixels, std::async(how, load)});
    }
    while (!loading.empty()) takeFirst();
}

}  // namespace farol::render
