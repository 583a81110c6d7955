#pragma once

#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "scene/files/assets.h"
#include "worker/fields.h"

/// Serialises values between two processes of the same program on the same machine: numbers as in
/// memory, strings and lists with their length before them, structures member by member. A
/// serialised enumeration has a function `lastOf`, found by argument-dependent lookup.
namespace farol::worker {

/// Thrown for a message that the other side would not send: it is broken or hijacked.
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

/// The serialised files beside a document: a served folder by its path, which the worker may
/// read, a bundle by its files.
struct TravellingAssets {
    bool isFolder = false;
    std::string folder;
    std::map<std::string, std::string> files;
};
TravellingAssets departing(const scene::Assets* assets);
std::shared_ptr<const scene::Assets> arrived(TravellingAssets assets);

using SharedAssets = std::shared_ptr<const scene::Assets>;

/// Writes values.
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
        } else if constexpr (std::is_same_v<T, SharedAssets>) {
            put(departing(value.get()));
        } else {
            withFields(value, *this);
        }
    }
    std::string bytes_;
};

/// Reads the output of a Packer, and validates all of it. Throws WireError.
class Unpacker {
  public:
    /// `maxEntries`: of all lists and maps together.
    explicit Unpacker(std::string_view bytes, std::uint64_t maxEntries = kAnyNumber)
        : rest_(bytes), entriesLeft_(maxEntries) {}
    static constexpr std::uint64_t kAnyNumber = std::numeric_limits<std::uint64_t>::max();

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
    std::uint64_t getCount() {
        std::uint64_t count = 0;
        get(count);
        // Every entry takes a byte at least: a count alone allocates nothing.
        if (count > rest_.size()) throw WireError("a message is cut off");
        if (count > entriesLeft_) throw WireError("a message has too many entries");
        entriesLeft_ -= count;
        return count;
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
            const std::uint64_t count = getCount();
            value.clear();
            for (std::uint64_t i = 0; i < count; ++i) get(value.emplace_back());
        } else if constexpr (kIsMap<T>) {
            const std::uint64_t count = getCount();
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
        } else if constexpr (std::is_same_v<T, SharedAssets>) {
            TravellingAssets assets;
            get(assets);
            value = arrived(std::move(assets));
        } else {
            withFields(value, *this);
        }
    }
    std::string_view rest_;
    std::uint64_t entriesLeft_;
};

template <typename... T>
std::string pack(const T&... values) {
    Packer packer;
    packer(values...);
    return packer.take();
}

/// Reads one message that is T and nothing more. Throws WireError.
template <typename T>
T unpack(std::string_view bytes) {
    T value;
    Unpacker unpacker(bytes);
    unpacker(value);
    unpacker.end();
    return value;
}

}  // namespace farol::worker
