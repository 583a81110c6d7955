#pragma once

#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

/// Values as bytes between two processes of the same program on the same machine: numbers as they
/// are in memory, strings and lists with their length before them.
namespace farol::server::worker {

/// What came is not what the other side sends: it is broken, or no longer ours.
class WireError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

template <typename T>
inline constexpr bool kIsList = false;
template <typename T>
inline constexpr bool kIsList<std::vector<T>> = true;
template <typename T>
inline constexpr bool kIsOptional = false;
template <typename T>
inline constexpr bool kIsOptional<std::optional<T>> = true;
template <typename T>
inline constexpr bool kIsPair = false;
template <typename A, typename B>
inline constexpr bool kIsPair<std::pair<A, B>> = true;
template <typename T>
inline constexpr bool kIsMap = false;
template <typename K, typename V>
inline constexpr bool kIsMap<std::map<K, V>> = true;
template <typename T>
inline constexpr bool kIsVector = false;
template <int N, typename T, glm::qualifier Q>
inline constexpr bool kIsVector<glm::vec<N, T, Q>> = true;

/// Writes. Structures say their fields in a function `visit(archive, value)`, found by their
/// type; the same function serves both directions.
class Packer {
  public:
    template <typename... T>
    void operator()(const T&... values) {
        (put(values), ...);
    }
    std::string take() { return std::move(bytes_); }

  private:
    void raw(const void* from, std::size_t size) {
        bytes_.append(static_cast<const char*>(from), size);
    }
    template <typename T>
    void put(const T& value) {
        if constexpr (std::is_enum_v<T>) {
            put(static_cast<std::uint8_t>(value));
        } else if constexpr (std::is_arithmetic_v<T>) {
            raw(&value, sizeof value);
        } else if constexpr (std::is_same_v<T, std::string>) {
            put(static_cast<std::uint64_t>(value.size()));
            bytes_.append(value);
        } else if constexpr (kIsList<T>) {
            put(static_cast<std::uint64_t>(value.size()));
            for (const auto& one : value) put(one);
        } else if constexpr (kIsMap<T>) {
            put(static_cast<std::uint64_t>(value.size()));
            for (const auto& [key, one] : value) (*this)(key, one);
        } else if constexpr (kIsOptional<T>) {
            put(value.has_value());
            if (value) put(*value);
        } else if constexpr (kIsPair<T>) {
            put(value.first);
            put(value.second);
        } else if constexpr (kIsVector<T>) {
            for (int i = 0; i < T::length(); ++i) put(value[i]);
        } else {
            visit(*this, value);
        }
    }
    std::string bytes_;
};

/// Reads what a Packer wrote, and trusts none of it. Throws WireError.
class Unpacker {
  public:
    explicit Unpacker(std::string_view bytes) : rest_(bytes) {}

    template <typename... T>
    void operator()(T&... values) {
        (get(values), ...);
    }
    void end() const {
        if (!rest_.empty()) throw WireError("a message is longer than its content");
    }

  private:
    std::string_view cut(std::uint64_t size) {
        if (size > rest_.size()) throw WireError("a message is cut off");
        const std::string_view part = rest_.substr(0, size);
        rest_.remove_prefix(size);
        return part;
    }
    template <typename T>
    void get(T& value) {
        if constexpr (std::is_enum_v<T>) {
            std::uint8_t number = 0;
            get(number);
            if (number > static_cast<std::uint8_t>(lastOf(T{})))
                throw WireError("a message holds an unknown value");
            value = static_cast<T>(number);
        } else if constexpr (std::is_same_v<T, bool>) {
            value = cut(1).front() != 0;
        } else if constexpr (std::is_arithmetic_v<T>) {
            std::memcpy(&value, cut(sizeof value).data(), sizeof value);
        } else if constexpr (std::is_same_v<T, std::string>) {
            std::uint64_t size = 0;
            get(size);
            value = cut(size);
        } else if constexpr (kIsList<T>) {
            std::uint64_t count = 0;
            get(count);
            // Every element takes a byte at least: no count makes us allocate for nothing.
            if (count > rest_.size()) throw WireError("a message is cut off");
            value.clear();
            for (std::uint64_t i = 0; i < count; ++i) get(value.emplace_back());
        } else if constexpr (kIsMap<T>) {
            std::uint64_t count = 0;
            get(count);
            if (count > rest_.size()) throw WireError("a message is cut off");
            value.clear();
            for (std::uint64_t i = 0; i < count; ++i) {
                typename T::key_type key;
                get(key);
                get(value[key]);
            }
        } else if constexpr (kIsOptional<T>) {
            bool there = false;
            get(there);
            value.reset();
            if (there) get(value.emplace());
        } else if constexpr (kIsPair<T>) {
            get(value.first);
            get(value.second);
        } else if constexpr (kIsVector<T>) {
            for (int i = 0; i < T::length(); ++i) get(value[i]);
        } else {
            visit(*this, value);
        }
    }
    std::string_view rest_;
};

}  // namespace farol::server::worker
