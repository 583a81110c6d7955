// stb_image 2.27 ignores short reads and leaves its memory as malloc gives it. Here its memory is
// zeroed, bounded and freed with the call, and a read past the end of the file throws.
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>

#include "image/decoder.h"

namespace {

/// Memory of one call of stb_image.
class StbMemory {
  public:
    explicit StbMemory(std::size_t maxBytes) : left_(maxBytes) { current() = this; }
    ~StbMemory() { current() = nullptr; }
    StbMemory(const StbMemory&) = delete;
    StbMemory& operator=(const StbMemory&) = delete;

    static StbMemory& inUse() { return *current(); }
    void* allocate(std::size_t size) {
        if (size > left_) throw std::runtime_error("it needs too much memory");
        Block block(static_cast<char*>(std::calloc(std::max<std::size_t>(size, 1), 1)), &std::free);
        if (!block) throw std::bad_alloc();
        void* const address = block.get();
        blocks_.emplace(address, Entry{std::move(block), size});
        left_ -= size;
        return address;
    }
    void release(void* address) {
        const auto entry = blocks_.find(address);
        if (entry == blocks_.end()) return;
        left_ += entry->second.size;
        blocks_.erase(entry);
    }

  private:
    static StbMemory*& current() {
        thread_local StbMemory* memory = nullptr;
        return memory;
    }
    using Block = std::unique_ptr<char, decltype(&std::free)>;
    struct Entry {
        Block block;
        std::size_t size;
    };
    std::map<void*, Entry> blocks_;
    std::size_t left_;
};

}  // namespace

#define STBI_MALLOC(size) StbMemory::inUse().allocate(size)
#define STBI_REALLOC_SIZED(old, oldSize, newSize) \
    (static_cast<void>(old), throw std::runtime_error("its memory grows"), nullptr)
#define STBI_FREE(address) StbMemory::inUse().release(address)
#define STBI_ASSERT(holds) static_cast<void>(0)
#define STBI_NO_STDIO
#define STBI_NO_SIMD
#define STBI_ONLY_TGA
#define STBI_ONLY_HDR
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace farol::image {
namespace {

[[noreturn]] void throwCutOff() { throw std::runtime_error("the file is cut off"); }

/// Input callbacks of stb_image. Its read-ahead buffer, which it passes first, is filled once and
/// from then on byte by byte: a read past the end of the file is then one that the decoder needs,
/// not a read-ahead.
struct Source {
    explicit Source(std::string_view bytes) : rest(bytes) {}

    std::string_view rest;
    const char* readAhead = nullptr;

    static int read(void* user, char* to, int count) {
        Source& source = *static_cast<Source*>(user);
        auto size = static_cast<std::size_t>(std::max(count, 0));
        if (source.readAhead == nullptr) {
            source.readAhead = to;
            size = std::min(size, source.rest.size());
        } else if (to == source.readAhead) {
            size = std::min<std::size_t>(size, 1);
        }
        if (size > source.rest.size() || (size == 0 && count > 0)) throwCutOff();
        std::memcpy(to, source.rest.data(), size);
        source.rest.remove_prefix(size);
        return static_cast<int>(size);
    }
    static void skip(void* user, int count) {
        Source& source = *static_cast<Source*>(user);
        if (count < 0 || static_cast<std::size_t>(count) > source.rest.size()) throwCutOff();
        source.rest.remove_prefix(static_cast<std::size_t>(count));
    }
    static int isAtEnd(void* user) { return static_cast<Source*>(user)->rest.empty() ? 1 : 0; }
};

constexpr stbi_io_callbacks kCallbacks{Source::read, Source::skip, Source::isAtEnd};

std::string reason() {
    const char* text = stbi_failure_reason();
    return std::string("stb_image: ") + (text == nullptr ? "damaged" : text);
}

/// Sets the size from the head. Returns false where no samples are to be decoded.
bool readHead(std::string_view bytes, bool wantsPixels, Decoded& out) {
    if (bytes.empty()) throwCutOff();
    const StbMemory memory(std::size_t{1} << 20);
    Source source(bytes);
    int width = 0, height = 0, channels = 0;
    if (stbi_info_from_callbacks(&kCallbacks, &source, &width, &height, &channels) == 0)
        throw std::runtime_error(reason());
    // TGA of 16 bits has 1 bit of alpha, which stb_image leaves out.
    return out.announce(width, height, channels) && wantsPixels;
}

/// Decodes with `load`, one of stb_image's functions, and checks the size against the head's.
template <typename Sample, typename Load>
void decode(std::string_view bytes, Load load, Decoded& out,
            void (*convert)(const Sample*, std::vector<std::uint8_t>&)) {
    constexpr std::size_t kSlack = std::size_t{1} << 20;
    const auto pixels = static_cast<std::size_t>(out.pixels());
    const StbMemory memory(pixels * 4 * sizeof(Sample) + kSlack);
    Source source(bytes);
    int width = 0, height = 0, channels = 0;
    const Sample* samples = load(&kCallbacks, &source, &width, &height, &channels, 0);
    if (samples == nullptr) throw std::runtime_error(reason());
    if (width != out.width || height != out.height || channels != out.channels)
        throw std::runtime_error("its head and its pixels differ in size");
    out.allocate();
    convert(samples, out.samples);
}

void copySamples(const stbi_uc* from, std::vector<std::uint8_t>& to) {
    std::copy_n(from, to.size(), to.begin());
}

/// Clamps the file's display values to 0..1 and converts NaN to 0.
void clampSamples(const float* from, std::vector<std::uint8_t>& to) {
    for (std::size_t i = 0; i < to.size(); ++i)
        to[i] = from[i] > 0.0F ? static_cast<std::uint8_t>(std::min(from[i], 1.0F) * 255.0F + 0.5F)
                               : std::uint8_t{0};
}

/// Least bytes that the pixels of a TGA take; a packet of a compressed one holds 128.
void requireTgaPixels(std::string_view bytes, const Decoded& out) {
    constexpr std::uint64_t kPixelsAPacket = 128;
    const bool compressed = (static_cast<unsigned char>(bytes[2]) & 8U) != 0;
    const std::uint64_t depth = (static_cast<unsigned char>(bytes[16]) + 7U) / 8U;
    const auto pixels = static_cast<std::uint64_t>(out.pixels());
    const std::uint64_t least =
        compressed ? (pixels + kPixelsAPacket - 1) / kPixelsAPacket * (1 + depth) : pixels * depth;
    if (least > bytes.size() - 18) throwCutOff();
}

void mirrorRows(Decoded& out) {
    const auto channels = static_cast<std::size_t>(out.channels);
    for (int y = 0; y < out.height; ++y) {
        std::uint8_t* left = out.row(y);
        std::uint8_t* right = left + out.rowSize() - channels;
        for (; left < right; left += channels, right -= channels)
            std::swap_ranges(left, left + channels, right);
    }
}

}  // namespace

void readTga(std::string_view bytes, bool wantsPixels, Decoded& out) {
    constexpr std::size_t kHead = 18;
    if (bytes.size() < kHead) throwCutOff();
    if (bytes[1] == 1 && (bytes[3] != 0 || bytes[4] != 0))
        throw std::runtime_error("its palette does not start at colour 0");
    const bool wanted = readHead(bytes, wantsPixels, out);
    if (out.pixels() <= kMaxTexturePixels) requireTgaPixels(bytes, out);
    if (!wanted) return;
    decode(bytes, stbi_load_from_callbacks, out, copySamples);
    constexpr unsigned kRightToLeft = 0x10;
    if ((static_cast<unsigned char>(bytes[17]) & kRightToLeft) != 0) mirrorRows(out);
}

void readHdr(std::string_view bytes, bool wantsPixels, Decoded& out) {
    const bool wanted = readHead(bytes, wantsPixels, out);
    // Four bytes a row at least: the start of a compressed one, or one pixel.
    if (static_cast<std::uint64_t>(out.height) * 4 > bytes.size()) throwCutOff();
    if (wanted) decode(bytes, stbi_loadf_from_callbacks, out, clampSamples);
}

}  // namespace farol::image
