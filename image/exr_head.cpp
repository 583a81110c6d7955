#include "image/exr_head.h"

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>
#include <string>

#include "image/byte_reader.h"
#include "image/decoder.h"

namespace farol::image {
namespace {

constexpr std::uint32_t kTiled = 0x200, kLongNames = 0x400, kDeep = 0x800, kSeveralParts = 0x1000;
constexpr std::int64_t kMaxSide = 65536;
constexpr std::int64_t kMaxChunkBytes = std::int64_t{128} << 20;
constexpr std::int64_t kMaxBytes = kMaxTexturePixels * 16;  // four floats a pixel
constexpr std::size_t kMaxChannels = 64, kMaxParts = 64;

/// Rows of one chunk, by the file's number of the compression.
constexpr std::array<int, 10> kRowsAChunk{1, 1, 1, 16, 32, 16, 32, 32, 32, 256};

std::int32_t i32(ByteReader& in) { return static_cast<std::int32_t>(in.u32()); }

std::string text(ByteReader& in, std::size_t maxLength) {
    std::string out;
    for (char c = 0; (c = static_cast<char>(in.u8())) != 0; out += c)
        if (out.size() == maxLength) throw std::runtime_error("a name in its head is too long");
    return out;
}

ExrHead::Window window(ByteReader in) {
    const std::int64_t left = i32(in), top = i32(in), right = i32(in), bottom = i32(in);
    return {left, top, right - left + 1, bottom - top + 1};
}

struct Channel {
    std::int64_t bytes;  ///< of a sample
    bool isFullSize;
};

struct Part {
    ExrHead head;
    std::map<std::string, Channel> channels;
    std::uint32_t compression = 0xff;
    std::string type;
    bool isTiled = false;

    std::int64_t pixelBytes() const {
        std::int64_t sum = 0;
        for (const auto& [name, channel] : channels) sum += channel.bytes;
        return sum;
    }
    bool hasFull(const char* name) const {
        const auto channel = channels.find(name);
        return channel != channels.end() && channel->second.isFullSize;
    }
};

void readChannels(ByteReader in, std::size_t maxLength, Part& part) {
    for (std::string name; !(name = text(in, maxLength)).empty();) {
        const std::uint32_t type = in.u32();  // 0 whole number, 1 half, 2 float
        in.skip(4);
        const std::int32_t x = i32(in), y = i32(in);
        if (type > 2 || part.channels.size() == kMaxChannels)
            throw std::runtime_error("its list of channels is damaged or longer than 64");
        part.channels[name] = {type == 1 ? 2 : 4, x == 1 && y == 1};
    }
}

void readTiles(ByteReader in, Part& part) {
    const std::uint32_t width = in.u32(), height = in.u32(), mode = in.u8();
    if (width == 0 || height == 0 || width > kMaxSide || height > kMaxSide || (mode & 15U) > 2)
        throw std::runtime_error("its tiles are of no valid size");
    part.head.tileWidth = static_cast<int>(width);
    part.head.tileHeight = static_cast<int>(height);
}

/// Throws for a preview whose announced size differs from its bytes, and for deep images.
void checkAttribute(const std::string& type, ByteReader in) {
    if (type == "idmanifest") throw std::runtime_error("deep images are not read");
    if (type != "preview") return;
    const std::uint64_t width = in.u32(), height = in.u32();
    if (width > kMaxSide || height > kMaxSide || width * height * 4 != in.left())
        throw std::runtime_error("its preview is damaged");
}

Part readPart(ByteReader& in, std::size_t maxLength) {
    Part part;
    for (std::string name; !(name = text(in, maxLength)).empty();) {
        const std::string type = text(in, maxLength);
        const std::string_view value = in.take(in.u32());
        const ByteReader reader(value);
        if (name == "channels" && type == "chlist") readChannels(reader, maxLength, part);
        if (name == "compression" && type == "compression")
            part.compression = ByteReader(value).u8();
        if (name == "dataWindow" && type == "box2i") part.head.data = window(reader);
        if (name == "displayWindow" && type == "box2i") part.head.display = window(reader);
        if (name == "tiles" && type == "tiledesc") readTiles(reader, part);
        if (name == "type" && type == "string") part.type = value;
        checkAttribute(type, reader);
    }
    return part;
}

std::int64_t ceilDivide(std::int64_t count, std::int64_t step) { return (count + step - 1) / step; }

/// Returns the least number of chunks of a part. Throws where it is deep, damaged or too large.
std::int64_t checkPart(const Part& part) {
    if (part.type.rfind("deep", 0) == 0) throw std::runtime_error("deep images are not read");
    const ExrHead::Window& data = part.head.data;
    if (data.width <= 0 || data.height <= 0 || part.head.display.width <= 0 ||
        part.head.display.height <= 0)
        throw std::runtime_error("it has no pixels");
    if (part.compression >= kRowsAChunk.size())
        throw std::runtime_error("compression " + std::to_string(part.compression) +
                                 " is not read");
    if (part.isTiled && part.head.tileWidth == 0)
        throw std::runtime_error("its tiles are of no valid size");
    if (data.width > kMaxSide || data.height > kMaxSide)
        throw std::runtime_error("its data window is " + std::to_string(data.width) + " x " +
                                 std::to_string(data.height) +
                                 " px; expected sides of at most 65536");
    const std::int64_t chunkWidth = part.isTiled ? part.head.tileWidth : data.width;
    const std::int64_t chunkHeight =
        part.isTiled ? part.head.tileHeight : kRowsAChunk[part.compression];
    const std::int64_t bytes = part.pixelBytes();
    if (data.width * data.height > kMaxTexturePixels ||
        data.width * data.height * bytes > kMaxBytes ||
        chunkWidth * chunkHeight * std::max<std::int64_t>(bytes, 16) > kMaxChunkBytes)
        throw std::runtime_error("it needs too much memory; fix: export R, G, B and A alone");
    return ceilDivide(data.width, chunkWidth) * ceilDivide(data.height, chunkHeight);
}

}  // namespace

ExrHead readExrHead(std::string_view bytes) {
    constexpr std::int64_t kMinChunk = 16;  // bytes: offset, coordinates, size
    ByteReader in(bytes);
    in.skip(4);
    const std::uint32_t version = in.u32();
    if ((version & 255U) != 2) throw std::runtime_error("its version is not 2");
    if ((version & kDeep) != 0) throw std::runtime_error("deep images are not read");
    const bool hasSeveral = (version & kSeveralParts) != 0;
    const std::size_t maxLength = (version & kLongNames) != 0 ? 255 : 31;
    Part first;
    std::int64_t chunks = 0;
    for (std::size_t count = 0; count == 0 || (hasSeveral && in.peek() != 0); ++count) {
        if (count == kMaxParts) throw std::runtime_error("it has more than 64 parts");
        Part part = readPart(in, maxLength);
        part.isTiled = hasSeveral ? part.type == "tiledimage" : (version & kTiled) != 0;
        if (!part.isTiled) part.head.tileWidth = part.head.tileHeight = 0;
        chunks += checkPart(part);
        if (count == 0) first = std::move(part);
    }
    in.requireLeft(static_cast<std::uint64_t>(chunks * kMinChunk));
    first.head.isGrey = !first.hasFull("R") || !first.hasFull("G") || !first.hasFull("B");
    first.head.hasAlpha = first.hasFull("A");
    if (first.head.isGrey && (!first.hasFull("Y") || first.channels.count("RY") != 0))
        throw std::runtime_error(
            "its first part has no channels R, G and B or Y of full size; fix: export one layer "
            "as RGBA");
    return first.head;
}

}  // namespace farol::image
