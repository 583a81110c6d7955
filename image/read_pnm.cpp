#include <algorithm>
#include <stdexcept>

#include "image/byte_reader.h"
#include "image/decoder.h"

namespace farol::image {
namespace {

constexpr std::uint64_t kMaxNumber = 0x7fffffff;

bool isBlank(std::uint8_t c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

void skipBlanks(ByteReader& in) {
    while (isBlank(in.peek()) || in.peek() == '#') {
        if (in.u8() != '#') continue;
        while (in.peek() != '\n' && in.peek() != '\r') in.skip(1);
    }
}

std::uint32_t readNumber(ByteReader& in) {
    skipBlanks(in);
    std::uint64_t value = 0;
    bool hasDigit = false;
    while (in.left() > 0 && in.peek() >= '0' && in.peek() <= '9') {
        hasDigit = true;
        value = value * 10 + (in.u8() - std::uint64_t{'0'});
        if (value > kMaxNumber) throw std::runtime_error("a number is out of range");
    }
    if (!hasDigit) throw std::runtime_error("expected a number");
    return static_cast<std::uint32_t>(value);
}

/// 0 black, 1 in the file, to 0; white to 255.
void readAsciiBits(ByteReader& in, Decoded& out) {
    for (std::uint8_t& sample : out.samples) {
        skipBlanks(in);
        const std::uint8_t digit = in.u8();
        if (digit != '0' && digit != '1') throw std::runtime_error("a pixel is neither 0 nor 1");
        sample = digit == '0' ? 255 : 0;
    }
}

void readPackedBits(ByteReader& in, Decoded& out) {
    for (int y = 0; y < out.height; ++y) {
        std::uint8_t* row = out.row(y);
        std::uint32_t bits = 0;
        for (int x = 0; x < out.width; ++x, bits <<= 1U) {
            if (x % 8 == 0) bits = in.u8();
            row[x] = (bits & 0x80U) != 0 ? 0 : 255;
        }
    }
}

void readSamples(ByteReader& in, bool ascii, std::uint32_t maxValue, Decoded& out) {
    for (std::uint8_t& sample : out.samples) {
        std::uint32_t value = 0;
        if (ascii) {
            value = readNumber(in);
        } else {
            value = in.u8();
            if (maxValue > 255) value = value << 8U | in.u8();
        }
        if (value > maxValue)
            throw std::runtime_error("sample " + std::to_string(value) +
                                     " is above the maximum of " + std::to_string(maxValue));
        sample = static_cast<std::uint8_t>((value * 255U + maxValue / 2) / maxValue);
    }
}

}  // namespace

void readPnm(std::string_view bytes, bool wantsPixels, Decoded& out) {
    ByteReader in(bytes);
    in.skip(1);
    const int kind = in.u8() - '0';
    const bool ascii = kind <= 3, bits = kind == 1 || kind == 4;
    const std::uint32_t width = readNumber(in), height = readNumber(in);
    const std::uint32_t maxValue = bits ? 1 : readNumber(in);
    if (maxValue < 1 || maxValue > 65535)
        throw std::runtime_error("the maximum " + std::to_string(maxValue) +
                                 " is out of range; expected 1 to 65535");
    if (!isBlank(in.u8())) throw std::runtime_error("expected a blank after the head");
    if (!out.announce(width, height, kind == 3 || kind == 6 ? 3 : 1)) return;
    const auto samples = static_cast<std::uint64_t>(out.pixels() * out.channels);
    const std::uint64_t packedRow = (std::uint64_t{width} + 7) / 8;
    in.requireLeft(kind == 4        ? packedRow * height
                   : kind == 1      ? samples
                   : ascii          ? samples * 2 - 1  // a blank between two
                   : maxValue > 255 ? samples * 2
                                    : samples);
    if (!wantsPixels) return;
    out.allocate();
    if (kind == 1)
        readAsciiBits(in, out);
    else if (kind == 4)
        readPackedBits(in, out);
    else
        readSamples(in, ascii, maxValue, out);
}

}  // namespace farol::image
