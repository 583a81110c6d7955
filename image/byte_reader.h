#pragma once

#include <cstdint>
#include <stdexcept>
#include <string_view>

namespace farol::image {

/// Reads a file front to back. Every read throws std::runtime_error at the end of the file.
class ByteReader {
  public:
    explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

    std::size_t left() const { return rest_.size(); }
    std::uint8_t peek() const {
        requireLeft(1);
        return static_cast<std::uint8_t>(rest_.front());
    }
    std::uint8_t u8() {
        const std::uint8_t value = peek();
        rest_.remove_prefix(1);
        return value;
    }
    /// Little-endian.
    std::uint32_t u16() {
        const std::uint32_t low = u8();
        return low | std::uint32_t{u8()} << 8U;
    }
    std::uint32_t u32() {
        const std::uint32_t low = u16();
        return low | u16() << 16U;
    }
    std::string_view take(std::size_t count) {
        requireLeft(count);
        const std::string_view taken = rest_.substr(0, count);
        rest_.remove_prefix(count);
        return taken;
    }
    void skip(std::size_t count) { take(count); }
    void requireLeft(std::uint64_t count) const {
        if (count > rest_.size()) throw std::runtime_error("the file is cut off");
    }

  private:
    std::string_view rest_;
};

}  // namespace farol::image
