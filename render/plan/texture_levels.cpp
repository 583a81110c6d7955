#include "render/plan/texture_levels.h"

#include <algorithm>
#include <deque>
#include <future>
#include <thread>

#include "core/workers.h"
#include "render/plan/messages.h"
#include "render/plan/skybox.h"

namespace farol::render {
namespace {

constexpr std::size_t kMaxThreads = 8;
constexpr std::size_t kQueued = 4;  // images a thread that may be decoded and not taken

void flipVertically(image::Image& image) {
    const auto stride = static_cast<std::ptrdiff_t>(image.width) * 4;
    auto top = image.pixels.begin(), bottom = image.pixels.end() - stride;
    for (; top < bottom; top += stride, bottom -= stride)
        std::swap_ranges(top, top + stride, bottom);
}

std::string sizeOf(int width, int height) {
    return std::to_string(width) + " x " + std::to_string(height) + " px";
}

/// The file, or a chess board as scenes write it.
std::string nameOf(const TextureRef& ref) {
    if (!ref.chess) return ref.path;
    return "chess:" + std::to_string(ref.chess->columns) + 'x' + std::to_string(ref.chess->rows);
}

int faceSide(const GlFacts& gl) { return std::min(gl.maxFaceSide, kMaxFaceSide); }

/// Classifies the alpha of an image and premultiplies its colours, as its use asks.
void takeAlpha(const TextureRef& ref, image::Image& image, TextureLevels& levels) {
    if (ref.alpha == AlphaUse::none || image::isOpaque(image)) return;
    const auto note = [&](TextureNote::Kind kind) {
        levels.notes.push_back({kind, image.width, image.height});
    };
    const image::Alpha alpha = image::classifyAlpha(image);
    if (alpha == image::Alpha::opaque) return note(TextureNote::Kind::alphaUnset);
    if (ref.alpha == AlphaUse::ignored) return note(TextureNote::Kind::alphaIgnored);
    levels.alpha = alpha;
    image::premultiply(image);
}

TextureLevels levelsOf(const TextureRef& ref, const UndecodedTexture& texture, const GlFacts& gl) {
    TextureLevels levels;
    std::string damage;
    image::Image image = texture.decode(damage);
    if (!damage.empty())
        levels.notes.push_back({TextureNote::Kind::damaged, image.width, image.height, damage});
    for (TextureNote& note : sizeNotes(ref.cube, image.width, image.height, gl))
        levels.notes.push_back(std::move(note));
    takeAlpha(ref, image, levels);
    if (ref.cube) {
        for (image::Image& face : cutCross(image, faceSide(gl)))
            levels.images.push_back(std::move(face));
        return levels;
    }
    const int most = gl.maxTextureSide;
    if (image.width > most || image.height > most) {
        const int width = std::min(image.width, most), height = std::min(image.height, most);
        image = image::scaleDown(std::move(image), width, height);
    }
    if (mipmapped(ref.filter)) levels.images = image::buildMipmaps(image);
    if (levels.alpha == image::Alpha::cutOut) image::preserveCoverage(image, levels.images);
    levels.images.insert(levels.images.begin(), std::move(image));
    for (image::Image& level : levels.images) flipVertically(level);
    return levels;
}

}  // namespace

std::vector<TextureNote> sizeNotes(bool isCube, int width, int height, const GlFacts& gl) {
    std::vector<TextureNote> notes;
    if (isCube && !isCross(width, height))
        notes.push_back({TextureNote::Kind::noCross, width, height});
    const int side = faceSide(gl), most = gl.maxTextureSide;
    if (isCube ? width / 4 > side : std::max(width, height) > most)
        notes.push_back({TextureNote::Kind::scaled, width, height,
                         isCube ? "faces of " + sizeOf(side, side)
                                : sizeOf(std::min(width, most), std::min(height, most))});
    return notes;
}

Diagnostic findingOf(const TextureNote& note, const TextureRef& ref) {
    const std::string name = nameOf(ref);
    const auto file = "file"_arg = uncut(name);
    const auto width = "width"_arg = note.width;
    const auto height = "height"_arg = note.height;
    Severity severity = Severity::warning;
    Message problem;
    switch (note.kind) {
        case TextureNote::Kind::scaled:
            problem = message<"image.scaled">(file, width, height, "used"_arg = note.detail);
            break;
        case TextureNote::Kind::damaged:
            problem = message<"image.damaged">(file, "damage"_arg = note.detail);
            break;
        case TextureNote::Kind::noCross:
            problem = message<"image.cross">(file, width, height);
            break;
        case TextureNote::Kind::alphaIgnored:
            severity = Severity::info;
            problem = message<"image.alpha">(file);
            break;
        case TextureNote::Kind::alphaUnset:
            severity = Severity::info;
            problem = message<"image.alpha/unset">(file);
            break;
    }
    return diagnosticOf(severity, std::move(problem), ref.where);
}

bool mipmapped(scene::Filter filter) {
    return filter == scene::Filter::mipmap || filter == scene::Filter::anisotropic;
}

void loadTextures(const std::vector<const TextureRef*>& refs, const OpenTexture& open,
                  const TextureLoading& callbacks, const GlFacts& gl) {
    const std::size_t threads =
        std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, kMaxThreads);
    struct Loading {
        const TextureRef* ref;
        std::int64_t pixels;
        std::future<TextureLevels> levels;
    };
    std::deque<Loading> loading;
    std::int64_t pixels = 0;
    bool idle = callbacks.whileDecoding != nullptr;
    // One alone needs no thread, where there is no other work.
    Workers workers(refs.size() > 1 || idle ? std::min(threads, refs.size()) : 0);
    const auto takeFirst = [&] {
        if (idle) callbacks.whileDecoding();
        idle = false;
        Loading first = std::move(loading.front());
        loading.pop_front();
        callbacks.onDecoded(*first.ref, first.levels.get());
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
        while (!loading.empty() &&
               (loading.size() >= threads * kQueued || pixels + more > kMaxPixelsAtOnce))
            takeFirst();
        pixels += more;
        loading.push_back(
            {ref, more, workers.add([ref, next, &gl] { return levelsOf(*ref, next, gl); })});
        if (callbacks.onReserved) callbacks.onReserved(*ref, next);
    }
    while (!loading.empty()) takeFirst();
}

}  // namespace farol::render
