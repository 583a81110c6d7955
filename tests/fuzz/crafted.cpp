#include "tests/fuzz/crafted.h"

#include <algorithm>
#include <array>
#include <initializer_list>

namespace farol::fuzz {
namespace {

/// SplitMix64: the same numbers on every machine.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::uint32_t below(std::uint64_t count) {
        state_ += 0x9E3779B97F4A7C15ULL;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
        z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
        return static_cast<std::uint32_t>((z ^ (z >> 31U)) % count);
    }
    bool oneIn(std::uint32_t count) { return below(count) == 0; }
    std::uint32_t pick(std::initializer_list<std::uint32_t> values) {
        return values.begin()[below(values.size())];
    }
    /// Mostly small, sometimes at a limit of the format or of an integer.
    std::uint32_t side() {
        return oneIn(12) ? pick({0, 1, 255, 256, 8191, 16384, 32767, 32768, 65535, 0x7fffffff,
                                 0x80000000, 0xffffffff})
                         : 1 + below(40);
    }

  private:
    std::uint64_t state_;
};

void le(std::string& out, std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i, value >>= 8U) out.push_back(static_cast<char>(value & 255U));
}

void be(std::string& out, std::uint64_t value, int bytes) {
    for (int i = bytes; i-- > 0;) out.push_back(static_cast<char>(value >> (8U * unsigned(i))));
}

void noise(std::string& out, Random& random, std::size_t count) {
    const bool small = random.oneIn(2);
    for (std::size_t i = 0; i < count; ++i) le(out, random.below(small ? 6 : 256), 1);
}

std::size_t area(std::uint32_t width, std::uint32_t height, std::size_t bytes) {
    constexpr std::size_t kMaxBytes = 8192;
    const std::size_t pixels = std::min<std::uint64_t>(std::uint64_t{width} * height, kMaxBytes);
    return std::min(pixels * bytes, kMaxBytes);
}

std::string bmp(Random& random) {
    const std::uint32_t head = random.oneIn(4) ? random.pick({12, 40, 52, 56, 64, 108, 124}) : 40;
    const std::uint32_t depth = random.pick({1, 2, 4, 8, 8, 8, 16, 24, 32, 64});
    const std::uint32_t compression =
        depth == 8 || depth == 4 ? random.pick({0, 0, 1, 2}) : random.pick({0, 0, 3, 6, 4});
    const std::uint32_t colors = random.pick({0, 1, 2, 16, 255, 256, 257, 0xffff});
    const std::uint32_t stored = random.pick({0, 1, 2, 16, 256});
    std::uint32_t width = random.side(), height = random.side();
    if (random.oneIn(6)) height = 0U - height;
    std::string out = "BM";
    le(out, 0, 8);
    le(out, random.oneIn(5) ? random.below(2000) : 14 + head + stored * 4, 4);
    le(out, head, 4);
    le(out, width, head == 12 ? 2 : 4);
    le(out, height, head == 12 ? 2 : 4);
    le(out, 1, 2);
    le(out, depth, 2);
    if (head != 12) {
        le(out, compression, 4);
        le(out, 0, 12);
        le(out, colors, 4);
        le(out, 0, 4);
    }
    while (out.size() < 14 + head) le(out, random.pick({0, 0xff, 0xff00, 0xff0000}), 4);
    noise(out, random, stored * 4);
    noise(out, random, area(width, height, (depth + 7) / 8) + random.below(40));
    return out;
}

std::string tga(Random& random) {
    const std::uint32_t type = random.pick({1, 1, 2, 3, 9, 9, 10, 11, 0, 32});
    const std::uint32_t width = random.side(), height = random.side();
    const std::uint32_t colors = random.pick({0, 1, 3, 16, 255, 256, 4096});
    const std::uint32_t depth = random.pick({8, 8, 15, 16, 24, 32, 32, 64});
    const std::uint32_t identity = random.oneIn(5) ? random.below(256) : 0;
    std::string out;
    le(out, identity, 1);
    le(out, random.oneIn(8) ? random.below(3) : type % 8 == 1, 1);
    le(out, type, 1);
    le(out, random.oneIn(6) ? random.below(65536) : 0, 2);
    le(out, colors, 2);
    le(out, random.pick({15, 16, 24, 24, 32, 8}), 1);
    le(out, 0, 4);
    le(out, width, 2);
    le(out, height, 2);
    le(out, depth, 1);
    le(out, random.pick({0, 8, 0x10, 0x20, 0x30, 0xff}), 1);
    noise(out, random, identity + std::min<std::size_t>(colors, 300) * random.below(5));
    noise(out, random, area(width, height, (depth + 7) / 8) + random.below(20));
    if (random.oneIn(5)) {
        le(out, random.pick({0, 26, 500, 0xffffffff}), 4);
        le(out, random.pick({0, 26, 500, 0xffffffff}), 4);
        out += "TRUEVISION-XFILE.";
        le(out, 0, 1);
    }
    return out;
}

std::string pnm(Random& random) {
    const std::uint32_t width = random.side(), height = random.side();
    std::string out = "P" + std::to_string(1 + random.below(6));
    out += random.oneIn(5) ? "\n# " + std::string(random.below(9), 'x') + "\n" : "\n";
    out += std::to_string(width) + " " + std::to_string(height) + "\n";
    if (!random.oneIn(6)) out += std::to_string(random.pick({0, 1, 7, 255, 65535, 65536})) + "\n";
    if (random.oneIn(2))
        for (std::size_t i = area(width, height, 1); i > 0; --i)
            out += std::to_string(random.below(300)) + ' ';
    else
        noise(out, random, area(width, height, 6));
    return out;
}

std::string hdr(Random& random) {
    const std::uint32_t width = random.side(), height = random.side();
    std::string out = random.oneIn(3) ? "#?RGBE\n" : "#?RADIANCE\n";
    if (!random.oneIn(8)) out += "FORMAT=32-bit_rle_rgbe\n";
    if (random.oneIn(4)) out += std::string(random.below(3000), 'a') + "\n";
    out += random.oneIn(8) ? "\n+X " : "\n-Y ";
    out += std::to_string(height) + " +X " + std::to_string(width) + "\n";
    const std::uint32_t rows = std::min<std::uint32_t>(height, 40);
    for (std::uint32_t y = 0; y < rows; ++y) {
        if (!random.oneIn(4)) out += "\x02\x02";
        be(out, random.oneIn(8) ? random.side() : width, 2);
        noise(out, random, random.below(200));
    }
    return out;
}

std::string gif(Random& random) {
    std::string out = random.oneIn(2) ? "GIF89a" : "GIF87a";
    le(out, random.side(), 2);
    le(out, random.side(), 2);
    const std::uint32_t bits = random.below(8);
    const bool palette = !random.oneIn(4);
    le(out, (palette ? 0x80U : 0U) | bits, 1);
    le(out, random.below(256), 2);
    if (palette) noise(out, random, random.oneIn(6) ? random.below(900) : 3U << (bits + 1));
    for (std::uint32_t blocks = random.below(3); blocks > 0; --blocks) {
        out += '!';
        le(out, random.pick({0xF9, 0xFE, 0xFF, 1}), 1);
        le(out, random.pick({4, 4, 0, 255}), 1);
        noise(out, random, 4);
        le(out, random.oneIn(8), 1);
    }
    out += ',';
    for (int i = 0; i < 2; ++i) le(out, random.oneIn(3) ? random.side() : 0, 2);
    const std::uint32_t width = random.side(), height = random.side();
    le(out, width, 2);
    le(out, height, 2);
    le(out, random.pick({0, 0x40, 0x80, 0xC1, 0x87}), 1);
    le(out, random.pick({2, 2, 8, 8, 0, 1, 12, 255}), 1);
    for (std::uint32_t blocks = 1 + random.below(9); blocks > 0; --blocks) {
        const std::uint32_t size = 1 + random.below(255);
        le(out, size, 1);
        noise(out, random, size);
    }
    out += std::string("\0;", 2);
    return out;
}

/// One IFD; values that do not fit into a field follow it.
std::string tiff(Random& random) {
    const bool little = random.oneIn(2);
    const auto put = [&](std::string& out, std::uint64_t value, int bytes) {
        little ? le(out, value, bytes) : be(out, value, bytes);
    };
    const std::uint32_t width = random.side(), height = random.side();
    const std::uint32_t depth = random.pick({1, 2, 4, 8, 8, 8, 16, 32, 64, 12});
    const std::uint32_t samples = random.pick({1, 1, 3, 4, 5, 0, 300});
    const bool tiled = random.oneIn(4);
    std::string pixels;
    noise(pixels, random, area(width, height, 4) + random.below(40));
    struct Field {
        std::uint32_t tag, type, count, value;
    };
    std::vector<Field> fields{
        {256, 4, 1, width},
        {257, 4, 1, height},
        {258, 3, 1, depth},
        {259, 3, 1,
         random.pick({1, 1, 2, 3, 4, 5, 6, 7, 8, 32773, 34712, 32809, 34676, 50000, 50001, 34925})},
        {262, 3, 1, random.pick({0, 1, 2, 3, 3, 5, 6, 8, 32844})},
        {277, 3, 1, samples},
        {284, 3, 1, random.pick({1, 1, 2})},
        {320, 3, random.pick({3, 48, 768, 6}), 8},
        {338, 3, 1, random.below(4)},
        {339, 3, 1, random.pick({1, 2, 3, 6})}};
    const auto size = static_cast<std::uint32_t>(pixels.size());
    if (tiled) {
        fields.push_back({322, 4, 1, random.oneIn(4) ? random.side() : 16});
        fields.push_back({323, 4, 1, random.oneIn(4) ? random.side() : 16});
        fields.push_back({324, 4, random.pick({1, 1, 4}), 8});
        fields.push_back({325, 4, random.pick({1, 1, 4}), size});
    } else {
        fields.push_back({273, 4, 1, random.oneIn(6) ? random.below(90000) : 8});
        fields.push_back({278, 4, 1, random.oneIn(4) ? random.side() : height});
        fields.push_back({279, 4, 1, random.oneIn(6) ? random.side() : size});
    }
    for (const std::uint32_t tag : {34665U, 34675U, 33723U, 700U, 347U, 301U, 530U, 317U})
        if (random.oneIn(6))
            fields.push_back({tag, random.pick({1, 3, 4, 7}), 1 + random.below(300), 8});
    std::sort(fields.begin(), fields.end(),
              [](const Field& a, const Field& b) { return a.tag < b.tag; });
    std::string out = little ? "II" : "MM";
    put(out, 42, 2);
    put(out, 8 + size, 4);
    out += pixels;
    put(out, fields.size(), 2);
    for (const Field& field : fields) {
        put(out, field.tag, 2);
        put(out, field.type, 2);
        put(out, field.count, 4);
        const bool isShort = field.type == 3 && field.count == 1;
        put(out, field.value, isShort ? 2 : 4);
        if (isShort) put(out, 0, 2);
    }
    put(out, 0, 4);
    return out;
}

/// A zlib stream (RFC 1950) of one stored block.
std::string stored(const std::string& data) {
    std::string out = "\x78\x01\x01";
    const auto size = static_cast<std::uint16_t>(data.size());
    le(out, size, 2);
    le(out, 0xffffU - size, 2);
    out += data;
    std::uint32_t low = 1, high = 0;
    for (const char c : data) {
        low = (low + static_cast<unsigned char>(c)) % 65521;
        high = (high + low) % 65521;
    }
    be(out, high << 16U | low, 4);
    return out;
}

void exrAttribute(std::string& out, const std::string& name, const std::string& type,
                  const std::string& value, Random& random) {
    if (random.oneIn(60)) return;
    out += name + '\0' + type + '\0';
    le(out, random.oneIn(80) ? random.side() : static_cast<std::uint32_t>(value.size()), 4);
    out += value;
}

std::string exrWindow(Random& random, std::uint32_t width, std::uint32_t height) {
    std::string out;
    const std::uint32_t left = random.oneIn(4) ? random.side() - 20U : 0;
    const std::uint32_t top = random.oneIn(4) ? random.side() - 20U : 0;
    for (const std::uint32_t value : {left, top, left + width - 1, top + height - 1})
        le(out, value, 4);
    return out;
}

/// Chunks of the right number and of sizes that are too small, right or too large.
std::string exr(Random& random) {
    static constexpr std::array<std::uint32_t, 10> kRows{1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
    const std::uint32_t width = random.side(), height = random.side();
    const std::uint32_t compression = random.oneIn(30) ? 10 : random.below(10);
    const bool tiled = random.oneIn(4), several = random.oneIn(12);
    const std::uint32_t tile = random.oneIn(8) ? random.side() : 16;
    std::string channels, head;
    std::uint32_t pixelBytes = 0;
    static constexpr std::array<const char*, 5> kSets{"ABGR", "BGR", "Y", "AY", "BGRZ"};
    for (const char* c = kSets[random.below(kSets.size())]; *c != 0; ++c) {
        const std::uint32_t type = random.oneIn(12) ? random.below(4) : 1;
        channels += std::string(1, *c) + '\0';
        le(channels, type, 4);
        le(channels, random.below(2), 4);
        le(channels, random.oneIn(40) ? random.below(4) : 1, 4);
        le(channels, random.oneIn(40) ? random.below(4) : 1, 4);
        pixelBytes += type == 1 ? 2 : 4;
    }
    channels += '\0';
    exrAttribute(head, "channels", "chlist", channels, random);
    exrAttribute(head, "compression", "compression", std::string(1, char(compression)), random);
    exrAttribute(head, "dataWindow", "box2i", exrWindow(random, width, height), random);
    exrAttribute(head, "displayWindow", "box2i", exrWindow(random, width, height), random);
    exrAttribute(head, "lineOrder", "lineOrder", std::string(1, char(random.below(3))), random);
    exrAttribute(head, "pixelAspectRatio", "float", std::string("\0\0\x80\x3f", 4), random);
    exrAttribute(head, "screenWindowCenter", "v2f", std::string(8, '\0'), random);
    exrAttribute(head, "screenWindowWidth", "float", std::string("\0\0\x80\x3f", 4), random);
    if (tiled) {
        std::string value;
        le(value, tile, 4);
        le(value, random.oneIn(8) ? random.side() : tile, 4);
        le(value, random.pick({0, 0, 0, 1, 2, 0x11, 3}), 1);
        exrAttribute(head, "tiles", "tiledesc", value, random);
    }
    const std::uint32_t rows = tiled ? std::max(1U, tile) : kRows[compression % 10];
    const std::uint64_t columns = tiled ? (std::uint64_t{width} + rows - 1) / rows : 1;
    const auto chunks = std::min<std::uint64_t>(
        (std::uint64_t{height} + rows - 1) / rows * std::min<std::uint64_t>(columns, 99), 99);
    if (several) {
        exrAttribute(head, "name", "string", "a", random);
        exrAttribute(head, "type", "string",
                     random.oneIn(6) ? "deepscanline"
                     : tiled         ? "tiledimage"
                                     : "scanlineimage",
                     random);
        std::string count;
        le(count, chunks, 4);
        exrAttribute(head, "chunkCount", "int", count, random);
    }
    std::string out = "\x76\x2f\x31\x01";
    le(out,
       2U | (tiled && !several ? 0x200U : 0U) | (several ? 0x1000U : 0U) |
           (random.oneIn(60) ? 0x800U : 0U),
       4);
    out += head + '\0';
    if (several) out += '\0';
    std::string body;
    const std::size_t start = out.size() + static_cast<std::size_t>(chunks) * 8;
    for (std::uint64_t i = 0; i < chunks; ++i) {
        le(out, random.oneIn(50) ? random.side() : start + body.size(), 8);
        if (several) le(body, random.oneIn(30), 4);
        if (tiled) {
            le(body, i % columns, 4);
            le(body, i / columns, 4);
            le(body, 0, 8);
        } else {
            le(body, random.oneIn(50) ? random.side() : i * rows, 4);
        }
        std::string data;
        const std::size_t right = area(tiled ? rows : width, rows, pixelBytes);
        noise(data, random, random.oneIn(3) ? random.below(right + 20) : right);
        if (compression == 2 || compression == 3) data = stored(data);
        if (compression > 3) data.resize(data.size() / 2);
        le(body, data.size(), 4);
        body += data;
    }
    return out + body;
}

/// A whole file with another head: sizes, depths and lengths stand in the first bytes.
std::string fromSeed(Random& random, const std::vector<std::string>& seeds) {
    if (seeds.empty()) return bmp(random);
    std::string out = seeds[random.below(seeds.size())];
    if (out.empty()) return out;
    for (std::uint32_t edits = 1 + random.below(6); edits > 0; --edits) {
        const std::size_t head =
            random.oneIn(2) ? std::min<std::size_t>(64, out.size()) : out.size();
        out[random.below(head)] = static_cast<char>(
            random.oneIn(2) ? random.pick({0, 1, 2, 0x7f, 0x80, 0xfe, 0xff}) : random.below(256));
    }
    return out;
}

}  // namespace

CraftedImage craftImage(std::uint64_t index, const std::vector<std::string>& seeds) {
    Random random(index * 0x2545F4914F6CDD1DULL);
    CraftedImage image{"crafted.tga", {}};
    using Make = std::string (*)(Random&);
    static constexpr std::array<Make, 10> kMakers{bmp, bmp, tga,  tga, pnm,
                                                  hdr, gif, tiff, exr, exr};
    const std::uint32_t maker = random.below(kMakers.size() + 3);
    image.bytes = maker < kMakers.size() ? kMakers[maker](random) : fromSeed(random, seeds);
    if (random.oneIn(5) && !image.bytes.empty())
        image.bytes.resize(random.below(image.bytes.size()));
    return image;
}

}  // namespace farol::fuzz
