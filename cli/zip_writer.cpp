#include "cli/zip_writer.h"

#include <array>
#include <stdexcept>

namespace farol::cli {
namespace {

constexpr std::uint16_t kUtf8Name = 1U << 11U, kZipVersion = 20;
constexpr std::uint64_t kMaxZipBytes = std::uint64_t{4'000} << 20U;

template <typename Number>
void appendLittle(std::string& bytes, Number value) {
    for (std::size_t i = 0; i < sizeof(Number); ++i)
        bytes += static_cast<char>(static_cast<unsigned char>(value >> (8 * i)));
}

/// CRC-32 of ISO 3309, as zip files have it.
std::uint32_t crcOf(std::string_view bytes) {
    static const auto kTable = [] {
        std::array<std::uint32_t, 256> table{};
        for (std::uint32_t i = 0; i < 256; ++i) {
            std::uint32_t value = i;
            for (int bit = 0; bit < 8; ++bit)
                value = (value & 1U) != 0 ? (value >> 1U) ^ 0xEDB88320U : value >> 1U;
            table[i] = value;
        }
        return table;
    }();
    std::uint32_t crc = 0xFFFFFFFFU;
    for (const char c : bytes)
        crc = kTable[(crc ^ static_cast<unsigned char>(c)) & 0xFFU] ^ (crc >> 8U);
    return ~crc;
}

}  // namespace

void ZipWriter::add(const ZipEntry& entry) {
    if (bytes_ + entry.packed.size() > kMaxZipBytes || count_ == 0xFFFFU)
        throw std::length_error("a zip of 4 GiB or of 65,535 entries");
    std::string common;
    for (const std::uint16_t value : {kUtf8Name, entry.method, entry.time, entry.date})
        appendLittle(common, value);
    appendLittle(common, entry.crc);
    appendLittle(common, static_cast<std::uint32_t>(entry.packed.size()));
    appendLittle(common, entry.size);
    appendLittle(common, static_cast<std::uint16_t>(entry.name.size()));
    appendLittle(common, std::uint16_t{0});  // no extra field
    directory_ += "PK\1\2";
    appendLittle(directory_, entry.madeBy);
    appendLittle(directory_, kZipVersion);
    directory_ += common;
    for (int i = 0; i < 3; ++i) appendLittle(directory_, std::uint16_t{0});
    appendLittle(directory_, entry.attributes);
    appendLittle(directory_, static_cast<std::uint32_t>(bytes_));
    directory_ += entry.name;
    std::string head = "PK\3\4";
    appendLittle(head, kZipVersion);
    put(head + common + entry.name);
    put(entry.packed);
    ++count_;
}

void ZipWriter::addStored(const std::string& name, std::string bytes) {
    ZipEntry entry;
    entry.name = name;
    entry.crc = crcOf(bytes);
    entry.size = static_cast<std::uint32_t>(bytes.size());
    entry.packed = std::move(bytes);
    add(entry);
}

void ZipWriter::finish() {
    std::string end = "PK\5\6";
    appendLittle(end, std::uint32_t{0});  // one disk
    appendLittle(end, count_);
    appendLittle(end, count_);
    appendLittle(end, static_cast<std::uint32_t>(directory_.size()));
    appendLittle(end, static_cast<std::uint32_t>(bytes_));
    appendLittle(end, std::uint16_t{0});
    put(directory_ + end);
}

void ZipWriter::put(std::string_view bytes) {
    write_(bytes);
    bytes_ += bytes.size();
}

}  // namespace farol::cli
