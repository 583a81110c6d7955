#include "render/plan/texture_levels.h"

#include <algorithm>
#include <deque>
#include <future>
#include <thread>

namespace farol::render {
namespace {

constexpr std::size_t kMostThreads = 8;
/// Of pictures that are decoded at once: one takes up to 14 bytes a pixel meanwhile. A larger one
/// is decoded alone.
constexpr std::int64_t kPixelsAtOnce = 16 << 20;

void turnOver(image::Image& image) {
    const auto stride = static_cast<std::ptrdiff_t>(image.width) * 4;
    auto top = image.pixels.begin(), bottom = image.pixels.end() - stride;
    for (; top < bottom; top += stride, bottom -= stride)
        std::swap_ranges(top, top + stride, bottom);
}

std::string sizeOf(int width, int height) {
    return std::to_string(width) + " x " + std::to_string(height) + " px";
}

TextureNote scaledNote(const image::Image& image, const std::string& used) {
    return {"image.scaled", "is " + sizeOf(image.width, image.height) +
                                ", more than the GL takes; using " + used +
                                "; fix: scale the image down"};
}

TextureLevels levelsOf(const TextureRef& ref, const UndecodedTexture& texture, const GlFacts& gl) {
    TextureLevels levels;
    std::string damage;
    image::Image image = texture.decode(damage);
    if (!damage.empty()) levels.notes.push_back({"image.damaged", damage});
    if (ref.cube) {
        const int side = std::min(gl.maxFaceSide, kMaxFaceSide);
        if (image.width / 4 > side)
            levels.notes.push_back(scaledNote(image, "faces of " + sizeOf(side, side)));
        for (image::Image& face : cutCross(image, side)) levels.images.push_back(std::move(face));
        return levels;
    }
    if (image.width > gl.maxTextureSide || image.height > gl.maxTextureSide) {
        const int width = std::min(image.width, gl.maxTextureSide);
        const int height = std::min(image.height, gl.maxTextureSide);
        levels.notes.push_back(scaledNote(image, sizeOf(width, height)));
        image = image::scaleDown(std::move(image), width, height);
    }
    if (mipmapped(ref.filter)) levels.images = image::buildMipmaps(image);
    levels.images.insert(levels.images.begin(), std::move(image));
    for (image::Image& level : levels.images) turnOver(level);
    return levels;
}

}  // namespace

Diagnostic warningOf(const TextureNote& note, const TextureRef& ref) {
    return {Severity::warning, note.code, ref.where, "image \"" + ref.path + "\" " + note.text, {}};
}

bool mipmapped(scene::Filter filter) {
    return filter == scene::Filter::mipmap || filter == scene::Filter::anisotropic;
}

void loadTextures(const std::vector<const TextureRef*>& refs, const OpenTexture& open,
                  const TextureTaker& taker, const GlFacts& gl) {
    const std::size_t threads =
        std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, kMostThreads);
    struct Loading {
        const TextureRef* ref;
        std::int64_t pixels;
        std::future<TextureLevels> levels;
    };
    std::deque<Loading> loading;  // their destructors wait
    std::int64_t pixels = 0;
    bool idle = taker.meanwhile != nullptr;
    const auto takeFirst = [&] {
        if (idle) taker.meanwhile();
        idle = false;
        Loading first = std::move(loading.front());
        loading.pop_front();
        taker.take(*first.ref, first.levels.get());
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
        const std::int64_t more = std::int64_t{next.width} * next.height;
        while (!loading.empty() && (loading.size() >= threads || pixels + more > kPixelsAtOnce))
            takeFirst();
        pixels += more;
        const auto load = [ref, next, &gl] { return levelsOf(*ref, next, gl); };
        // One alone needs no thread, where nothing else is to be done meanwhile.
        const auto how = refs.size() > 1 || idle ? std::launch::async : std::launch::deferred;
        loading.push_back({ref, more, std::async(how, load)});
        if (taker.expect) taker.expect(*ref, next);
    }
    while (!loading.empty()) takeFirst();
}

}  // namespace farol::render
